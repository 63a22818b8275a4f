//! Faults of the world around the program: stages each, and tells what happens. `BLESS=1` writes the page.

#[cfg(target_os = "linux")]
use std::{io, process::ExitCode};

#[cfg(target_os = "linux")]
use host_tests::fault_injection::{faults, injected, kills, page, program_beside};
#[cfg(target_os = "linux")]
use host_tests::golden;

/// Kills at random moments, and at files.
#[cfg(target_os = "linux")]
const KILLS: [usize; 2] = [200, 50];

#[cfg(target_os = "linux")]
fn main() -> ExitCode {
    golden::exit(told())
}

/// True if every promise is kept.
#[cfg(target_os = "linux")]
fn told() -> Result<bool, Box<dyn std::error::Error>> {
    let program = program_beside()?;
    let outcomes: Vec<_> = faults().map(|fault| Ok((fault, injected(fault, &program)?))).collect::<io::Result<_>>()?;
    let [random, at_files] = KILLS;
    let kills = [kills::of_a_diagnosis(&program, random, at_files)?, kills::of_a_fleet(&program, random, at_files)?];
    let page = page::page(&outcomes, &kills, KILLS);
    println!("{page}");
    let told = outcomes
        .iter()
        .flat_map(|(fault, outcome)| outcome.broken.iter().map(move |why| format!("{}: {why}", fault.what)));
    let broken: Vec<String> = told.chain(kills.iter().flat_map(|kills| kills.broken.clone())).collect();
    let kept = golden::report_broken(&broken);
    if golden::blessed() {
        golden::record("fault_injection.md", &page, "cargo xtask fault-injection")?;
    }
    Ok(kept)
}

#[cfg(not(target_os = "linux"))]
fn main() {
    println!("faults are staged on Linux");
}
