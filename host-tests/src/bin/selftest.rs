//! From what size on causes are seen, foretold and found in simulated recordings: makes the page and compares it with the
//! golden one. `BLESS=1` rewrites it.

use std::process::ExitCode;
use std::time::Instant;

use host_tests::confusion::cases::WHOLE;
use host_tests::golden;
use host_tests::verified::cases::{LAYOUTS, verified};
use host_tests::verified::page::{Verified, page};
use omni_gap::Error;

fn main() -> ExitCode {
    golden::exit(made())
}

fn made() -> Result<bool, Error> {
    let mut all: Vec<Verified> = Vec::new();
    for layout in LAYOUTS {
        let begun = Instant::now();
        all.push((layout, verified(layout, WHOLE, |_| true)?));
        println!("{}: {:.0} s", layout.title(), begun.elapsed().as_secs_f64());
    }
    golden::check_record("selftest_verified.md", &page(&all), "cargo xtask selftest")
}
