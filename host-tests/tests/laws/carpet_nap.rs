//! Nap of the carpet: what ways over it cost, whichever way the robot looks, and Newton's law along the pile and across it.

use model_core::effects::active::Effects;
use model_core::plant::robot::Robot;
use model_core::plant::{Input, Plant};

use crate::fixture::{Run, effect, four, gap, larger, three};
use crate::newton::{frictionless, runge_kutta, second_order};

const FORCE: f64 = 0.8;
const DIRECTION: f64 = 2.4;

/// Coasts, turning, from a velocity (along the pile, across it) in the world.
fn coasting<const N: usize>(robot: Robot<N, f64>, onset: f64, [along, across]: [f64; 2]) -> Run<N, f64> {
    let mut effects = Effects::default();
    effects.add(effect("carpet_nap"), None, &[FORCE, DIRECTION, onset]).expect("room");
    effects.add(effect("coriolis"), None, &[1.0]).expect("room");
    let (theta, w) = (-0.9, 2.0);
    let (sin, cos) = (DIRECTION - theta).sin_cos();
    let twist = [cos * along - sin * across, sin * along + cos * across, w];
    Run::from(Plant::new(frictionless(robot), effects), [0.2, -0.1, theta], twist)
}

/// Velocity (along the pile, across it) in the world.
fn velocity<const N: usize>(run: &Run<N, f64>) -> [f64; 2] {
    let world = run.state.pose.to_world(run.state.twist);
    let (sin, cos) = DIRECTION.sin_cos();
    [cos * world.x + sin * world.y, cos * world.y - sin * world.x]
}

#[test]
fn a_way_against_the_pile_costs_the_whole_force_and_one_with_it_nothing() {
    fn check<const N: usize>(robot: Robot<N, f64>) {
        for (start, force) in [(-1.5, FORCE), (1.5, 0.0)] {
            let mut run = coasting(robot, 0.01, [start, 0.0]);
            let [x, y, _] = run.pose();
            for _ in 0..1000 {
                run.step(&Input::Current([0.0; N]), 1e-3);
            }
            let ([a, b, _], [along, across]) = (run.pose(), velocity(&run));
            let (way, lost) = ((a - x).hypot(b - y), 0.5 * robot.mass * (start * start - along * along));
            // (v₀/v)² of A over a way of 1.3 m, and turns that are wrong by (ω·Δt)²/12 of 2 rad
            assert!((lost - force * way).abs() < 2e-4, "{lost} J over {way} m");
            assert!(across.abs() < 2e-6, "{across} m/s");
        }
    }
    check(three());
    check(four());
}

#[test]
fn across_the_pile_it_is_pushed_along_its_lean_with_half_of_the_force() {
    let mut run = coasting(four(), 0.01, [0.0, 1.5]);
    for _ in 0..20 {
        run.step(&Input::Current([0.0; 4]), 1e-3);
    }
    let gained = 0.5 * FORCE / run.plant.robot().mass * 0.02;
    let [along, across] = velocity(&run);
    // what it has gained takes away of it, by its share in the speed: 0.2 %
    assert!((along / gained - 1.0).abs() < 3e-3 && ((1.5 - across) / gained - 1.0).abs() < 3e-3);
}

#[test]
fn it_moves_as_newtons_law_says_of_the_parts_along_the_pile_and_across_it() {
    fn off<const N: usize>(robot: Robot<N, f64>, dt: f64) -> f64 {
        let onset = 0.05;
        let mut exact = [-0.6, 0.5];
        let mut run = coasting(robot, onset, exact);
        // drag ½·A towards rest, push ½·A along the lean, both setting in with the speed
        let rate = |[along, across]: [f64; 2]| {
            let speed = along.hypot(across);
            let set_in = speed / speed.hypot(onset);
            let bearing = across.atan2(along);
            let half = 0.5 * FORCE / robot.mass;
            [half * set_in * (set_in - bearing.cos()), -half * set_in * bearing.sin()]
        };
        let mut worst = 0.0;
        for _ in 0..(2.0 / dt).round() as usize {
            run.step(&Input::Current([0.0; N]), dt);
            exact = runge_kutta(rate, exact, dt);
            worst = larger(worst, gap(velocity(&run), exact));
        }
        worst
    }
    second_order("three wheels", 1e-5, |dt| off(three(), dt));
    second_order("four wheels", 1e-5, |dt| off(four(), dt));
}
