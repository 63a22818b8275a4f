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
    for case in cases().into_iter().filter(|case| only.is_none_or(|only| case.name().contains(only))) {
        let outcome = match folder {
            Some(folder) => case.diagnosed_in(&folder.join(format!("session-{}", case.seed)))?,
            None => case.diagnosed()?,
        };
        println!("{}: {}, {:?}; {:.1} s", case.name(), right(outcome.judged()), outcome.report.causes, outcome.seconds);
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
