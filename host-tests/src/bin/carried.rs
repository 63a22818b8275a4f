//! The numbers of effects that robot files carry, as `identify` finds them: makes the page and compares it with the golden
//! one. `BLESS=1` rewrites it.

use std::process::ExitCode;

use host_tests::carried::cases::cases;
use host_tests::carried::page::{CarriedNumber, page};
use host_tests::golden;
use omni_gap::Error;

fn main() -> ExitCode {
    golden::exit(made())
}

fn made() -> Result<bool, Error> {
    let mut numbers = Vec::new();
    for case in cases() {
        let own = CarriedNumber::of(&case, case.identified()?)?;
        let off = own.iter().map(|number| number.off_sigmas().map_or("–".to_owned(), |off| format!("{off:.1} σ")));
        println!("{} wheels, {}: {}", case.wheels(), case.effect.id, off.collect::<Vec<_>>().join(", "));
        numbers.extend(own);
    }
    golden::check_record("carried_effects.md", &page(&numbers), "cargo xtask carried")
}
