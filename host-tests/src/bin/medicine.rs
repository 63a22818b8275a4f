//! The diagnosis's own medicine: hides every effect in what the simulator records, diagnoses it with the plain file, and
//! compares the page with the golden one. `BLESS=1` rewrites it.
//!
//! With a word, only the sessions with that word in their name, at more length and without a page.

use std::process::ExitCode;

use host_tests::catalogue::foretold::{Forecast, Foretold};
use host_tests::catalogue::medicine_page::{Dose, page};
use host_tests::catalogue::outcome::diagnose_case;
use host_tests::catalogue::page::right;
use host_tests::catalogue::sessions::plain_cases;
use host_tests::golden;
use omni_gap::Error;
use omni_gap::engine::Stepwise;
use omni_gap::report::terminal;

fn main() -> ExitCode {
    golden::exit(taken(std::env::args().nth(1).as_deref()))
}

fn taken(only: Option<&str>) -> Result<bool, Error> {
    let forecast = Forecast::ask()?;
    let mut doses: Vec<Dose> = Vec::new();
    for case in plain_cases().into_iter().filter(|case| only.is_none_or(|only| case.hidden.to_string().contains(only)))
    {
        let foretold = case.hidden.cause().and_then(|(id, _)| forecast.of(id, &case.plan()));
        let outcome = diagnose_case(&case, &Stepwise)?;
        let (judged, said) = (right(outcome.judged()), foretold.map_or("–", Foretold::words));
        println!("{}: {judged}, foretold: {said}; {:?}; {:.1} s", case.hidden, outcome.report.causes, outcome.seconds);
        if only.is_some() {
            println!("{}", terminal(&outcome.report, None));
        }
        doses.push((outcome, foretold));
    }
    match only {
        Some(_) => Ok(true),
        None => golden::check_record("own_medicine.md", &page(&doses), "cargo xtask medicine"),
    }
}
