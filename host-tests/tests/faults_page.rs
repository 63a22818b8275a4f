//! The promises of the page of the faults, kept by the library on the host as far as it has the parts; the page itself is
//! made with the image.

use std::path::Path;

use host_tests::in_loop::HostProgram;
use host_tests::in_loop::faults::case::{CASES, is_timed};
use host_tests::in_loop::faults::unfound::{UNFOUND, drive_on};
use host_tests::in_loop::faults::watchdog::WatchdogOutcome;
use host_tests::in_loop::faults::wheel_loss::{LOSSES, run_with_three_wheels};
use host_tests::in_loop::faults::{Results, broken_promises, page, run_case::run_case};
use model_core::link::faults::Fault;
use rayon::prelude::*;

/// The watchdog is not looked at here.
const NOT_STARVED: WatchdogOutcome = WatchdogOutcome { overrun: Some(0), fired: Some(0), closed_after: 0 };

#[test]
fn every_fault_is_injected_but_the_one_that_a_restart_tells_of_and_the_one_that_is_raised_no_more() {
    for fault in Fault::ALL {
        let injected = CASES.iter().any(|case| case.fault == fault);
        assert_eq!(injected, !matches!(fault, Fault::Watchdog | Fault::CommandSilent), "{fault:?}");
    }
}

#[test]
fn the_library_keeps_the_promises_of_the_page_and_says_what_the_page_says() {
    let cases: Vec<_> = CASES.into_iter().filter(|case| !is_timed(&case.cause)).collect();
    let play = |case| (case, run_case(&case, HostProgram::default()).expect("software does not fail"));
    let go_on = |loss| (loss, run_with_three_wheels(&loss, HostProgram::default()).expect("software does not fail"));
    let unfound = |unfound| (unfound, drive_on(&unfound, HostProgram::default()).expect("software does not fail"));
    let results = Results {
        cases: cases.into_par_iter().map(play).collect(),
        wheel_losses: LOSSES.into_par_iter().map(go_on).collect(),
        unfound: UNFOUND.into_par_iter().map(unfound).collect(),
        crashes: Vec::new(),
        watchdog: NOT_STARVED,
    };
    let broken = broken_promises(&results);
    assert!(broken.is_empty(), "{broken:#?}");

    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/faults.md");
    let golden = std::fs::read_to_string(golden).expect("the page is there");
    // every row of a table, but for those of what only the image can do
    for row in page(&results).lines().filter(|line| line.starts_with('|')) {
        assert!(golden.lines().any(|line| line == row), "the page does not say: {row}");
    }
}

#[test]
fn nothing_on_the_page_stands_out() {
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/faults.md");
    let golden = std::fs::read_to_string(golden).expect("the page is there");
    let rows = golden.lines().filter(|line| line.starts_with('|'));
    assert!(rows.clone().count() > CASES.len() + LOSSES.len());
    assert!(rows.clone().all(|row| !row.contains("**")), "a row in bold is a promise that is not kept");
}
