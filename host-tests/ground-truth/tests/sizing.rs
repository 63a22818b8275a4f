//! Gaps are what they are said to be, and causes get the size that makes them.

use ground_truth::causes::{CAUSES, cause};
use ground_truth::drawn_robot::DrawnRobot;
use ground_truth::driving::{Driver, Style};
use ground_truth::gap::{ROW_S, gap, predicted};
use ground_truth::reading::{Pace, apart, drive};
use ground_truth::robot_file::RobotFile;
use ground_truth::sizing::{BOUNDS, Trial};

fn trial(truth: &RobotFile) -> Trial<'_> {
    Trial { truth, voltage: truth.supply / 1.5, style: Style::Excitation, seed: 11, seconds: 2.0, row: ROW_S }
}

#[test]
fn a_robot_that_is_what_its_file_says_has_no_gap() {
    for seed in [1, 2, 3] {
        let robot = DrawnRobot::new(seed).truth;
        let none = trial(&robot).gap(&robot.setup());
        // what is left: a drive's windows begin at the truth, but for friction's own memory of a step
        assert!(none < 0.02, "{none} σ");
    }
}

#[test]
fn a_bias_is_a_gap_of_its_own_size_over_its_noise() {
    let robot = RobotFile::paper(0.0);
    let mut biased = robot.setup();
    biased.sensors.gyro_bias = 7.0 * robot.noise.gyro;
    let found = gap(&robot, &biased, &mut Driver::new(&robot, 8.0, Style::Excitation, 5), (4.0, ROW_S));
    assert!((found - 7.0).abs() < 0.01, "{found}");
}

#[test]
fn a_prediction_begins_anew_every_half_second() {
    let robot = RobotFile::paper(0.0);
    let mut heavier = robot.setup();
    heavier.robot.chassis.mass *= 1.3;
    let mut driver = Driver::new(&robot, 8.0, Style::Excitation, 3);
    let pace = Pace { row: 5e-3, steps: 50 };
    let drawn = drive(&heavier, pace, 250, |k, moving| driver.command(k as f64 * 5e-3, moving.pose()));
    let predicted = predicted(&robot.setup(), &drawn, 5e-3);
    assert_eq!(predicted.len(), drawn.len());
    for k in [0, 100, 200] {
        assert!(apart(&drawn[k..=k], &predicted[k..=k], &robot.noise) < 1e-9, "row {k}");
        assert!(k == 0 || apart(&drawn[k - 1..k], &predicted[k - 1..k], &robot.noise) > 0.1, "row before {k}");
    }
}

#[test]
fn causes_get_the_size_that_makes_the_gap_that_is_asked_for() {
    let robot = DrawnRobot::new(4).truth;
    let trial = trial(&robot);
    for (id, asked) in [("dead_time", 5.0), ("coriolis", 2.0), ("mass", 10.0), ("encoder_lag", 12.0)] {
        let sized = trial.sized(cause(id).expect("a cause"), None, asked);
        assert!((sized.gap / asked - 1.0).abs() < 0.12, "{id}: {sized:?}");
        assert!((BOUNDS.0..=BOUNDS.1).contains(&sized.times), "{id}: {sized:?}");
    }
}

#[test]
fn every_cause_moves_a_robot_of_any_size_by_a_finite_gap() {
    for seed in [21, 22] {
        let robot = DrawnRobot::new(seed).truth;
        let trial = trial(&robot);
        for cause in CAUSES {
            // a limit that is typical may be one that this robot never reaches
            let gap = trial.gap(&trial.with(cause, cause.one_wheel.then_some(1), BOUNDS.1));
            println!("{:26} {:5.1} kg {gap:9.3} σ", cause.id, robot.mass);
            assert!(gap.is_finite() && gap > 1e-2, "{} of a robot of {} kg: {gap}", cause.id, robot.mass);
        }
    }
}
