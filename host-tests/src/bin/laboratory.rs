//! Diagnoses what a second simulator records of every cause, and keeps the page. With a word, only the causes with that word
//! in their name, at more length and without a page; with a folder behind it, their recordings are left there.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use host_tests::catalogue::page::right;
use host_tests::golden;
use host_tests::laboratory::cases::{LaboratoryOutcome, cases};
use host_tests::laboratory::page::page;
use omni_gap::Error;
use omni_gap::report::terminal;

fn main() -> ExitCode {
    let mut asked = std::env::args().skip(1);
    let (only, folder) = (asked.next(), asked.next().map(PathBuf::from));
    golden::exit(made(only.as_deref(), folder.as_deref()))
}

fn made(only: Option<&str>, folder: Option<&Path>) -> Result<bool, Error> {
    let mut outcomes: Vec<LaboratoryOutcome> = Vec::new();
    let named = |id: Option<&str>| only.is_none_or(|only| id.unwrap_or("nothing").contains(only));
    for case in cases().into_iter().filter(|case| named(case.cause.map(|cause| cause.id))) {
        if let Some(folder) = folder {
            case.write(&folder.join(format!("session-{}", case.seed)))?;
        }
        let outcome = case.diagnosed()?;
        let hidden = case.hidden().map_or("nothing", |(id, _)| id);
        println!("{hidden}: {}, {:?}; {:.1} s", right(outcome.judged()), outcome.report.causes, outcome.seconds);
        if only.is_some() {
            println!("{}", terminal(&outcome.report, None));
        }
        outcomes.push(outcome);
    }
    match only {
        Some(_) => Ok(true),
        None => golden::record("laboratory.md", &page(&outcomes), "cargo xtask laboratory").map(|()| true),
    }
}
