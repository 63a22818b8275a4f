//! What a diagnosis says of physics that no entry of the catalogue describes, where most of what is left is the error of the
//! starts: sessions of the benchmark's tuning split.

use host_tests::laboratory::through_files::answered;
use host_tests::withheld::label::Suite;
use host_tests::withheld::suites::Case;
use omni_gap::Verdict;

fn verdict(suite: Suite, number: usize, seed: u64) -> Verdict {
    let (session, _) = Case { suite, number, seed, fresh: false }.made();
    answered(&session).expect("an answer").verdict
}

/// A lens that bends shows where the robot is far from the middle, in a few windows, and by less than what starts amid
/// curves leave in all of them: once it was no gap, once a distance of the wheels.
#[test]
fn a_lens_that_bends_is_neither_no_gap_nor_a_distance() {
    assert_eq!(verdict(Suite::Open, 30, 3_702_790_467_785_548_232), Verdict::Unknown);
    assert_eq!(verdict(Suite::Open, 86, 6_464_270_032_661_990_496), Verdict::Unknown);
}

/// A command that comes in coarse steps: large noise of the wheel speeds would look the same, but for the currents.
#[test]
fn a_coarse_command_is_not_no_gap() {
    assert_eq!(verdict(Suite::Open, 100, 4_843_157_200_106_798_652), Verdict::Unknown);
}

/// Few held-out windows, started from coarse counts, missed by a third more than their floor: nothing is there but noise.
#[test]
fn a_healthy_robot_whose_floor_is_uncertain_has_no_gap() {
    assert_eq!(verdict(Suite::NoGap, 9, 1_846_769_597_442_998_135), Verdict::NoGap);
}
