//! One wheel of another size: the robot that was built with it, and the energy that its motors give.

use host_tests::generic_robot::{Drivetrain, Wheel};
use model_core::plant::Input;
use model_core::plant::robot::Robot;

use crate::built_so::Built;
use crate::fixture::{Run, effect, four, three, with_effect};
use crate::newton::frictionless;

#[test]
fn a_wheel_of_another_radius_is_the_robot_built_with_that_radius() {
    for size in [0.2, -0.15] {
        let wheel = |wheel: Wheel, e: f64| Wheel {
            drivetrain: Drivetrain { radius: (1.0 + e) * wheel.drivetrain.radius, ..wheel.drivetrain },
            ..wheel
        };
        Built { id: "wheel_radius_error", size, wheel }.is_the_robot_built_so();
    }
}

/// What the motors give, by the currents and wheel speeds that are read, is what the body gains.
fn energy_is_kept<const N: usize>(robot: Robot<N, f64>) {
    let robot = frictionless(robot);
    for wheel in 0..N {
        let mut run =
            Run::from(with_effect(robot, effect("wheel_radius_error"), Some(wheel), &[0.3]), [0.0; 3], [0.2; 3]);
        let energy = |[v, vn, w]: [f64; 3]| 0.5 * robot.mass * (v * v + vn * vn) + 0.5 * robot.inertia * w * w;
        let first = energy(run.twist());
        let current: [f64; N] = std::array::from_fn(|j| 0.4 * (2.0 * j as f64 + 1.0).sin());
        let kt = robot.motor.gear_ratio * robot.motor.torque_constant;
        let (mut work, mut before): (f64, Option<[f64; N]>) = (0.0, None);
        for _ in 0..=500 {
            let read = run.clone().step(&Input::Current(current), 1e-3);
            if let Some(before) = before {
                // ∫ l·K_t·i·ω dt; at constant currents the speeds are straight lines over time
                work += (0..N).map(|j| kt * current[j] * 0.5 * (before[j] + read.wheel_speed[j]) * 1e-3).sum::<f64>();
                let gained = energy(run.twist()) - first;
                // 500 roundings of some joules
                assert!((gained - work).abs() < 1e-11, "wheel {wheel} of {N}: {gained} J of {work} J");
            }
            before = Some(read.wheel_speed);
            run.step(&Input::Current(current), 1e-3);
        }
        assert!(work > 0.03, "{work} J");
    }
}

#[test]
fn the_body_gains_what_the_motors_give() {
    energy_is_kept(three());
    energy_is_kept(four());
}
