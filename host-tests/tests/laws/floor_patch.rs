//! Patch of the floor: the work of a way across it, and where a robot is that slows down in it.

use model_core::plant::Input;
use model_core::plant::robot::{Friction, Robot};

use crate::fixture::{Run, effect, four, gap, larger, three, with_effect};
use crate::newton::{runge_kutta, second_order};

const EXCESS: f64 = 0.8;
const CENTER: [f64; 2] = [0.6, -0.2];
const RADIUS: f64 = 0.15;
/// Along the axis of v, whose friction counts
const HEADING: f64 = 0.7;

/// Towards a point beside the middle of the patch by `beside` [m], from a metre before it, with dry friction alone.
fn coasting<const N: usize>(robot: Robot<N, f64>, excess: f64, beside: f64, speed: f64) -> Run<N, f64> {
    let robot = Robot { friction: Friction { viscous: [0.0; 3], ..robot.friction }, ..robot };
    let (sin, cos) = HEADING.sin_cos();
    let start = [CENTER[0] - cos - sin * beside, CENTER[1] - sin + cos * beside, HEADING];
    let plant = with_effect(robot, effect("floor_patch"), None, &[excess, CENTER[0], CENTER[1], RADIUS]);
    Run::from(plant, start, [speed, 0.0, 0.0])
}

#[test]
fn a_way_across_the_patch_costs_the_whole_bell_more() {
    fn check<const N: usize>(robot: Robot<N, f64>) {
        for excess in [EXCESS, -0.6] {
            for beside in [0.0, 0.1, -0.3, 2.0] {
                let mut run = coasting(robot, excess, beside, 2.6);
                let [x, y, _] = run.pose();
                for _ in 0..900 {
                    run.step(&Input::Current([0.0; N]), 1e-3);
                }
                let ([a, b, _], [v, _, _], robot) = (run.pose(), run.twist(), run.plant.robot());
                let way = (a - x).hypot(b - y);
                assert!(way > 1.8, "{way} m: five radii beyond the middle are not reached");
                let lost = 0.5 * robot.mass * (2.6 * 2.6 - v * v);
                // ∫(1 + k·e^(−(s² + d²)/2r²)) ds = L + k·r·√(2π)·e^(−d²/2r²)
                let bell = RADIUS * std::f64::consts::TAU.sqrt() * (-0.5 * (beside / RADIUS).powi(2)).exp();
                // the midpoint rule's own error, (v·Δt/r)²/24 of the bell's work at the most
                let off = lost - robot.friction.coulomb[0] * (way + excess * bell);
                assert!(off.abs() < 1e-5, "{off:e} J of {lost}");
            }
        }
    }
    check(three());
    check(four());
}

#[test]
fn inside_the_patch_it_moves_as_newtons_law_says() {
    fn off<const N: usize>(robot: Robot<N, f64>, dt: f64) -> f64 {
        let mut run = coasting(robot, EXCESS, 0.05, 2.2);
        let (mass, coulomb) = (robot.mass, robot.friction.coulomb[0]);
        let ([x, y, _], mut exact, mut worst) = (run.pose(), [-1.0, 2.2], 0.0);
        // (way from the middle, speed)
        let rate = |[s, v]: [f64; 2]| {
            let nearness = (-(s * s + 0.05 * 0.05) / (2.0 * RADIUS * RADIUS)).exp();
            [v, -coulomb / mass * (1.0 + EXCESS * nearness)]
        };
        for _ in 0..(0.55 / dt).round() as usize {
            run.step(&Input::Current([0.0; N]), dt);
            exact = runge_kutta(rate, exact, dt);
            let ([a, b, _], [v, _, _]) = (run.pose(), run.twist());
            worst = larger(worst, gap([(a - x).hypot(b - y) - 1.0, v], exact));
        }
        worst
    }
    // (v·Δt/r)²/24 of the speed lost in a radius, 0.15 m/s
    second_order("three wheels", 3e-6, |dt| off(three(), dt));
    second_order("four wheels", 3e-6, |dt| off(four(), dt));
}
