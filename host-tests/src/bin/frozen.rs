//! Holds reports to what they were, field by field; with `BLESS=1` freezes them anew.
//!
//! With a folder, the recordings of real robots in it are compared too, as [`host_tests::real::sessions`] names them.

use std::path::PathBuf;
use std::process::ExitCode;

use host_tests::frozen::{FILE, REAL_FILE, answers, compare, real_answers, recordings::recordings};
use host_tests::golden::{check_page, exit};
use omni_gap::Error;

fn main() -> ExitCode {
    exit(compared(std::env::args_os().nth(1).map(PathBuf::from)))
}

fn compared(real: Option<PathBuf>) -> Result<bool, Error> {
    let now = answers(&recordings())?;
    let mut same = check_page(FILE, &compare::written(&now), |frozen| compare::differences(frozen, &now))?;
    println!("{} reports made here compared", now.len());
    match real {
        Some(folder) => {
            let now = real_answers(&folder)?;
            same &= check_page(REAL_FILE, &compare::written(&now), |frozen| compare::differences(frozen, &now))?;
            println!("{} reports of real recordings compared", now.len());
        }
        None => println!("reports of real recordings: not compared, no folder of recordings was named"),
    }
    Ok(same)
}
