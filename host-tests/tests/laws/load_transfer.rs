//! Load that an accelerating robot shifts from wheel to wheel, and one that is uneven: with every wheel spinning, the floor's
//! forces are those of statics.

use model_core::effects::active::Effects;
use model_core::effects::seams::STANDARD_GRAVITY;
use model_core::plant::robot::Robot;
use model_core::plant::{Input, Plant};
use nalgebra::{Matrix3, Vector3};

use crate::fixture::{Run, effect, three};
use crate::newton::frictionless;

const MU: f64 = 0.4;

/// What three wheels at 60°, 180° and −60° carry under a body that accelerates: forces and moments in balance [N].
fn loads(mass: f64, height: f64, distance: f64, acceleration: [f64; 2]) -> Vector3<f64> {
    let place = [60.0, 180.0, -60.0_f64].map(|a| {
        let (y, x) = a.to_radians().sin_cos();
        [distance * x, distance * y]
    });
    // ΣN = M·g,  ΣN·x = −M·h·a_x,  ΣN·y = −M·h·a_y
    let balance = Matrix3::from_fn(|row, j| if row == 0 { 1.0 } else { place[j][row - 1] });
    let [x, y] = acceleration;
    let wanted = Vector3::new(mass * STANDARD_GRAVITY, -mass * height * x, -mass * height * y);
    balance.lu().solve(&wanted).expect("three wheels in a triangle")
}

/// The acceleration (v, vn) and the angular one of three wheels that spin in these senses, on a floor that holds only so
/// much, with one more effect.
fn accelerates(robot: Robot<3, f64>, (id, wheel, size): (&str, Option<usize>, f64), senses: [f64; 3]) -> [f64; 3] {
    let mut effects = Effects::default();
    effects.add(effect("wheel_slip"), None, &[MU, 30.0, 1.0]).expect("room");
    effects.add(effect(id), wheel, &[size]).expect("room");
    let mut run = Run::new(Plant::new(robot, effects));
    // so fast that the slip curve is at its limit: 30·s = 10⁵
    let input = Input::Speed(senses.map(|sense| sense * 1e5));
    let dt = 1e-7;
    let mut last = [0.0; 3];
    for _ in 0..200 {
        last = run.twist();
        run.step(&input, dt);
    }
    std::array::from_fn(|axis| (run.twist()[axis] - last[axis]) / dt)
}

/// What wheels at 150°, 270° and 30° that spin in these senses do to a body under these loads:
/// M·a = Σ μ·N_j·s_j·(cos α_j, sin α_j), and the moment d·Σ μ·N_j·s_j.
fn pushed(robot: &Robot<3, f64>, load: Vector3<f64>, senses: [f64; 3]) -> [f64; 3] {
    let mut force = [0.0; 3];
    for (j, angle) in [150.0, 270.0, 30.0_f64].into_iter().enumerate() {
        let push = MU * load[j] * senses[j];
        let (sin, cos) = angle.to_radians().sin_cos();
        force[0] += push * cos;
        force[1] += push * sin;
        force[2] += push * robot.wheels.wheels()[0].distance;
    }
    [force[0] / robot.mass, force[1] / robot.mass, force[2] / robot.inertia]
}

fn agree(found: [f64; 3], wanted: [f64; 3]) {
    for axis in 0..3 {
        assert!((found[axis] - wanted[axis]).abs() < 1e-5 * (1.0 + wanted[axis].abs()), "{found:?}, {wanted:?}");
    }
}

const SENSES: [[f64; 3]; 3] = [[1.0, -1.0, 1.0], [1.0, 1.0, -1.0], [-1.0, 1.0, 1.0]];

#[test]
fn spinning_wheels_push_with_what_statics_leaves_them() {
    let robot = frictionless(three());
    for senses in SENSES {
        for height in [0.0, 0.02, 0.05] {
            let found = accelerates(robot, ("load_transfer", None, height), senses);
            let load = loads(robot.mass, height, robot.wheels.wheels()[0].distance, [found[0], found[1]]);
            agree(found, pushed(&robot, load, senses));
            if height > 0.0 {
                let level = robot.mass * STANDARD_GRAVITY / 3.0;
                assert!(load.iter().any(|n| (n - level).abs() > 0.02 * level), "a load shifts: {load}");
            }
        }
    }
}

#[test]
fn a_wheel_that_carries_less_pushes_less() {
    let robot = frictionless(three());
    let level = robot.mass * STANDARD_GRAVITY / 3.0;
    for senses in SENSES {
        for wheel in 0..3 {
            for share in [-0.4, 0.0, 0.5] {
                let mut load = Vector3::from_element(level);
                load[wheel] *= 1.0 + share;
                agree(accelerates(robot, ("uneven_load", Some(wheel), share), senses), pushed(&robot, load, senses));
            }
        }
    }
}
