//! Oddities on a robot that moves: closed forms, limits, and what they must not do.

use ground_truth::contact::{GRAVITY, Grip, Slip};
use ground_truth::foreign::foreign;
use ground_truth::oddities::drive::Foldback;
use ground_truth::oddities::floor::{Planks, Ridge};
use ground_truth::oddities::gusts::Gusts;
use ground_truth::oddities::load::Load;
use ground_truth::oddities::towed::Towed;
use ground_truth::oddities::wheel::{Hub, Tooth};
use ground_truth::paper::four_wheels;
use ground_truth::robot::Robot;
use ground_truth::robot_file::RobotFile;
use ground_truth::shaft::Shaft;
use ground_truth::simulation::Simulation;
use nalgebra::{Vector2, Vector3};

/// A step [s]
const STEP: f64 = 2e-5;

/// A floor on which nothing holds.
const ICE: Slip = Slip { static_friction: 0.0, kinetic_friction: 0.0, stribeck_speed: 1.0, creep: 0.0, stiffness: 1e5 };

/// On wheels that roll, with open bridges and without friction, as nature has it.
fn free() -> Robot {
    let mut robot = four_wheels().without_friction();
    robot.chassis.transport = 1.0;
    robot.wheels.iter_mut().for_each(|wheel| wheel.motor.resistance = f64::INFINITY);
    robot
}

/// A robot whose wheels nothing turns.
fn blocked() -> Robot {
    let mut robot = four_wheels();
    robot.chassis.friction.coulomb = Vector3::repeat(1e3);
    robot
}

/// The load of the mechanical ones.
const LOAD: Load = Load { mass: 0.5, stiffness: 120.0, damping: 0.0 };

#[test]
fn a_load_and_its_robot_swing_about_their_common_centre() {
    let mut robot = free();
    robot.oddities.load = Some(LOAD);
    let mass = robot.chassis.mass;
    let mut swinging = Simulation::new(robot, STEP);
    swinging.set_moving(Vector3::new(0.6, 0.0, 0.0));
    let mean = 0.6 * mass / (mass + LOAD.mass);
    // ω² = k·(1/M + 1/m)
    let frequency = (LOAD.stiffness * (1.0 / mass + 1.0 / LOAD.mass)).sqrt();
    for k in 1..=50 {
        swinging.hold(&[0.0; 4], 500);
        let expected = mean + (0.6 - mean) * (frequency * f64::from(k) * 500.0 * STEP).cos();
        assert!((swinging.twist()[0] - expected).abs() < 1e-6, "{:?} against {expected}", swinging.twist());
    }
}

#[test]
fn a_load_that_is_held_fast_is_the_robot_as_it_was() {
    for transport in [0.0, 1.0] {
        let mut setup = RobotFile::paper(0.0).setup();
        setup.robot.chassis.transport = transport;
        let mut plain = Simulation::new(setup.robot.clone(), STEP);
        (foreign("swinging_load").expect("a kind").put)(&mut setup, 1.0, 0);
        let load = setup.robot.oddities.load.as_mut().expect("a load");
        load.stiffness *= 2e4;
        // it does not swing
        load.damping = 2.0 * (load.stiffness * load.mass).sqrt();
        let mut held = Simulation::new(setup.robot, STEP);
        for piece in 0..50 {
            let u = if (piece / 12) % 2 == 0 { 7.0 } else { -5.0 };
            for moving in [&mut plain, &mut held] {
                moving.hold(&[u, 0.4 * u, -u, 2.0], 1_000);
            }
        }
        let apart = plain.twist().into_iter().zip(held.twist()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-3, "{apart} at {transport}: {:?} {:?}", plain.twist(), held.twist());
    }
}

/// All that acts on the mechanics at once.
fn all_mechanical(mut robot: Robot) -> Robot {
    let across = Vector2::new(0.6, 0.8);
    robot.oddities.load = Some(LOAD);
    robot.oddities.towed =
        Some(Towed { hitch: Vector2::new(-0.08, 0.03), length: 0.05, friction: 0.4, stiffness: 300.0 });
    robot.oddities.planks = Some(Planks { across, friction: 0.5, onset_speed: 0.03 });
    robot.oddities.ridge = Some(Ridge { across, at: 0.1, height: 0.004, width: 0.02 });
    robot.oddities.tooth = Some(Tooth { wheel: 1, energy: 0.02, at: 1.0, width: 0.1 });
    robot
}

#[test]
fn left_alone_they_only_take_energy() {
    let mut robot = all_mechanical(free());
    for wheel in &mut robot.wheels {
        (wheel.inertia, wheel.motor.rotor_inertia) = (5e-6, 4e-7);
        wheel.shaft = Shaft::Elastic { stiffness: 200.0, damping: 0.04, play: 0.0 };
    }
    robot.oddities.hub = Some(Hub { wheel: 2, holds: 2e-4 });
    robot.oddities.load = Some(Load { damping: 0.5, ..LOAD });
    let mut moving = Simulation::new(robot, STEP);
    moving.set_moving(Vector3::new(0.8, -0.6, 6.0));
    let first = moving.energy();
    let mut before = first;
    for _ in 0..100_000 {
        moving.hold(&[0.0; 4], 1);
        let now = moving.energy();
        assert!(now <= before + 1e-7 * first, "{now} J after {before} J at {} s", moving.time());
        before = now;
    }
    assert!(before < 0.7 * first, "{before} J of {first} J are left");
}

#[test]
fn a_load_a_ridge_and_a_tooth_keep_all_energy() {
    let mut robot = all_mechanical(free());
    (robot.oddities.towed, robot.oddities.planks) = (None, None);
    let mut moving = Simulation::new(robot, STEP);
    moving.set_moving(Vector3::new(0.8, -0.6, 6.0));
    let first = moving.energy();
    let (mut most, mut slowest, mut fastest) = (0.0_f64, f64::INFINITY, 0.0_f64);
    for _ in 0..50_000 {
        moving.hold(&[0.0; 4], 1);
        most = most.max((moving.energy() - first).abs());
        (slowest, fastest) = (slowest.min(moving.twist()[2]), fastest.max(moving.twist()[2]));
    }
    assert!(most < 1e-5 * first, "{most} J of {first} J");
    // the tooth alone changes the yaw of 6 rad/s by E/(J·ω)
    assert!(fastest - slowest > 0.05, "nothing is in its way: {slowest} to {fastest}");
}

#[test]
fn over_a_ridge_a_wheel_climbs_as_high_as_its_speed_pays_for() {
    let mut robot = free();
    let ridge = Ridge { across: Vector2::x(), at: 0.5, height: 0.004, width: 0.01 };
    robot.oddities.ridge = Some(ridge);
    let mass = robot.chassis.mass;
    // the wheel ahead alone stands on top of it
    let ahead = robot.wheels.iter().map(|wheel| wheel.contact.x).fold(0.0, f64::max);
    let mut climbing = Simulation::new(robot, STEP);
    climbing.set_moving(Vector3::new(0.5, 0.0, 0.0));
    while climbing.pose()[0] < 0.5 - ahead {
        climbing.hold(&[0.0; 4], 1);
    }
    // v² = v₀² − 2·g·H/4
    let expected = (0.25 - 0.5 * GRAVITY * 0.004 * mass / mass).sqrt();
    assert!((climbing.twist()[0] - expected).abs() < 1e-5, "{:?} against {expected}", climbing.twist());
    climbing.hold(&[0.0; 4], 50_000);
    assert!((climbing.twist()[0] - 0.5).abs() < 1e-6 && climbing.twist()[2].abs() < 1e-9, "{:?}", climbing.twist());
}

#[test]
fn gusts_move_a_free_robot_as_their_impulse_says() {
    let mut robot = free();
    robot.wheels.iter_mut().for_each(|wheel| wheel.grip = Grip::Slips(ICE));
    let (gusts, mass) = (Gusts::drawn(0.5, (0.3, 3.0), 4), robot.chassis.mass);
    (robot.oddities.gusts, robot.oddities.clock) = (Some(gusts.clone()), 17.0);
    let mut blown = Simulation::new(robot, STEP);
    blown.hold(&[0.0; 4], 50_000);
    let impulse: Vector2<f64> = (0..10_000).map(|k| 1e-4 * gusts.at(17.0 + 1e-4 * (f64::from(k) + 0.5))).sum();
    let [v, vn, w] = blown.twist();
    assert!((Vector2::new(v, vn) - impulse / mass).norm() < 1e-6 && w.abs() < 1e-9, "{:?}", blown.twist());
}

#[test]
fn all_of_them_move_a_robot_alike_whichever_point_is_followed() {
    let mut robot = four_wheels().without_friction();
    (robot.chassis.transport, robot.chassis.centre_of_mass) = (1.0, Vector2::new(0.01, -0.015));
    let mut robot = all_mechanical(robot);
    robot.oddities.gusts = Some(Gusts::drawn(0.5, (0.3, 3.0), 4));
    let moved = |point: [f64; 2]| {
        let mut moving = Simulation::following(robot.clone(), STEP, point.into());
        for piece in 0..40 {
            let u = if (piece / 12) % 2 == 0 { 7.0 } else { -5.0 };
            moving.hold(&[u, 0.4 * u, -u, 2.0], 1_000);
        }
        [moving.pose(), moving.twist()].concat()
    };
    let centre = moved([0.0; 2]);
    for point in [[0.01, -0.015], [0.3, 0.1]] {
        let apart = centre.iter().zip(moved(point)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-4, "{point:?}: {apart}");
    }
}

#[test]
fn a_hub_that_slips_lets_its_motor_run_at_the_torque_that_it_holds() {
    let mut robot = blocked();
    let holds = 0.1;
    for wheel in &mut robot.wheels {
        (wheel.inertia, wheel.motor.rotor_inertia) = (5e-6, 4e-7);
        wheel.shaft = Shaft::Elastic { stiffness: 200.0, damping: 0.04, play: 0.0 };
    }
    robot.oddities.hub = Some(Hub { wheel: 1, holds });
    let (motor, ratio) = (robot.wheels[1].motor.clone(), robot.wheels[1].gear_ratio);
    let mut held = Simulation::new(robot, STEP);
    held.hold(&[8.0; 4], 100_000);
    // l·Kt·i = τ_h, the others stand
    let expected = [8.0 / motor.resistance, holds / (ratio * motor.torque_constant)];
    for (current, expected) in held.currents(&[8.0; 4]).into_iter().zip(expected) {
        assert!((current - expected).abs() < 1e-6 * expected, "{current} against {expected}");
    }
    assert!(held.wheel_speed(1).abs() < 1e-9);
}

#[test]
fn a_drive_that_lets_go_coasts_as_with_open_bridges() {
    let mut robot = four_wheels();
    robot.oddities.coasts_below = 0.5;
    let mut open = four_wheels();
    open.wheels.iter_mut().for_each(|wheel| wheel.motor.resistance = f64::INFINITY);
    let [mut coasting, mut open] = [robot, open].map(|robot| Simulation::new(robot, STEP));
    for moving in [&mut coasting, &mut open] {
        moving.set_moving(Vector3::new(0.8, -0.5, 5.0));
        moving.hold(&[0.4, -0.4, 0.0, 0.2], 20_000);
    }
    assert_eq!(coasting.currents(&[0.4; 4]), [0.0; 4]);
    let apart = coasting.pose().into_iter().zip(open.pose()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(apart < 1e-9, "{apart}");
    let stalled = 8.0 / four_wheels().wheels[0].motor.resistance;
    assert!(coasting.currents(&[8.0; 4])[0] > 0.3 * stalled, "above its threshold it drives");
}

#[test]
fn an_open_winding_forgets_what_its_inductance_held() {
    let mut robot = blocked();
    robot.oddities.coasts_below = 0.5;
    robot.wheels.iter_mut().for_each(|wheel| wheel.motor.inductance = 2e-3);
    let mut held = Simulation::new(robot, STEP);
    held.hold(&[8.0; 4], 1_000);
    assert!(held.currents(&[8.0; 4])[0] > 0.5);
    held.hold(&[0.0; 4], 1);
    assert_eq!(held.currents(&[0.0; 4]), [0.0; 4]);
    held.hold(&[0.0; 4], 2);
    assert!(held.energy() < 1e-12, "{} J", held.energy());
}

#[test]
fn a_lost_phase_is_felt_alike_with_an_inductance_and_without() {
    let mut setup = RobotFile::paper(0.0).setup();
    (foreign("lost_phase").expect("a kind").put)(&mut setup, 1.0, 0);
    let moved = |inductance: f64, sound: bool| {
        let mut robot = setup.robot.clone();
        robot.wheels.iter_mut().for_each(|wheel| wheel.motor.inductance = inductance);
        if sound {
            robot.oddities.lost_phase = None;
        }
        let mut moving = Simulation::new(robot, STEP);
        moving.hold(&[8.0, -3.0, -8.0, 5.0], 75_000);
        Vector3::from(moving.pose())
    };
    let felt = [0.0, 1e-4].map(|inductance| moved(inductance, false) - moved(inductance, true));
    assert!(felt[0].norm() > 0.02 && (felt[0] - felt[1]).norm() < 0.1 * felt[0].norm(), "{felt:?}");
}

#[test]
fn a_slow_converter_dips_and_gives_all_of_its_voltage_in_the_end() {
    let mut setup = RobotFile::paper(0.0).setup();
    (foreign("slow_converter").expect("a kind").put)(&mut setup, 1.0, 0);
    setup.robot.chassis.friction.coulomb = Vector3::repeat(1e3);
    let stalled = 8.0 / setup.robot.wheels[0].motor.resistance;
    let mut held = Simulation::new(setup.robot, STEP);
    let mut least = stalled;
    for _ in 0..50_000 {
        held.hold(&[8.0; 4], 1);
        least = least.min(held.driving_currents()[0]);
    }
    let last = held.driving_currents()[0];
    assert!(least < 0.9 * stalled && (last - stalled).abs() < 1e-3 * stalled, "{least} {last} of {stalled}");
}

#[test]
fn a_drive_takes_its_nearest_level_and_spares_its_motor_in_time() {
    let mut robot = blocked();
    let resistance = robot.wheels[0].motor.resistance;
    robot.oddities.levels = 0.75;
    let current = 8.25 / resistance;
    let trips = 0.5 * current * current;
    robot.oddities.foldback = Some(Foldback { time: 0.5, trips, resets: 0.1 * trips, share: 0.5 });
    let mut held = Simulation::new(robot, STEP);
    // 8.1 V are nearest to 8.25 V, and a half of them to 3.75 V; after τ·ln 2
    let before = 0.5 * std::f64::consts::LN_2;
    held.hold(&[8.1; 4], (before / STEP) as usize - 2);
    assert!((held.driving_currents()[0] - current).abs() < 1e-9);
    held.hold(&[8.1; 4], 5);
    assert!((held.driving_currents()[0] - 3.75 / resistance).abs() < 1e-9, "{:?}", held.driving_currents());
}
