//! The recommended experiment on a robot of the second simulator: what it was for is settled.
//! `cargo run --release -p host-tests --bin designs` does the same for as many robots as one likes.

use host_tests::designs::open::HiddenCase;
use host_tests::designs::settled::settled;

/// A robot whose wheels creep; two short everyday runs without currents leave it open whether they slip.
const CREEPS: u64 = 12_121;

#[test]
fn the_script_that_was_recommended_rules_the_rival_out() {
    let case = HiddenCase::drawn(CREEPS).opened().expect("room for a session").expect("it is open");
    assert!(case.in_question.contains(&"creep".to_owned()), "{:?}", case.in_question);
    assert!(case.in_question.contains(&"wheel_slip".to_owned()), "{:?}", case.in_question);
    let settled = settled(&case).expect("room for a session").expect("a script is recommended");
    assert_eq!(settled.by_script.first().map(String::as_str), Some("creep"), "{settled:?}");
    assert!(!settled.by_script.contains(&"wheel_slip".to_owned()), "{settled:?}");
    assert!(settled.is_no_worse(), "{settled:?}");
    // the difference that was foretold, by straight lines, is found within four times
    let found = settled.found.expect("the rival was tried");
    assert!((0.25..4.0).contains(&(found / settled.foretold)), "foretold {}, found {found}", settled.foretold);
}
