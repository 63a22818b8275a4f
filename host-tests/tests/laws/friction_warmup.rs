//! Friction that warms up: a coasting wheel's speed is the integral of a force that fades, and what holds a cold robot lets
//! it go later.

use host_tests::paper::{FOUR_HEADINGS_DEG, FOUR_WHEELS, PaperRobot, THREE_HEADINGS_DEG, THREE_WHEELS};
use model_core::plant::Input;
use model_core::plant::robot::{Friction, Robot};

use crate::fixture::{Run, effect, four, gap, three, with_effect};
use crate::one_wheel::OneWheel;

/// Much shorter than on a robot, so that a run sees it fade.
const PARAMS: [f64; 2] = [2.0, 5.0];

/// τ_C of each wheel: the force on the body that all wheels together would have to give [N·m].
fn share<const N: usize>(p: &PaperRobot, headings: [f64; N]) -> f64 {
    let reach: f64 = headings.iter().map(|deg| deg.to_radians().cos().abs() + deg.to_radians().sin().abs()).sum();
    p.r * (p.coulomb[0] + p.coulomb[1]) / reach
}

/// A robot with the excess on one wheel against the same robot without it: nothing turns round and nothing is viscous, so
/// that the two part by the impulse of the excess alone.
fn coasts<const N: usize>(robot: Robot<N, f64>, p: &PaperRobot, headings: [f64; N]) {
    let [excess, fades] = PARAMS;
    let tau = share(p, headings);
    for (j, heading) in headings.into_iter().enumerate() {
        let robot = Robot { friction: Friction { viscous: [0.0; 3], coulomb: robot.friction.coulomb }, ..robot };
        let wheel = OneWheel::new(p, heading);
        let start = [1.2, 1.0, -5.0];
        let run_with =
            |params: &[f64]| Run::from(with_effect(robot, effect("friction_warmup"), Some(j), params), [0.0; 3], start);
        let (mut cold, mut warm) = (run_with(&PARAMS), run_with(&[0.0, 5.0]));
        for step in 1..=100 {
            cold.step(&Input::Current([0.0; N]), 1e-3);
            warm.step(&Input::Current([0.0; N]), 1e-3);
            // ∫ k·τ_C/r·exp(−t/T) dt
            let faded = fades * (1.0 - (-f64::from(step) * 1e-3 / fades).exp());
            let impulse = -wheel.speed(start).signum() * excess * tau / p.r * faded;
            let expected = wheel.pushed(warm.twist(), impulse);
            // the middle of each step stands for it: (Δt/T)²/24 = 1.7e-9 of 2 rad/s
            let off = gap(cold.twist(), expected);
            assert!(off < 4e-9, "wheel {j} after {step} ms: {:?}, not {expected:?}: {off:e}", cold.twist());
        }
        assert!(gap(cold.twist(), warm.twist()) > 0.05, "{:?}", cold.twist());
        // nothing has turned round
        assert!(cold.twist().iter().zip(start).all(|(now, then)| now * then > 0.0));
        assert!(wheel.speed(cold.twist()) * wheel.speed(start) > 0.0);
    }
}

#[test]
fn a_robot_that_coasts_is_braked_by_a_force_that_fades() {
    coasts(three(), &THREE_WHEELS, THREE_HEADINGS_DEG);
    coasts(four(), &FOUR_WHEELS, FOUR_HEADINGS_DEG);
}

#[test]
fn a_push_that_a_cold_robot_holds_moves_it_when_the_excess_has_faded_to_what_is_left() {
    let [excess, fades] = PARAMS;
    let p = FOUR_WHEELS;
    let tau = share(&p, FOUR_HEADINGS_DEG);
    // straight on: wheels 1 and 3 push, against C_v and their own k·τ_C/r·exp(−t/T), half of which is left
    let force = p.coulomb[0] + 2.0 * excess * tau / p.r * 0.5;
    let current = 0.5 * force * p.r / (p.l * p.kt);
    let plant = with_effect(four::<f64>(), effect("friction_warmup"), None, &PARAMS);
    let mut run = Run::new(plant);
    let wanted = fades * 2f64.ln();
    while run.twist() == [0.0; 3] && run.state.time < 2.0 * wanted {
        run.step(&Input::Current([0.0, -current, 0.0, current]), 1e-3);
    }
    // the step in which it goes, and the next one
    assert!((run.state.time - wanted).abs() < 2.5e-3, "moves at {} s, not {wanted} s", run.state.time);
    assert!(run.twist()[0] > 0.0);
}
