//! The study of the identification: plays all that is on the golden page and rewrites it.
//!
//! With a number, at most so many seeds a case; with a second word, only the cases with that word in their title. Then
//! the page is printed and not kept.

use std::process::ExitCode;
use std::time::Instant;

use host_tests::catalogue::sessions::WHEELS;
use host_tests::golden::record;
use host_tests::identification::Results;
use host_tests::identification::case::{CASES, StudyCase};
use host_tests::identification::missing_group::{SEEDS, SensorGroup, without_group};
use host_tests::identification::no_excitation::{NO_EXCITATION_CASES, without_excitation};
use host_tests::identification::page::page;
use host_tests::identification::promises::promises;
use host_tests::identification::study::study;

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let cap = arguments.next();
    let only = arguments.next().unwrap_or_default();
    let seeds = match cap.as_deref().map(str::parse::<u64>) {
        None => u64::MAX,
        Some(Ok(cap)) if cap > 0 => cap,
        _ => {
            eprintln!("identification [SEEDS [WORD]]: SEEDS is how many robots a case has at the most");
            return ExitCode::FAILURE;
        }
    };
    let results = measured(seeds, &only);
    let text = page(&results);
    if cap.is_some() {
        println!("{text}");
        return ExitCode::SUCCESS;
    }
    if let Err(why) = record("identification.md", &text, "cargo xtask identification") {
        eprintln!("{why}");
        return ExitCode::FAILURE;
    }
    for promise in promises(&results).iter().filter(|p| !p.kept()) {
        println!("not kept: {}: {} ({}), {:?}", promise.what, promise.found, promise.at, promise.threshold);
    }
    ExitCode::SUCCESS
}

fn measured(seeds: u64, only: &str) -> Results {
    let chosen = CASES.iter().filter(|case| case.title().contains(only));
    let cases = chosen.map(|case| {
        let case = StudyCase { seeds: case.seeds.min(seeds), ..*case };
        timed(&format!("{}, {} seeds", case.title(), case.seeds), || study(case))
    });
    let cases = cases.collect();
    let few = SEEDS.min(seeds);
    let missing = || {
        let groups = SensorGroup::ALL.into_iter().flat_map(|group| WHEELS.map(|wheels| (wheels, group)));
        groups.map(|(wheels, group)| without_group(wheels, group, few)).collect()
    };
    let idle = || {
        let cases = NO_EXCITATION_CASES.into_iter().flat_map(|case| WHEELS.map(|wheels| (wheels, case)));
        cases
            .map(|(wheels, (lack, sensing))| without_excitation(wheels, lack, sensing, lack.seeds().min(seeds)))
            .collect()
    };
    if !only.is_empty() {
        return Results { cases, missing: Vec::new(), idle: Vec::new() };
    }
    Results { cases, missing: timed("one group missing", missing), idle: timed("without excitation", idle) }
}

/// Does it, and says on standard error how long it took.
fn timed<T>(what: &str, does: impl FnOnce() -> T) -> T {
    let begun = Instant::now();
    let done = does();
    eprintln!("{what}: {:.0} s", begun.elapsed().as_secs_f64());
    done
}
