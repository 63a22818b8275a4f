//! Drift of the camera's clock: a circle seen by a clock that runs wrong, in closed form, for half a minute.

use model_core::geometry::frames::BodyTwist;
use model_core::plant::Input;
use model_core::plant::robot::Robot;

use crate::fixture::{Run, effect, four, gap, larger, three, with_effect};

const START: [f64; 3] = [0.7, 0.2, 0.3];
const SPEED: f64 = 0.8;
const TURN: f64 = 2.0;

/// Where a robot is that goes round evenly.
fn on_circle(t: f64) -> [f64; 3] {
    let ([x, y, theta], now) = (START, START[2] + TURN * t);
    let radius = SPEED / TURN;
    [x + radius * (now.sin() - theta.sin()), y + radius * (theta.cos() - now.cos()), now]
}

/// How far readings are off those of a camera that took each picture at the time t/(1 + ε) [m, rad].
fn off<const N: usize>(robot: Robot<N, f64>, rate_error: f64) -> f64 {
    let mut run = Run::from(with_effect(robot, effect("clock_drift"), None, &[rate_error]), START, [0.0; 3]);
    let speeds = robot.wheels.wheel_speeds(BodyTwist { v: SPEED, vn: 0.0, w: TURN });
    let mut worst = 0.0;
    for k in 0..30_000 {
        let read = run.step(&Input::Speed(speeds), 1e-3).pose;
        let taken = 1e-3 * f64::from(k) / (1.0 + rate_error);
        worst = larger(worst, gap([read.x, read.y, read.theta], on_circle(taken)));
    }
    worst
}

#[test]
fn a_camera_with_a_fast_clock_shows_what_was_and_one_with_a_slow_clock_what_is_to_come() {
    for rate_error in [1e-3, -1e-3] {
        for off in [off(three(), rate_error), off(four(), rate_error)] {
            // chords of the steps are too long by (ω·Δt)²/24 of a way round of 0.8 m; chords over 4 ms are off by
            // v·ω·h²/8 = 3.2e-6 m, and the way on from now by v·ε·t·(ω·ε·t)²/24 = 3.6e-6 m
            assert!(off < 4.5e-6, "{off:e} m at {rate_error}");
        }
    }
}

#[test]
fn at_an_instant_it_is_the_latency_that_has_come_together() {
    fn check<const N: usize>(robot: Robot<N, f64>) {
        let (rate_error, seconds) = (2e-3, 20);
        let together = f64::from(seconds) * rate_error / (1.0 + rate_error);
        let drifting = with_effect(robot, effect("clock_drift"), None, &[rate_error]);
        let late = with_effect(robot, effect("camera_latency"), None, &[together]);
        let speeds = robot.wheels.wheel_speeds(BodyTwist { v: SPEED, vn: 0.0, w: TURN });
        let [a, b] = [drifting, late].map(|plant| {
            let mut run = Run::from(plant, START, [0.0; 3]);
            for _ in 0..1000 * seconds {
                run.step(&Input::Speed(speeds), 1e-3);
            }
            run.step(&Input::Speed(speeds), 1e-3).pose
        });
        // time is the sum of 20 000 steps
        assert!(gap([a.x, a.y, a.theta], [b.x, b.y, b.theta]) < 1e-11, "{a:?} and {b:?}");
    }
    check(three());
    check(four());
}
