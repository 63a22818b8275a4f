//! Friction of one wheel: the whole robot slows down as one force at one rim makes it, and holds what the wheel can hold.

use host_tests::paper::{FOUR_HEADINGS_DEG, FOUR_WHEELS, PaperRobot, THREE_HEADINGS_DEG, THREE_WHEELS};
use model_core::plant::Input;
use model_core::plant::robot::Robot;

use crate::fixture::{Run, effect, four, gap, three, with_effect};
use crate::newton::{frictionless, runge_kutta};
use crate::one_wheel::OneWheel;

const TORQUE: f64 = 0.02;
const DAMPING: f64 = 3e-4;

fn with_friction<const N: usize>(robot: Robot<N, f64>, wheel: usize, twist: [f64; 3]) -> Run<N, f64> {
    Run::from(with_effect(robot, effect("wheel_friction"), Some(wheel), &[TORQUE, DAMPING]), [0.0; 3], twist)
}

/// Without currents, v_j of the wheel falls as d|v_j|/dt = −g·(τ_b/r + b·|v_j|/r²), g = 1/M + d²/J, and then stays at zero,
/// while all motion that does not turn the wheel goes on.
fn coasts<const N: usize>(robot: Robot<N, f64>, paper: &PaperRobot, headings: [f64; N]) {
    let (r, start) = (paper.r, [0.4, -0.3, 2.0]);
    for (j, heading) in headings.into_iter().enumerate() {
        let wheel = OneWheel::new(paper, heading);
        let (g, first) = (wheel.mobility(), wheel.speed(start));
        let mut run = with_friction(frictionless(robot), j, start);
        let mut stopped = false;
        for step in 1..=2000 {
            run.step(&Input::Current([0.0; N]), 1e-3);
            // |v| + τ_b·r/b falls by e^(−g·b/r²·t)
            let dry = TORQUE * r / DAMPING;
            let falls = (-g * DAMPING / (r * r) * f64::from(step) * 1e-3).exp();
            let left = ((first.abs() + dry) * falls - dry).max(0.0);
            stopped = left == 0.0;
            let expected = wheel.pushed(start, (left * first.signum() - first) / g);
            // midpoint rule: (g·b/r²·Δt)²/12 = 1e-9 of a tenth of the speed; the step in which it stops: the dry part's
            // share of a step, to the same order
            let off = gap(run.twist(), expected);
            assert!(off < 1e-7, "wheel {j} after {step} ms: {:?}, not {expected:?}: {off:e}", run.twist());
        }
        assert!(stopped, "wheel {j} still turns");
    }
}

#[test]
fn a_robot_that_coasts_is_braked_at_one_rim_until_that_wheel_stands() {
    coasts(three(), &THREE_WHEELS, THREE_HEADINGS_DEG);
    coasts(four(), &FOUR_WHEELS, FOUR_HEADINGS_DEG);
}

#[test]
fn the_tight_wheel_breaks_away_at_its_own_torque_and_no_other_needs_any() {
    let p = FOUR_WHEELS;
    // τ_b = l·K_t·u/R
    let break_away = TORQUE * p.resistance / (p.l * p.kt);
    for (part, driven, moves) in
        [(0.999, 1, false), (-0.999, 1, false), (1.001, 1, true), (-1.001, 1, true), (0.01, 3, true)]
    {
        let mut run = with_friction(frictionless(four()), 1, [0.0; 3]);
        let mut u = [0.0; 4];
        u[driven] = part * break_away;
        run.drive(u, 1e-3);
        // a thousandth of 0.6 N on 2.34 kg for 1 ms: 3e-7 m/s; what is held is left by rounding alone
        let moved = gap(run.twist(), [0.0; 3]);
        assert_eq!(moved > 1e-8, moves, "{part} of {break_away} V on wheel {driven}: {moved:e}");
        assert!(moves || moved < 1e-15, "{moved:e}");
    }
}

/// dx/dt of a robot with all its friction, written out; nothing may stand or turn round.
fn rate<const N: usize>(p: &PaperRobot, headings: [f64; N], tight: usize, u: [f64; N], x: [f64; 3]) -> [f64; 3] {
    let mut force: [f64; 3] = std::array::from_fn(|k| -p.viscous[k] * x[k] - p.coulomb[k] * x[k].signum());
    for j in 0..N {
        let (sin, cos) = headings[j].to_radians().sin_cos();
        let spin = (cos * x[0] + sin * x[1] + p.d * x[2]) / p.r;
        let mut torque = p.l * p.kt * (u[j] - p.l * p.kv * spin) / p.resistance;
        if j == tight {
            torque -= TORQUE * spin.signum() + DAMPING * spin;
        }
        force[0] += cos * torque / p.r;
        force[1] += sin * torque / p.r;
        force[2] += p.d * torque / p.r;
    }
    [force[0] / p.mass, force[1] / p.mass, force[2] / p.inertia]
}

fn is_driven<const N: usize>(robot: Robot<N, f64>, p: &PaperRobot, headings: [f64; N], u: [f64; N], start: [f64; 3]) {
    for tight in 0..N {
        let mut run = with_friction(robot, tight, start);
        let (mut x, dt) = (start, 1e-4);
        for _ in 0..5000 {
            run.drive(u, dt);
            x = runge_kutta(|x| rate(p, headings, tight, u, x), x, dt);
            // midpoint rule: (λ·Δt)²/12 with λ of 10/s, 1e-7 of speeds of some rad/s
            assert!(gap(run.twist(), x) < 1e-6, "wheel {tight}: {:?}, not {x:?}", run.twist());
        }
        let plain = {
            let mut run = Run::from(crate::fixture::plain(robot), [0.0; 3], start);
            for _ in 0..5000 {
                run.drive(u, dt);
            }
            run.twist()
        };
        assert!(gap(plain, x) > 0.01, "wheel {tight}: its friction hardly shows: {plain:?} and {x:?}");
    }
}

#[test]
fn a_robot_that_is_driven_moves_as_its_equations_integrated_for_themselves() {
    // forward, to the left and turning, and no wheel turns round
    is_driven(four(), &FOUR_WHEELS, FOUR_HEADINGS_DEG, [8.0, -5.0, -4.0, 8.0], [0.6, 0.5, 1.0]);
    is_driven(three(), &THREE_WHEELS, THREE_HEADINGS_DEG, [-3.0, -1.5, 8.0], [0.6, 0.4, 1.0]);
}
