//! Faults of the world around the program: each is staged, and what is promised of it holds.
#![cfg(target_os = "linux")]

use host_tests::fault_injection::{faults, injected, kills, program_beside};

#[test]
fn what_cannot_be_done_ends_with_one_message_and_nothing_half_written() {
    let program = program_beside().unwrap();
    let mut broken = Vec::new();
    for fault in faults() {
        let outcome = injected(fault, &program).unwrap_or_else(|why| panic!("{}: {why}", fault.what));
        println!("{}: {} [{:?} MB, {:?} s]", fault.what, outcome.happens, outcome.megabytes, outcome.seconds);
        broken.extend(outcome.broken.iter().map(|why| format!("{}: {why}", fault.what)));
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

#[test]
fn killed_it_leaves_nothing_half_written_and_comes_to_the_same_when_asked_again() {
    let program = program_beside().unwrap();
    for kills in [kills::of_a_diagnosis(&program, 1, 2).unwrap(), kills::of_a_fleet(&program, 1, 2).unwrap()] {
        println!("{kills:?}");
        assert!(kills.killed == 3 && kills.broken.is_empty(), "{kills:?}");
    }
}
