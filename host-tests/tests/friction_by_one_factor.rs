//! A robot file whose friction is wrong by one factor on all axes: another floor, or other rollers. Each of its three numbers is as
//! far off as in one robot of fifty, which nobody would name; that all three are is less likely than one in a hundred thousand.

use host_tests::laboratory::through_files::answered;
use host_tests::withheld::label::Suite;
use host_tests::withheld::suites::Case;
use omni_gap::{Report, Verdict};

/// The answer to a session of the benchmark's tuning split, and the cause that is hidden there.
fn report(number: usize, seed: u64) -> (Report, String) {
    let (session, label) = Case { suite: Suite::Laboratory, number, seed, fresh: false }.made();
    (answered(&session).expect("an answer"), label.hidden[0].cause.clone())
}

#[test]
fn friction_that_is_wrong_by_one_factor_on_all_axes_is_named() {
    let (report, hidden) = report(208, 8_931_203_794_824_809_282);
    assert_eq!((report.verdict, &report.causes[..]), (Verdict::Parameter, &[hidden][..]));
}
