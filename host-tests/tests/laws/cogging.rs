//! Cogging: a rotor in a detent is a pendulum, whose period is a closed form for any swing; what it lends it takes back.

use std::f64::consts::PI;

use host_tests::paper::{FOUR_HEADINGS_DEG, FOUR_WHEELS, PaperRobot, THREE_HEADINGS_DEG, THREE_WHEELS};
use model_core::plant::Input;
use model_core::plant::robot::Robot;

use crate::fixture::{Run, effect, four, gap, larger, three, with_effect};
use crate::newton::{frictionless, runge_kutta};
use crate::one_wheel::OneWheel;

const ORDER: f64 = 12.0;

fn run<const N: usize>(robot: Robot<N, f64>, wheel: usize, parts: [f64; 2], twist: [f64; 3]) -> Run<N, f64> {
    let params = [parts[0], parts[1], ORDER];
    Run::from(with_effect(frictionless(robot), effect("cogging"), Some(wheel), &params), [0.0; 3], twist)
}

/// The mean of two numbers that arithmetic and geometric means close in on.
fn arithmetic_geometric_mean(mut a: f64, mut b: f64) -> f64 {
    for _ in 0..20 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    a
}

/// Let go beside a detent, without current, by `swing` of a period's 2π: the robot swings to and fro at that rim.
fn swings<const N: usize>(robot: Robot<N, f64>, p: &PaperRobot, headings: [f64; N]) {
    let size = 0.02;
    for (j, heading) in headings.into_iter().enumerate() {
        let wheel = OneWheel::new(p, heading);
        for swing in [0.1_f64, 1.5, 3.0] {
            // τ = −C·sin(N·l·θ + swing)
            let mut run = run(robot, j, [-size * swing.sin(), -size * swing.cos()], [0.0; 3]);
            let (dt, mut turned, mut last) = (1e-4, Vec::new(), 0.0);
            while turned.len() < 7 {
                run.step(&Input::Current([0.0; N]), dt);
                let now = wheel.speed(run.twist());
                if last * now < 0.0 {
                    turned.push(run.state.time - dt * now / (now - last));
                }
                last = now;
            }
            let period = (turned[6] - turned[0]) / 3.0;
            // d²θ/dt² = g·τ/r², g = 1/M + d²/J: ω₀² = N·l·C·g/r²,  T = 2π/(ω₀·agm(1, cos(swing/2)))
            let rate = (ORDER * p.l * size * wheel.mobility()).sqrt() / p.r;
            let wanted = 2.0 * PI / (rate * arithmetic_geometric_mean(1.0, (0.5 * swing).cos()));
            // (ω₀·Δt)²/12 with ω₀ of 40/s: 1e-6; more at the large swing, which rests long where it is nearly balanced
            assert!((period / wanted - 1.0).abs() < 1e-5, "wheel {j}, {swing} rad: {period} against {wanted} s");
        }
    }
}

#[test]
fn a_robot_in_a_detent_swings_as_a_pendulum() {
    swings(three(), &THREE_WHEELS, THREE_HEADINGS_DEG);
    swings(four(), &FOUR_WHEELS, FOUR_HEADINGS_DEG);
}

#[test]
fn a_robot_that_rolls_over_many_detents_has_its_speed_by_where_it_is() {
    let (p, parts) = (FOUR_WHEELS, [0.012, -0.016]);
    let off = |dt: f64| {
        let start = [0.25, -0.2, 1.0];
        let mut run = run(four(), 0, parts, start);
        let potential = |angle: f64| {
            let (sin, cos) = (ORDER * p.l * angle).sin_cos();
            -(parts[0] * sin - parts[1] * cos) / (ORDER * p.l)
        };
        let kinetic = |[v, vn, w]: [f64; 3]| 0.5 * p.mass * (v * v + vn * vn) + 0.5 * p.inertia * w * w;
        let energy = |run: &Run<4, f64>| kinetic(run.twist()) + potential(run.state.wheel_angle[0]);
        let (first, mut worst, mut lent) = (energy(&run), 0.0, 0.0);
        for _ in 0..(2.0 / dt).round() as usize {
            run.step(&Input::Current([0.0; 4]), dt);
            worst = larger(worst, (energy(&run) - first).abs());
            lent = larger(lent, (kinetic(run.twist()) - kinetic(start)).abs());
        }
        assert!(lent > 3e-4 && run.state.wheel_angle[0].abs() > 1.0, "{lent} J, {:?} rad", run.state.wheel_angle);
        worst
    };
    let (coarse, fine) = (off(0.5e-3), off(0.25e-3));
    // a rotor that speeds up by 15 rad/s² gets ½·a·Δt² further in a step, 3e-5 of a detent's radian: of 7e-4 J
    assert!(fine < 4e-8, "{fine:e} J");
    // as the step's square at least; at these sizes its third power still leads
    assert!(coarse / fine > 3.5, "{coarse:e} and {fine:e} J");
}

/// d/dt of (v, vn, ω, θ of the wheel), written out.
fn rate<const N: usize>(
    (p, headings): (&PaperRobot, [f64; N]),
    parts: [f64; 2],
    u: [f64; N],
    [v, vn, w, angle]: [f64; 4],
) -> [f64; 4] {
    let (mut force, mut turns) = ([0.0; 3], 0.0);
    for j in 0..N {
        let (sin, cos) = headings[j].to_radians().sin_cos();
        let spin = (cos * v + sin * vn + p.d * w) / p.r;
        let mut torque = p.l * p.kt * (u[j] - p.l * p.kv * spin) / p.resistance;
        if j == 1 {
            let (s, c) = (ORDER * p.l * angle).sin_cos();
            torque += parts[0] * c + parts[1] * s;
            turns = spin;
        }
        for (force, along) in force.iter_mut().zip([cos, sin, p.d]) {
            *force += along * torque / p.r;
        }
    }
    [force[0] / p.mass, force[1] / p.mass, force[2] / p.inertia, turns]
}

fn is_driven<const N: usize>(robot: Robot<N, f64>, p: &PaperRobot, headings: [f64; N], u: [f64; N]) {
    let (parts, start) = ([0.012, -0.016], [0.1, 0.05, 0.3]);
    let off = |dt: f64| {
        let mut run = run(robot, 1, parts, start);
        let [v, vn, w] = start;
        let (mut x, mut worst) = ([v, vn, w, 0.0], 0.0);
        for _ in 0..(0.5 / dt).round() as usize {
            run.drive(u, dt);
            // ten steps within one: a step of 2 ms is half a radian of a period
            for _ in 0..10 {
                x = runge_kutta(|x| rate((p, headings), parts, u, x), x, 0.1 * dt);
            }
            let [v, vn, w, angle] = x;
            let rim = |[v, vn, w]: [f64; 3]| [v, vn, p.d * w];
            worst = larger(worst, gap(rim(run.twist()), rim([v, vn, w])));
            worst = larger(worst, p.r * (run.state.wheel_angle[1] - angle).abs());
        }
        worst
    };
    let (coarse, fine) = (off(1e-3), off(0.5e-3));
    // mean torque of a way that is wrong by ½·a·Δt²: second order; 0.6 N on 2 kg for 1 ms is 3e-4 m/s
    assert!(fine < 1e-5, "{N} wheels: {fine:e}");
    assert!((3.3..4.7).contains(&(coarse / fine)), "{N} wheels: {coarse:e} and {fine:e}");
}

#[test]
fn a_robot_that_is_driven_moves_as_its_equations_integrated_for_themselves() {
    is_driven(three(), &THREE_WHEELS, THREE_HEADINGS_DEG, [-2.0, -1.5, 3.0]);
    is_driven(four(), &FOUR_WHEELS, FOUR_HEADINGS_DEG, [3.0, -2.0, -1.5, 2.0]);
}
