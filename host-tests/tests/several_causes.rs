//! Robots that are wrong in several places at once: files wrong in several numbers, and two effects together.

use ground_truth::causes::cause;
use ground_truth::logging::Logging;
use ground_truth::recording::{Plan, Session};
use ground_truth::robot_file::RobotFile;
use host_tests::laboratory::cases::PLAN;
use host_tests::laboratory::through_files::answered;
use host_tests::withheld::label::Suite;
use host_tests::withheld::suites::Case;
use omni_gap::Verdict;
use omni_gap::report::Report;

/// What is hidden in the paper's robot: causes, and how many times what is typical of each.
fn diagnosed(hidden: &[(&str, f64)]) -> Report {
    let file = RobotFile::paper(0.0);
    let mut setup = file.setup();
    for (id, times) in hidden {
        (cause(id).expect("a cause").put)(&mut setup, None, *times);
    }
    let plan = Plan { duration: 4.0, ..PLAN };
    answered(&Session::logged((&file, &setup), &plan, &Logging::clean(), 11)).expect("an answer")
}

fn named(report: &Report) -> Vec<&str> {
    let mut names: Vec<&str> = report.causes.iter().map(String::as_str).collect();
    names.sort_unstable();
    names
}

#[test]
fn a_file_that_is_wrong_in_four_numbers_is_told_so_and_nothing_else_is() {
    let wrong = [("wheel_radius", 1.5), ("resistance", 1.3), ("inertia", 1.5), ("viscous_friction", 1.5)];
    let report = diagnosed(&wrong);
    assert_eq!(report.verdict, Verdict::Parameter, "{:?}", report.causes);
    assert_eq!(named(&report), ["inertia", "resistance", "viscous_friction", "wheel_radius"]);
    let of_file = |key: &str| report.parameters.iter().find(|number| number.key == key).expect("a number of the file");
    for (key, times) in [("wheel.radius_m", 1.15), ("motor.resistance_ohm", 1.39)] {
        let number = of_file(key);
        let found = number.corrected / number.nominal.expect("it stands there");
        assert!((found / times - 1.0).abs() < 0.01, "{key}: {found} times what the file says, of {times}");
    }
}

/// A radius and a distance that are both wrong look like a camera that measures too short, until the other numbers of the file
/// are looked at: beside that camera they would be many stated sigmas off.
#[test]
fn a_file_that_is_wrong_in_five_numbers_is_not_taken_for_a_camera_that_measures_too_short() {
    let (session, label) =
        Case { suite: Suite::Several, number: 104, seed: 12_405_274_600_837_492_184, fresh: false }.made();
    let report = answered(&session).expect("an answer");
    let mut hidden: Vec<&str> = label.hidden.iter().map(|hidden| hidden.cause.as_str()).collect();
    hidden.sort_unstable();
    assert_eq!(named(&report), hidden);
    assert_eq!((report.verdict, hidden.len()), (Verdict::Parameter, 5));
}

/// Mass, torque constant, inertia and frictions can all be larger alike without a log that shows it: only what is stated says
/// which of them is wrong. Windows whose start is bent by friction once kept a fit from going along that line at all.
#[test]
fn a_mass_that_is_a_tenth_off_is_told_by_what_is_stated_of_all_that_goes_with_it() {
    let (session, label) =
        Case { suite: Suite::Laboratory, number: 240, seed: 15_888_145_756_125_126_740, fresh: false }.made();
    assert_eq!(label.hidden[0].cause, "mass");
    let report = answered(&session).expect("an answer");
    assert_eq!(named(&report), ["mass"]);
    let mass = &report.which[0].parameters["mass_kg"];
    let (truth, std) = (7.791, mass.std.expect("fitted"));
    assert!((mass.value - truth).abs() < 2.0 * std && std < 0.05 * truth, "{mass:?}");
}

#[test]
fn of_two_effects_the_one_that_explains_more_stands_first_and_both_are_probable() {
    let report = diagnosed(&[("coriolis", 0.6), ("camera_latency", 1.0)]);
    assert_eq!(named(&report), ["camera_latency", "coriolis"]);
    let probability = |id: &str| report.which.iter().find(|w| w.cause == id).expect("named").probability;
    assert!(probability("coriolis").min(probability("camera_latency")) > 0.01);
    assert!(probability(&report.causes[0]) >= probability(&report.causes[1]));
}

#[test]
fn coriolis_terms_of_a_robot_whose_mass_does_not_all_turn_have_their_share() {
    let report = diagnosed(&[("coriolis", 0.4)]);
    assert_eq!(named(&report), ["coriolis"]);
    let factor = &report.which[0].parameters["factor"];
    assert!((factor.value - 0.4).abs() < 3.0 * factor.std.expect("fitted") + 0.01, "{factor:?}");
}

/// Radius and distance of all wheels can imitate a camera that measures too short, if both are off by many stated sigmas.
#[test]
fn a_scale_of_the_camera_is_named_though_numbers_far_from_what_is_stated_predict_as_well() {
    let (session, label) =
        Case { suite: Suite::Life, number: 185, seed: 7_517_567_691_400_772_304, fresh: false }.made();
    assert_eq!(label.hidden[0].cause, "camera_scale");
    assert_eq!(named(&answered(&session).expect("an answer")), ["camera_scale"]);
}

/// A load that swings is in no catalogue. A friction predicts a few lucky windows better, which is no reason to name it.
#[test]
fn a_number_that_predicts_better_by_chance_alone_is_not_named() {
    let (session, label) =
        Case { suite: Suite::Open, number: 16, seed: 4_590_677_401_489_147_919, fresh: false }.made();
    assert_eq!(label.foreign.as_deref(), Some("swinging_load"));
    assert_eq!(answered(&session).expect("an answer").verdict, Verdict::Unknown);
}
