//! The ripple of the commutation: its work in closed form, and the ripple of a speed.

use host_tests::paper::{FOUR_HEADINGS_DEG, FOUR_WHEELS, PaperRobot, THREE_HEADINGS_DEG, THREE_WHEELS};
use model_core::plant::Input;
use model_core::plant::robot::Robot;

use crate::fixture::{Run, effect, four, three, with_effect};
use crate::newton::frictionless;
use crate::one_wheel::OneWheel;

const ODD: usize = 1;

/// a_c, a_s, n
const SIZES: [f64; 3] = [0.2, -0.15, 42.0];

fn run<const N: usize>(robot: Robot<N, f64>, sizes: [f64; 3], twist: [f64; 3]) -> Run<N, f64> {
    Run::from(with_effect(frictionless(robot), effect("commutation_ripple"), Some(ODD), &sizes), [0.0; 3], twist)
}

/// From rest under a current in one motor alone, its wheel's rim gains v with M·v²/2 = W(θ), the work over the angle:
/// W = l·K_t·i·(θ + (a_c·sin(n·l·θ) − a_s·(cos(n·l·θ) − 1))/(n·l)). Returns the largest error over the work of one ripple.
fn off<const N: usize>(robot: Robot<N, f64>, p: &PaperRobot, headings: [f64; N], (current, dt): (f64, f64)) -> f64 {
    let ([a, b, n], wheel) = (SIZES, OneWheel::new(p, headings[ODD]));
    let (each, torque) = (n * p.l, p.l * p.kt * current);
    let mut input = [0.0; N];
    input[ODD] = current;
    let mut run = run(robot, SIZES, [0.0; 3]);
    let (mut angle, mut before, mut worst) = (0.0, 0.0, 0.0_f64);
    while run.state.time < 0.3 {
        run.step(&Input::Current(input), dt);
        let speed = wheel.speed(run.twist());
        angle += 0.5 * (before + speed) / p.r * dt;
        before = speed;
        let (sin, cos) = (each * angle).sin_cos();
        let work = torque * (angle + (a * sin - b * (cos - 1.0)) / each);
        worst = worst.max((0.5 * speed * speed / wheel.mobility() - work).abs() * each / torque.abs());
    }
    assert!((angle * each).abs() > 50.0, "{} rad of ripple", angle * each);
    worst
}

#[test]
fn what_a_current_does_is_its_work_over_the_angle_in_second_order() {
    for current in [0.3, -0.3] {
        for (what, coarse, fine) in [
            (
                "three",
                off(three(), &THREE_WHEELS, THREE_HEADINGS_DEG, (current, 4e-4)),
                off(three(), &THREE_WHEELS, THREE_HEADINGS_DEG, (current, 2e-4)),
            ),
            (
                "four",
                off(four(), &FOUR_WHEELS, FOUR_HEADINGS_DEG, (current, 4e-4)),
                off(four(), &FOUR_WHEELS, FOUR_HEADINGS_DEG, (current, 2e-4)),
            ),
        ] {
            // the speed of a step's beginning stands for all of it: a·Δt²/2 of phase, 210·200 rad/s² at 0.4 ms, of a quarter
            assert!(coarse < 0.01 && fine < 0.3 * coarse, "{what}: {coarse:e}, {fine:e}");
        }
    }
}

/// Currents that cancel in four wheels, (i, −i, i, −i), move no body but by the ripple of the odd one. The robot turns on
/// the spot at w, so that its rim's speed goes up and down by g·K_t·i/r·|a|/(n·l·w), g the rim's speed for an impulse.
#[test]
fn a_wheel_that_turns_freely_goes_up_and_down_by_the_ripple_over_its_frequency() {
    let (p, speed, current) = (FOUR_WHEELS, 5.0, 0.08);
    let wheel = OneWheel::new(&p, FOUR_HEADINGS_DEG[ODD]);
    let [a, b, n] = [0.04, 0.03, 42.0];
    let frequency = n * p.l * speed;
    let swing = wheel.mobility() * p.l * p.kt * current / (p.r * frequency);
    let turning = [0.0, 0.0, speed * p.r / p.d];
    let (dt, mut worst) = (2e-5, 0.0_f64);
    let mut run = run(four(), [a, b, n], turning);
    for k in 1..=5000_u32 {
        run.step(&Input::Current([-current, current, -current, current]), dt);
        // 1/(n·l·w)·∫(a_c·cos + a_s·sin) over the phase
        let (sin, cos) = (frequency * f64::from(k) * dt).sin_cos();
        let exact = swing * (a * sin - b * (cos - 1.0));
        worst = worst.max((wheel.speed(run.twist()) - speed * p.r - exact).abs());
    }
    // about its mean, a_s of the swing, the speed is another by 4e-5 of it, and so the phase by 0.5 % over 100 rad
    assert!(worst < 0.02 * swing * 0.05, "{worst:e} of {:e} m/s", swing * 0.05);
}

#[test]
fn steps_that_are_longer_than_a_ripple_see_its_mean_and_no_ghost_of_it() {
    // 40 rad/s: 210·40·0.748 ms = 2π, so that every step begins in the same phase
    let (p, speed) = (THREE_WHEELS, 40.0);
    let dt = std::f64::consts::TAU / (42.0 * p.l * speed);
    let wheel = OneWheel::new(&p, THREE_HEADINGS_DEG[ODD]);
    let mut run = run(three(), [0.3, 0.0, 42.0], [0.0, 0.0, speed * p.r / p.d]);
    let current = 0.05;
    for _ in 0..100 {
        run.step(&Input::Current([0.0, current, 0.0]), dt);
    }
    let gained = wheel.speed(run.twist()) - speed * p.r;
    let plain = wheel.mobility() * p.l * p.kt * current / p.r * 100.0 * dt;
    // a ghost would be 30 %; as the speed grows the phases drift apart by some parts of a ripple
    assert!((gained / plain - 1.0).abs() < 0.01, "{gained} against {plain} m/s");
}

#[test]
fn the_current_of_a_voltage_has_no_ripple() {
    let mut run = run(four(), SIZES, [0.0, 0.0, 3.0]);
    for _ in 0..200 {
        let read = run.drive([4.0; 4], 1e-3);
        let p = FOUR_WHEELS;
        for (i, w) in read.current.into_iter().zip(read.wheel_speed) {
            assert!((i - (4.0 - p.l * p.kv * w) / p.resistance).abs() < 1e-14);
        }
    }
}
