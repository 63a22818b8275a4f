//! What holds for every robot, whatever it is made of.

#[path = "support/rich.rs"]
mod rich;

use ground_truth::paper::four_wheels;
use ground_truth::robot::Robot;
use ground_truth::simulation::Simulation;
use nalgebra::{Vector2, Vector3};
use rich::all_there_is;

/// A second of steps and reversals [V], in pieces of 20 ms.
fn drive(moving: &mut Simulation, step: f64) {
    let pieces = 50;
    let steps = (1.0 / (step * f64::from(pieces))).round() as usize;
    for piece in 0..pieces {
        let u = if (piece / 12) % 2 == 0 { 7.0 } else { -5.0 };
        moving.hold(&[u, 0.4 * u, -u, 2.0], steps);
    }
}

/// Largest difference between where two robots are and how they move.
fn apart(a: &Simulation, b: &Simulation) -> f64 {
    let of = |moving: &Simulation| [moving.pose(), moving.twist()].concat();
    of(a).iter().zip(of(b)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn it_moves_alike_whichever_point_is_followed() {
    let mut robot = four_wheels().without_friction();
    robot.chassis.transport = 1.0;
    robot.chassis.centre_of_mass = Vector2::new(0.01, -0.015);
    let moved = |step: f64, point: [f64; 2]| {
        let mut moving = Simulation::following(robot.clone(), step, point.into());
        drive(&mut moving, step);
        moving
    };
    for point in [[0.01, -0.015], [0.3, 0.1]] {
        let far = apart(&moved(1e-4, [0.0; 2]), &moved(1e-4, point));
        let near = apart(&moved(5e-5, [0.0; 2]), &moved(5e-5, point));
        // of second order in the step, and nothing else
        assert!(near < 1e-5 && (3.0..5.0).contains(&(far / near)), "{point:?}: {far} and {near}");
    }
}

#[test]
fn left_alone_it_only_loses_energy() {
    let step = 5e-5;
    let mut moving = Simulation::new(all_there_is(), step);
    moving.set_moving(Vector3::new(0.8, -0.6, 6.0));
    moving.set_wheel_turning(2, -50.0);
    let mut before = moving.energy();
    for _ in 0..10_000 {
        moving.hold(&[0.0; 4], 1);
        let now = moving.energy();
        assert!(now <= before * (1.0 + 1e-9), "{now} J after {before} J at {} s", moving.time());
        before = now;
    }
    assert!(moving.energy() < 1e-3, "it still moves: {}", moving.energy());
}

#[test]
fn halving_the_step_changes_less_than_a_step_of_friction() {
    let moved = |robot: &Robot, step: f64| {
        let mut moving = Simulation::new(robot.clone(), step);
        drive(&mut moving, step);
        moving
    };
    // [m/s, rad/s per s of a step]
    for (robot, most) in [(four_wheels(), 0.5), (all_there_is(), 2.0)] {
        for step in [2e-4, 1e-4, 5e-5] {
            let halved = apart(&moved(&robot, step), &moved(&robot, 0.5 * step));
            // where an axis turns round within a step, friction is that of one side: 2·C/M·Δt at the most
            assert!(halved < most * step, "{halved} at {step} s");
        }
    }
}

#[test]
fn a_robot_turned_by_a_quarter_moves_the_same_way() {
    let robot = all_there_is();
    let mut turned = robot.clone();
    for wheel in &mut turned.wheels {
        wheel.heading += std::f64::consts::FRAC_PI_2;
        wheel.contact = Vector2::new(-wheel.contact.y, wheel.contact.x);
    }
    let friction = turned.chassis.friction.coulomb;
    turned.chassis.friction.coulomb = Vector3::new(friction.y, friction.x, friction.z);
    let friction = turned.chassis.friction.viscous;
    turned.chassis.friction.viscous = Vector3::new(friction.y, friction.x, friction.z);
    let [mut a, mut b] = [robot, turned].map(|robot| Simulation::new(robot, 1e-4));
    drive(&mut a, 1e-4);
    drive(&mut b, 1e-4);
    let ([x, y, theta], [v, vn, w]) = (a.pose(), a.twist());
    for (left, right) in b.pose().into_iter().chain(b.twist()).zip([-y, x, theta, -vn, v, w]) {
        // rounding may divide another step into parts
        assert!((left - right).abs() < 1e-5, "{left} against {right}");
    }
}
