//! The saturation of the torque: what imposed currents do, and a start that is integrated for itself.

use host_tests::paper::{FOUR_HEADINGS_DEG, FOUR_WHEELS, PaperRobot, THREE_HEADINGS_DEG, THREE_WHEELS};
use model_core::plant::Input;
use model_core::plant::robot::Robot;

use crate::fixture::{Run, effect, four, three, with_effect};
use crate::newton::{frictionless, runge_kutta};
use crate::one_wheel::OneWheel;

const SATURATION: f64 = 0.05;

fn saturated<const N: usize>(robot: Robot<N, f64>) -> Run<N, f64> {
    Run::new(with_effect(frictionless(robot), effect("torque_saturation"), None, &[SATURATION]))
}

/// One motor alone at a current: what its wheel's rim gains gives its torque τ, and the iron's ellipse between lost and
/// left torque, (l·K_t·i/τ)² = 1 + 2·k·i².
fn pushes_less<const N: usize>(robot: Robot<N, f64>, p: &PaperRobot, headings: [f64; N]) {
    for (j, heading) in headings.into_iter().enumerate() {
        let wheel = OneWheel::new(p, heading);
        for i in [-9.0, -2.0, -0.1, 0.3, 1.0, 4.0] {
            let mut run = saturated(robot);
            let mut current = [0.0; N];
            current[j] = i;
            run.step(&Input::Current(current), 1e-3);
            let torque = wheel.speed(run.twist()) / wheel.mobility() * p.r / 1e-3;
            let ratio = p.l * p.kt * i / torque;
            // roundings
            assert!((ratio * ratio / (1.0 + 2.0 * SATURATION * i * i) - 1.0).abs() < 1e-12, "{i} A: {torque} N·m");
        }
    }
}

#[test]
fn an_imposed_current_pushes_less_the_larger_it_is() {
    pushes_less(three(), &THREE_WHEELS, THREE_HEADINGS_DEG);
    pushes_less(four(), &FOUR_WHEELS, FOUR_HEADINGS_DEG);
}

/// All motors at one voltage, from rest and reversed after 0.2 s: the largest error of the wheels' speed [rad/s].
fn off<const N: usize>(robot: Robot<N, f64>, p: &PaperRobot, dt: f64) -> f64 {
    // J·r/(N·d)·dw/dt = τ/r,  τ = l·K_t·i/√(1 + 2·k·i²),  i = (u − l·K_v·w)/R
    let per_torque = N as f64 * p.d * p.d / (p.inertia * p.r * p.r);
    let rate = |u: f64| {
        move |[w]: [f64; 1]| {
            let i = (u - p.l * p.kv * w) / p.resistance;
            [per_torque * p.l * p.kt * i / (1.0 + 2.0 * SATURATION * i * i).sqrt()]
        }
    };
    let (mut run, mut speed, mut worst) = (saturated(robot), [0.0], 0.0_f64);
    for k in 0..(0.6 / dt).round() as u32 {
        let u = if f64::from(k) * dt < 0.2 - 1e-9 { 9.0 } else { -9.0 };
        run.drive([u; N], dt);
        speed = runge_kutta(rate(u), speed, dt);
        worst = worst.max((p.d / p.r * run.twist()[2] - speed[0]).abs());
    }
    worst
}

#[test]
fn under_voltage_the_speed_follows_the_equations_in_second_order() {
    for (what, coarse, fine) in [
        ("three", off(three(), &THREE_WHEELS, 2e-3), off(three(), &THREE_WHEELS, 1e-3)),
        ("four", off(four(), &FOUR_WHEELS, 2e-3), off(four(), &FOUR_WHEELS, 1e-3)),
    ] {
        // (Δt/τ)²/12 of 70 rad/s, τ of 0.1 s
        assert!(coarse < 2.5e-3 && fine < 0.27 * coarse, "{what}: {coarse:e}, {fine:e} rad/s");
    }
}

#[test]
fn the_current_itself_is_that_of_a_motor_that_never_saturates() {
    let mut run = saturated(four());
    for k in 0..300 {
        let u = [9.0, -4.0, 2.0, -7.0].map(|u| if k < 150 { u } else { -u });
        let read = run.drive(u, 1e-3);
        for (j, i) in read.current.into_iter().enumerate() {
            let p = FOUR_WHEELS;
            let exact = (u[j] - p.l * p.kv * read.wheel_speed[j]) / p.resistance;
            // roundings
            assert!((i - exact).abs() < 1e-13, "{i} against {exact}");
        }
    }
}
