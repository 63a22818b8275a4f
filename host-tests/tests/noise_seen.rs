//! Noise of another size than is stated, and with a memory, is found in recordings, and is taken for no cause and no gap.

use ground_truth::causes::cause;
use ground_truth::logging::Logging;
use ground_truth::recording::{Plan, Session};
use ground_truth::robot_file::{Noise, RobotFile};
use host_tests::laboratory::cases::PLAN;
use host_tests::laboratory::through_files::answered;
use omni_gap::Verdict;
use omni_gap::report::Report;

/// The paper's robot, its sensors so many times as noisy as its file says, with this memory [s].
fn diagnosed(factor: Noise, memory: Noise, hidden: Option<&str>) -> Report {
    let file = RobotFile::paper(0.0);
    let mut setup = file.setup();
    if let Some(cause) = hidden.and_then(cause) {
        (cause.put)(&mut setup, None, 1.0);
    }
    let plan = Plan { duration: 4.0, ..PLAN };
    let logging = Logging { noise_factor: factor, correlation: memory, ..Logging::clean() };
    answered(&Session::logged((&file, &setup), &plan, &logging, 11)).expect("an answer")
}

const LOUD: Noise = Noise { current: 2.0, wheel_speed: 2.4, position: 0.5, heading: 1.0, gyro: 1.0 };
const MEMORY: Noise = Noise { current: 0.02, wheel_speed: 0.0, position: 0.0, heading: 0.0, gyro: 0.0 };

/// Of a sensor, found over stated, and its memory [s].
fn found(report: &Report, sensor: &str) -> (f64, f64) {
    let noise = report.noise.iter().find(|noise| noise.sensor == sensor).expect("it is logged");
    (noise.found / noise.stated, noise.correlation_time_s)
}

#[test]
fn a_healthy_robot_with_other_noise_than_stated_has_no_gap() {
    let report = diagnosed(LOUD, MEMORY, None);
    assert_eq!(report.verdict, Verdict::NoGap, "{:?}", report.causes);
    // four runs of 4 s: currents remember over 20 ms, so that some 800 of them are their own; a tenth is three errors
    for (sensor, factor) in [("current", 2.0), ("wheel_speed", 2.4), ("position", 0.5), ("heading", 1.0)] {
        let (over, _) = found(&report, sensor);
        assert!((over / factor - 1.0).abs() < 0.1, "{sensor}: {over} of {factor}");
    }
    let (_, memory) = found(&report, "current");
    assert!((0.015..0.025).contains(&memory), "{memory} s of 20 ms");
    assert_eq!(found(&report, "wheel_speed").1, 0.0);
}

#[test]
fn a_cause_is_found_under_it_and_not_mistaken_for_noise() {
    let report = diagnosed(LOUD, MEMORY, Some("dead_time"));
    assert_eq!(report.causes.first().map(String::as_str), Some("dead_time"), "{:?}", report.verdict);
    let (over, _) = found(&report, "current");
    assert!((over / 2.0 - 1.0).abs() < 0.15, "{over}");
}

#[test]
fn noise_as_stated_is_told_as_stated() {
    let one = Noise { current: 1.0, wheel_speed: 1.0, position: 1.0, heading: 1.0, gyro: 1.0 };
    let none = Noise { current: 0.0, ..MEMORY };
    let report = diagnosed(one, none, None);
    assert_eq!(report.verdict, Verdict::NoGap);
    assert!(report.noise.iter().all(|noise| noise.found == noise.stated && noise.correlation_time_s == 0.0));
}
