//! Drives that control speed, on a robot that moves: closed forms, limits, and what a model of them misses.

use ground_truth::causes::{DRIVE_CAUSES, cause};
use ground_truth::drawn_robot::DrawnRobot;
use ground_truth::driving::{Driver, Style};
use ground_truth::reading::{Pace, drive};
use ground_truth::robot_file::{RobotFile, SpeedLoop};
use ground_truth::setup::Setup;
use ground_truth::simulation::Simulation;
use ground_truth::sizing::Trial;

/// A step, and how often drives look [s]
const STEP: f64 = 1e-4;

/// The paper's robot, its drives told nothing but to follow.
fn paper() -> RobotFile {
    RobotFile { drive: Some(SpeedLoop::default()), ..RobotFile::paper(0.0) }
}

/// The same without friction, and without an integral part.
fn free() -> Setup {
    let mut setup = paper().setup();
    setup.robot = setup.robot.without_friction();
    setup.robot.drive.as_mut().expect("a drive").integral_time = f64::INFINITY;
    setup
}

/// Speeds of a wheel that is told a speed [rad/s] from rest, straight to the side, after so many seconds each.
fn aside(setup: &Setup, speed: f64, seconds: &[f64]) -> Vec<f64> {
    let mut moving = Simulation::new(setup.robot.clone(), STEP);
    let until = |seconds: &f64| {
        let steps = ((seconds - moving.time()) / STEP).round() as usize;
        moving.hold(&[speed, 0.0, -speed, 0.0], steps);
        moving.wheel_speed(0)
    };
    seconds.iter().map(until).collect()
}

#[test]
fn a_robot_s_wheels_answer_as_the_lag_that_the_drive_is_tuned_to() {
    let mut setup = free();
    let drive = setup.robot.drive.as_mut().expect("a drive");
    let time = drive.inertial / drive.induced;
    // M·r²·R/(2·l²·Kt·Kv), by hand
    assert!((time - 2.34 * 0.0325 * 0.0325 * 4.3111 / (2.0 * 25.0 * 0.0259 * 0.0259)).abs() < 1e-12);
    drive.tune(0.05);
    drive.integral_time = f64::INFINITY;
    let at = [0.02, 0.05, 0.1, 0.3];
    for (speed, t) in aside(&setup, 5.0, &at).into_iter().zip(at) {
        let expected = 5.0 * -libm::expm1(-t / 0.05);
        // a voltage that is held for a step is half a step late
        assert!((speed - expected).abs() < 5.0 / 0.05 * STEP, "{t} s: {speed} against {expected}");
    }
}

#[test]
fn nothing_is_heard_for_a_dead_time_and_then_it_is_the_same() {
    let (mut late, at) = (free(), [0.01, 0.02, 0.04]);
    let soon = aside(&late, 5.0, &at);
    late.robot.drive.as_mut().expect("a drive").dead_time = 0.03;
    assert_eq!(aside(&late, 5.0, &[0.01, 0.03]), [0.0, 0.0]);
    for (late, soon) in aside(&late, 5.0, &at.map(|t| t + 0.03)).into_iter().zip(soon) {
        assert!((late - soon).abs() < 1e-9);
    }
}

#[test]
fn friction_keeps_a_drive_short_by_its_voltage_over_the_stiffness_until_an_integral_part_takes_over() {
    let mut setup = paper().setup();
    let drive = setup.robot.drive.as_mut().expect("a drive");
    drive.integral_time = f64::INFINITY;
    let stiffness = drive.induced + drive.proportional;
    let short = 10.0 - aside(&setup, 10.0, &[1.0])[0];
    // two wheels bear C and B·vn: u_L = R·F·r/(2·l·Kt)
    let force = 2.2198 + 0.6763 * (10.0 - short) * 0.0325;
    let expected = 4.3111 * force * 0.0325 / (2.0 * 5.0 * 0.0259) / stiffness;
    assert!((short / expected - 1.0).abs() < 1e-3, "{short} against {expected}");
    setup.robot.drive = paper().setup().robot.drive;
    let short = 10.0 - aside(&setup, 10.0, &[1.0])[0];
    assert!(short.abs() < 1e-6, "{short}");
}

#[test]
fn a_drive_gives_no_more_than_its_supply_and_its_current() {
    let setup = free();
    let moving = || Simulation::new(setup.robot.clone(), STEP);
    let limit = setup.robot.wheels[0].bridge.current_limit;
    // a jump to full speed asks for all that there is: the speed rises along a straight line at first
    let mut jump = moving();
    jump.hold(&[40.0, 0.0, -40.0, 0.0], 100);
    assert!(jump.driving_currents().iter().all(|i| i.abs() <= limit * (1.0 + 1e-12)));
    // 2·l·Kt·i/r on M, for 10 ms
    let expected = 2.0 * 5.0 * 0.0259 * limit / 0.0325 / 2.34 * 0.01 / 0.0325;
    assert!((jump.wheel_speed(0) / expected - 1.0).abs() < 0.02, "{} against {expected}", jump.wheel_speed(0));
    // and no wheel gets beyond where a motor idles at the whole supply
    let idle = 12.0 / (5.0 * 0.0259);
    let fast = aside(&setup, 200.0, &[5.0])[0];
    assert!((fast / idle - 1.0).abs() < 1e-3, "{fast} against {idle}");
}

#[test]
fn a_file_tells_its_drive_s_numbers_and_is_silent_of_one_that_follows_at_once() {
    assert!(!paper().toml().contains("speed_loop"));
    let told = RobotFile { drive: Some(SpeedLoop { dead_time: 0.02, lag: 0.05, line: 0.0 }), ..paper() };
    assert!(told.toml().ends_with("[effects.speed_loop]\ndead_time_s = 0.02\nlag_s = 0.05\ndroop = 0.0\n"));
}

#[test]
fn a_drive_that_goes_along_lines_is_where_its_log_says() {
    let quick = RobotFile { drive: Some(SpeedLoop { line: 1e-3, ..SpeedLoop::default() }), ..RobotFile::paper(45.0) };
    let setup = quick.setup();
    let mut driver = Driver::new(&quick, 8.0, Style::SetPoints { ramp: 1.5 }, 5);
    let pace = Pace { row: 1e-3, steps: 10 };
    let rows = drive(&setup, pace, 4000, |k, moving| driver.command(k as f64 * 1e-3, moving.pose()));
    let pairs = rows.iter().flat_map(|row| row.command.iter().zip(&row.wheel_speeds));
    let (sum, most) =
        pairs.clone().fold((0.0, 0.0), |(sum, most), (set, w)| (sum + (set - w).powi(2), f64::max(most, *set)));
    let off = (sum / pairs.count() as f64).sqrt();
    println!("{off} rad/s");
    assert!(most > 10.0 && off < 0.02, "{off} rad/s of {most}");
}

/// What is driven with rows of 1 ms, by a robot without a gyro.
fn trial(truth: &RobotFile) -> Trial<'_> {
    let style = Style::SetPoints { ramp: 1.5 };
    Trial { truth, voltage: truth.supply / 1.5, style, seed: 11, seconds: 4.0, row: 1e-3 }
}

/// A robot without a gyro, whose file says this of its drive.
fn drawn(seed: u64, drive: SpeedLoop) -> RobotFile {
    let mut robot = RobotFile { drive: Some(drive), ..DrawnRobot::new(seed).truth };
    robot.noise.gyro = f64::INFINITY;
    robot
}

#[test]
fn what_a_file_tells_of_its_drive_leaves_little_and_what_it_does_not_tell_is_a_gap() {
    let (mut known, mut quick) = (Vec::new(), Vec::new());
    for seed in 1..=12 {
        let told = drawn(seed, SpeedLoop { dead_time: 0.03, lag: 0.06, line: 0.0 });
        let silent = drawn(seed, SpeedLoop { line: 1e-3, ..SpeedLoop::default() });
        for (truth, all) in [(&told, &mut known), (&silent, &mut quick)] {
            let calm = trial(truth).calmed();
            let Style::SetPoints { ramp } = calm.style else { panic!("another style") };
            let gap = calm.gap(&truth.setup());
            println!("{seed}: {gap:.3} σ with ramps of {ramp} s");
            all.push(gap);
        }
        let unknown = trial(&silent).calmed().gap(&told.setup());
        assert!(unknown > 4.0, "{unknown}");
    }
    for all in [known, quick] {
        assert!(all.iter().all(|gap| *gap < 0.1), "{all:?}");
        assert!(all.iter().filter(|gap| **gap < 0.05).count() >= 10, "{all:?}");
    }
}

#[test]
fn what_is_wrong_with_a_drive_makes_a_gap_that_grows() {
    let robot = drawn(4, SpeedLoop { line: 1e-3, ..SpeedLoop::default() });
    let trial = trial(&robot).calmed();
    for one in DRIVE_CAUSES {
        let [none, half, once, twice] = [0.0, 0.5, 1.0, 2.0].map(|times| trial.gap(&trial.with(one, None, times)));
        println!("{:18} {none:.2} {half:.2} {once:.2} {twice:.2} σ", one.id);
        assert!(none < half && half < once && once < twice && once > 1.5, "{}: {none} {half} {once} {twice}", one.id);
    }
    assert!(cause("speed_loop").is_some());
}
