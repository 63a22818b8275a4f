//! Load that an accelerating robot shifts from wheel to wheel: with every wheel spinning, the floor's forces are those of
//! statics.

use model_core::effects::seams::STANDARD_GRAVITY;
use model_core::plant::robot::{Friction, Robot};
use model_core::plant::{Input, paper};
use nalgebra::{Matrix3, Vector3};

use crate::effects::{Ability, LoadTransfer, Slippery, Way};

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

/// The acceleration (v, vn) and the angular one of three wheels that spin in these senses.
fn accelerates(robot: &Robot<3, f64>, height: f64, senses: [f64; 3]) -> [f64; 3] {
    let abilities = [Ability::Slippery(Slippery(MU)), Ability::LoadTransfer(LoadTransfer { height, wheels: 3.0 })];
    let mut way = Way::begin(*robot, &abilities, [0.0; 3]);
    // so fast that the slip curve is at its limit: 30·s = 10⁵
    let input = Input::Speed(senses.map(|sense| sense * 1e5));
    let dt = 1e-7;
    let mut last = [0.0; 3];
    for _ in 0..200 {
        last = way.state.twist.to_array();
        way.step(&input, dt);
    }
    let now = way.state.twist.to_array();
    std::array::from_fn(|axis| (now[axis] - last[axis]) / dt)
}

#[test]
fn spinning_wheels_push_with_what_statics_leaves_them() {
    let robot: Robot<3, f64> = Robot { friction: Friction::default(), ..paper::three_wheels() };
    let wheel = robot.wheels.wheels()[0];
    for senses in [[1.0, -1.0, 1.0], [1.0, 1.0, -1.0], [-1.0, 1.0, 1.0]] {
        for height in [0.0, 0.02, 0.05] {
            let found = accelerates(&robot, height, senses);
            let load = loads(robot.mass, height, wheel.distance, [found[0], found[1]]);
            // M·a = Σ μ·N_j·s_j·(cos α_j, sin α_j), and the moment d·Σ μ·N_j·s_j: what moves it is what it carries
            let mut force = [0.0; 3];
            for (j, angle) in [150.0, 270.0, 30.0_f64].into_iter().enumerate() {
                let push = MU * load[j] * senses[j];
                let (sin, cos) = angle.to_radians().sin_cos();
                force[0] += push * cos;
                force[1] += push * sin;
                force[2] += push * wheel.distance;
            }
            let wanted = [force[0] / robot.mass, force[1] / robot.mass, force[2] / robot.inertia];
            for axis in 0..3 {
                let within = 1e-5 * (1.0 + wanted[axis].abs());
                assert!((found[axis] - wanted[axis]).abs() < within, "{senses:?}, {height} m: {found:?}, {wanted:?}");
            }
            if height > 0.0 {
                let level = robot.mass * STANDARD_GRAVITY / 3.0;
                assert!(load.iter().any(|n| (n - level).abs() > 0.02 * level), "a load shifts: {load}");
            }
        }
    }
}
