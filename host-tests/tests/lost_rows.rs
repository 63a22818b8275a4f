//! Logs that lack rows: what drove the robot meanwhile is not known, and is neither taken for a gap nor hides one.

use host_tests::laboratory::through_files::answered;
use host_tests::withheld::label::Suite;
use host_tests::withheld::suites::Case;
use omni_gap::Verdict;
use omni_gap::report::Report;

/// What is answered to a session of the benchmark's tuning split, of which one row in sixty is lost, 50 rows a second.
fn answer_to(suite: Suite, number: usize, seed: u64) -> Report {
    let (recorded, label) = Case { suite, number, seed, fresh: false }.made();
    assert!(label.about["lost_rows"].parse::<f64>().is_ok_and(|share| share > 0.01) && label.about["rate_hz"] == "50");
    answered(&recorded).expect("an answer")
}

#[test]
fn a_robot_that_lacks_nothing_is_no_gap_though_its_log_lost_rows_in_which_it_was_told_otherwise() {
    let report = answer_to(Suite::NoGap, 65, 3_873_906_953_345_276_017);
    assert_eq!(report.verdict, Verdict::NoGap);
    let told = report.notices.iter().find(|notice| notice.contains("rows were lost over which the command changed"));
    assert!(told.is_some_and(|notice| notice.starts_with("in 4 place(s)")), "{:?}", report.notices);
}

#[test]
fn an_effect_is_named_though_its_log_lost_rows() {
    let report = answer_to(Suite::Life, 122, 12_528_583_974_135_252_217);
    assert_eq!(report.causes, ["asymmetric_friction"]);
    assert_eq!(report.which[0].wheel, Some(1));
}
