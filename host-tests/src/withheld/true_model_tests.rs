//! The true model is true: what it says of a robot's recordings is what was recorded.

use ground_truth::causes::CAUSES;
use ground_truth::drawn_robot::DrawnRobot;
use ground_truth::driving::Style;
use ground_truth::logging::Logging;
use ground_truth::recording::{Plan, Session};
use ground_truth::robot_file::{Noise, SpeedLoop};
use omni_gap::localise::measure;
use omni_gap::simulate::{AlignedRun, Model, supply_seen};
use rayon::prelude::*;

use super::*;
use crate::laboratory::through_files;

const PLAN: Plan = Plan {
    runs: 1,
    duration: 3.0,
    rate: 500.0,
    camera_rate: 250.0,
    voltage: 8.0,
    gyro: true,
    style: Style::Excitation,
    unrest: None,
};

/// So that no delay is a whole number of rows, and a command comes just when one is read.
const TIMES: f64 = 1.03;

/// What a true model leaves of a gap, over the whole run from rest, where no start is guessed [1].
const LEFT: f64 = 0.05;

/// What a cause that is nearly nothing may leave [σ].
const NOTHING: f64 = 0.05;

/// What is left of effects that move what is read against the commands [1]: a start is read off a straight line across a jump
/// of the command, which says another speed where the jump shows later.
const STARTS: &[(&str, f64)] = &[("encoder_lag", 0.6), ("actuation_delay", 0.35)];

/// What a model with true numbers misses of a robot with a cause, and what the true model does, without noise [σ].
fn missed(robot: &DrawnRobot, cause: Option<&Cause>, wheel: Option<usize>) -> [f64; 2] {
    let mut setup = robot.truth.setup();
    let put: Vec<_> = cause.map(|cause| (cause, wheel)).into_iter().collect();
    for (cause, wheel) in &put {
        (cause.put)(&mut setup, *wheel, TIMES);
    }
    let quiet = Noise { current: 1e-3, wheel_speed: 1e-3, position: 1e-3, heading: 1e-3, gyro: 1e-3 };
    let logging = Logging { noise_factor: quiet, ..Logging::clean() };
    let plan = Plan { voltage: robot.truth.supply * 2.0 / 3.0, ..PLAN };
    let session = through_files::read(&Session::logged((&robot.truth, &setup), &plan, &logging, 7)).expect("a session");
    let run = AlignedRun::<4>::new(&session.runs[0], &session.robot).expect("a run with voltages");
    let supply = supply_seen([&run]);
    let truth = TrueModel::of(&robot.truth, &setup, &put).read().expect("a robot file");
    [&session.robot, &truth]
        .map(|robot| measure(&Model::<4>::nominal(robot, supply).plant(), &[&run], PLAN.duration + 1.0).total())
}

/// A heavy robot on four wheels at odd angles, so that nothing is once the paper's.
fn heavy() -> DrawnRobot {
    let is = |robot: &DrawnRobot| {
        let truth = &robot.truth;
        truth.mass > 10.0 && truth.wheels.len() == 4 && truth.wheels[0].0 % 5.0 != 0.0
    };
    (0..).map(DrawnRobot::new).find(is).expect("one in ten")
}

#[test]
fn of_every_effect_the_true_model_closes_the_gap_that_it_makes() {
    let robot = heavy();
    let [nothing, _] = missed(&robot, None, None);
    let asked: Vec<&Cause> = CAUSES.iter().filter(|cause| !OWN_LAWS.contains(&cause.id)).collect();
    let told = asked.par_iter().map(|cause| {
        let [before, truth] = missed(&robot, Some(cause), cause.one_wheel.then_some(2));
        println!("{:24} {before:8.3} σ → {truth:7.4} σ of {nothing:.4}", cause.id);
        (cause.id, before - nothing, truth - nothing)
    });
    let most = |id: &str| STARTS.iter().find(|(of, _)| *of == id).map_or(LEFT, |(_, most)| *most);
    let wrong: Vec<_> = told.filter(|(id, gap, left)| *left > (most(id) * gap).max(NOTHING)).collect();
    assert!(wrong.is_empty(), "otherwise than the catalogue has it: {wrong:?}");
}

#[test]
fn a_wrong_sign_or_another_wheel_is_no_true_model() {
    let robot = heavy();
    let cause = ground_truth::causes::cause("wheel_eccentricity").expect("a cause");
    let mut setup = robot.truth.setup();
    (cause.put)(&mut setup, Some(1), 2.0);
    let model = TrueModel::of(&robot.truth, &setup, &[(cause, Some(1))]);
    let read = model.read().expect("a robot file");
    let wave = &setup.robot.wheels[1].profile[0];
    assert_eq!(read.effects[0].wheel, Some(1));
    assert_eq!(read.effects[0].params["cosine_part"], wave.cosine);
    assert_eq!(read.effects[0].params["sine_part"], wave.sine);
    assert!(model.own_laws.is_empty() && model.out_of_bounds.is_empty());
}

#[test]
fn every_effect_has_its_numbers_and_numbers_are_those_of_the_robot() {
    let robot = heavy();
    for cause in CAUSES {
        let wheel = cause.one_wheel.then_some(1);
        let mut setup = robot.truth.setup();
        (cause.put)(&mut setup, wheel, 1.0);
        let model = TrueModel::of(&robot.truth, &setup, &[(cause, wheel)]);
        let read = model.read().unwrap_or_else(|why| panic!("{}: {why}", cause.id));
        assert_eq!(read.effects.len(), usize::from(cause.keys.is_empty()), "{}", cause.id);
        let params = read.effects.iter().all(|effect| !effect.params.is_empty());
        assert!(params, "{} has no numbers", cause.id);
        for key in cause.keys {
            let (is, was) = (read.nominal(key, 0), omni_gap_numbers(&robot.truth).nominal(key, 0));
            assert!((is.expect("a key") / was.expect("a key") - 1.0).abs() > 0.09, "{key} is as it was");
        }
    }
}

fn omni_gap_numbers(truth: &RobotFile) -> Read {
    read(&truth.toml(), Path::new("robot.toml")).expect("a robot file")
}

#[test]
fn drives_that_are_late_or_leave_small_speeds_out_are_told_by_their_numbers() {
    for (id, expected) in [
        ("speed_loop", &[("dead_time_s", 0.04), ("lag_s", 0.08), ("droop", 0.04)][..]),
        ("command_deadband", &[("threshold_rad_s", 0.0)]),
    ] {
        let cause = ground_truth::causes::cause(id).expect("one of its causes");
        let truth = RobotFile { drive: Some(SpeedLoop::default()), ..heavy().truth };
        let mut setup = truth.setup();
        (cause.put)(&mut setup, None, 2.0);
        let read = TrueModel::of(&truth, &setup, &[(cause, None)]).read().expect("a robot file");
        let params = &read.effects[0].params;
        for (key, value) in expected {
            let drive = setup.robot.drive.as_ref().expect("it controls speed");
            let value = if *key == "threshold_rad_s" { drive.threshold } else { *value };
            assert!((params[*key] - value).abs() < 1e-12 && value > 0.0, "{id}: {params:?}");
        }
    }
}
