//! Friction ellipse: a robot that coasts aslant, in closed form where the ellipse is a circle, and by Newton's law.

use model_core::plant::Input;
use model_core::plant::robot::{Friction, Robot};

use crate::fixture::{Run, effect, four, gap, larger, plain, three, with_effect};
use crate::newton::runge_kutta;

/// Still below any speed that is looked at [m/s]
const STILL: f64 = 1e-3;

fn with_coulomb<const N: usize>(robot: Robot<N, f64>, coulomb: [f64; 3]) -> Robot<N, f64> {
    Robot { friction: Friction { viscous: [0.0; 3], coulomb }, ..robot }
}

fn coasting<const N: usize>(robot: Robot<N, f64>, share: f64, velocity: [f64; 2]) -> Run<N, f64> {
    let plant = with_effect(robot, effect("friction_ellipse"), None, &[share, STILL]);
    Run::from(plant, [0.0, 0.0, 0.7], [velocity[0], velocity[1], 0.0])
}

#[test]
fn on_a_circle_of_friction_a_robot_keeps_its_way_and_slows_down_evenly() {
    fn check<const N: usize>(robot: Robot<N, f64>) {
        let coulomb = 1.9;
        let robot = with_coulomb(robot, [coulomb, coulomb, 0.1]);
        for degrees in [0.0_f64, 30.0, 45.0, 110.0, -20.0] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let mut run = coasting(robot, 1.0, [cos, sin]);
            let stop = robot.mass / coulomb;
            for k in 1..=(0.9 * stop / 1e-3) as usize {
                run.step(&Input::Current([0.0; N]), 1e-3);
                let speed = 1.0 - 1e-3 * k as f64 / stop;
                // the still speed: v_ε²/2 over the last speed, 0.1 m/s, times v/vn of the steepest way; an axis that stands
                // keeps no speed
                let off = gap(run.twist(), [speed * cos, speed * sin, 0.0]);
                assert!(off < 3e-5, "{off:e} at {speed} m/s, {degrees}°");
            }
        }
    }
    check(three());
    check(four());
}

#[test]
fn without_it_the_same_robot_is_pulled_towards_an_axis() {
    let robot = with_coulomb(four(), [1.9, 1.9, 0.1]);
    let mut run = Run::from(plain(robot), [0.0; 3], [0.8, 0.3, 0.0]);
    for _ in 0..300 {
        run.step(&Input::Current([0.0; 4]), 1e-3);
    }
    // both axes have lost C/M·t, 0.24 m/s
    let lost = 1.9 / robot.mass * 0.3;
    assert!(gap(run.twist(), [0.8 - lost, 0.3 - lost, 0.0]) < 1e-12);
}

/// How far a robot with another friction on each axis is off Newton's law over the first half of its way [m/s].
fn aslant<const N: usize>(robot: Robot<N, f64>, share: f64, dt: f64) -> f64 {
    let coulomb = [1.2, 2.6];
    let robot = with_coulomb(robot, [coulomb[0], coulomb[1], 0.1]);
    let mut exact = [0.9, 0.7];
    let mut run = coasting(robot, share, exact);
    // dv/dt = −C_v/M·((1 − s)·sign v + s·v/|v|)
    let rate = |x: [f64; 2]| {
        let speed = x[0].hypot(x[1]);
        let slows = |k: usize| -coulomb[k] / robot.mass * ((1.0 - share) * x[k].signum() + share * x[k] / speed);
        [slows(0), slows(1)]
    };
    let mut worst = 0.0;
    for _ in 0..(0.4 / dt).round() as usize {
        run.step(&Input::Current([0.0; N]), dt);
        exact = runge_kutta(rate, exact, dt);
        let [v, vn, _] = run.twist();
        worst = larger(worst, gap([v, vn], exact));
    }
    worst
}

#[test]
fn on_an_ellipse_it_moves_as_newtons_law_says() {
    for share in [1.0, 0.4] {
        for off in [|share, dt| aslant(three(), share, dt), |share, dt| aslant(four(), share, dt)] {
            // the budget is that of the step's beginning: first order, C/M·Δt/2 times the change of the direction
            let (coarse, fine): (f64, f64) = (off(share, 4e-3), off(share, 2e-3));
            assert!(fine < 3e-4, "{fine:e}");
            assert!((1.8..2.2).contains(&(coarse / fine)), "{coarse:e} and {fine:e}");
        }
    }
}

#[test]
fn between_the_two_it_takes_as_much_energy_as_its_share_says() {
    // along the diagonal, equal on both axes: C·√2 along the way by itself, C as a circle
    let robot = with_coulomb(four(), [1.9, 1.9, 0.1]);
    for share in [0.0, 0.25, 1.0] {
        let mut run = coasting(robot, share, [0.8, 0.8]);
        for _ in 0..300 {
            run.step(&Input::Current([0.0; 4]), 1e-3);
        }
        let ([x, y, _], [v, vn, _]) = (run.pose(), run.twist());
        let lost = 0.5 * robot.mass * (2.0 * 0.64 - v * v - vn * vn);
        let force = 1.9 * ((1.0 - share) * 2.0_f64.sqrt() + share);
        // v_ε²/v² of it
        assert!((lost - force * x.hypot(y)).abs() < 1e-5, "{lost} J over {} m", x.hypot(y));
    }
}
