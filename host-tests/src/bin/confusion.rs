//! Which cause would be taken for which: makes the page and its pictures, and compares them with the golden ones. `BLESS=1`
//! rewrites these.

use std::process::ExitCode;
use std::time::Instant;

use host_tests::confusion::cases::{WHOLE, cases};
use host_tests::confusion::page::{Confused, page};
use host_tests::confusion::picture::picture;
use host_tests::golden;
use omni_gap::Error;

fn main() -> ExitCode {
    golden::exit(made())
}

fn made() -> Result<bool, Error> {
    let mut all: Vec<Confused> = Vec::new();
    for case in cases() {
        let begun = Instant::now();
        all.push((case, case.confusion(WHOLE)?));
        println!("{}: {:.0} s", case.title(), begun.elapsed().as_secs_f64());
    }
    let mut as_it_should_be = golden::check_record("confusion.md", &page(&all), "cargo xtask confusion")?;
    for (case, confusion) in &all {
        let svg = picture(&case.title(), confusion);
        let differs = |golden: &str| golden::lines(golden, &svg, |a, b| a == b);
        as_it_should_be &= golden::check_page(&case.picture(), &svg, |golden| differs(golden))?;
    }
    Ok(as_it_should_be)
}
