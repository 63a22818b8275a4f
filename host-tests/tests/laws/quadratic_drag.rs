//! Drag that grows with the square of the speed: the closed form of a robot that coasts, on a straight way through the world.

use model_core::effects::active::Effects;
use model_core::plant::robot::Robot;
use model_core::plant::{Input, Plant};

use crate::fixture::{Run, effect, four, gap, larger, three};
use crate::newton::{frictionless, second_order};

/// Twenty times what is typical: it takes most of the speed within seconds [N·s²/m²]
const DRAG: f64 = 1.0;
const START: [f64; 3] = [0.2, -0.1, 0.4];

/// How far a robot that coasts, turning or not, is off [m/s, m]: v = v₀/(1 + t/τ), s = v₀·τ·ln(1 + t/τ), τ = M/(c·v₀).
fn coasts<const N: usize>(robot: Robot<N, f64>, [v, vn, w]: [f64; 3], dt: f64) -> f64 {
    let mut effects = Effects::default();
    effects.add(effect("quadratic_drag"), None, &[DRAG]).expect("room");
    effects.add(effect("coriolis"), None, &[1.0]).expect("room");
    let mut run = Run::from(Plant::new(frictionless(robot), effects), START, [v, vn, w]);
    let (speed, heading) = (v.hypot(vn), vn.atan2(v) + START[2]);
    let tau = robot.mass / (DRAG * speed);
    let mut worst = 0.0;
    for k in 1..=(2.0 / dt).round() as usize {
        run.step(&Input::Current([0.0; N]), dt);
        let t = dt * k as f64;
        let (way, left) = (speed * tau * (1.0 + t / tau).ln(), speed / (1.0 + t / tau));
        let (sin, cos) = heading.sin_cos();
        let world = run.state.pose.to_world(run.state.twist);
        let [x, y, _] = run.pose();
        let off = gap(
            [world.x, world.y, x, y, world.w],
            [left * cos, left * sin, START[0] + way * cos, START[1] + way * sin, w],
        );
        worst = larger(worst, off);
    }
    worst
}

#[test]
fn a_robot_that_coasts_slows_down_as_the_closed_form_says_whichever_way_it_goes() {
    for twist in [[1.5, 0.0, 0.0], [0.9, -1.2, 0.0], [-1.0, 0.6, 3.0]] {
        // (Δt/τ)²/12 of 1.5 m/s, and turns that are wrong by (ω·Δt)²/12 of 6 rad
        second_order("three wheels", 1e-5, |dt| coasts(three(), twist, dt));
        second_order("four wheels", 1e-5, |dt| coasts(four(), twist, dt));
    }
}
