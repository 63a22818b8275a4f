//! Diagnoses recordings of real robots and rewrites the golden page.
//!
//! The argument is the folder that holds them, as [`host_tests::real::sessions`] names them.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

use host_tests::golden::record;
use host_tests::real::page::{page, warning};
use host_tests::real::sessions::SESSIONS;
use omni_gap::report::terminal;

fn main() -> ExitCode {
    let Some(folder) = std::env::args_os().nth(1).map(PathBuf::from) else {
        eprintln!("no folder of recordings: name the one that holds robotino/, ssl2018/ and kiwi2026/");
        return ExitCode::from(2);
    };
    match diagnosed(&folder) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}

fn diagnosed(folder: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let mut answered = Vec::new();
    for real in SESSIONS {
        println!("{}: {}", real.title, real.recorded);
        let start = Instant::now();
        let report = real.answered(folder)?.report;
        println!("{}{:.1} s", terminal(&report, None), start.elapsed().as_secs_f64());
        if let Some(warning) = warning(&real, &report) {
            println!("warning: {warning}");
        }
        println!();
        answered.push((real, report));
    }
    record("real.md", &page(&answered)?, "cargo xtask real FOLDER")?;
    Ok(())
}
