//! The inductance of the windings: two time constants in closed form, and the flux that a voltage leaves in a winding.

use host_tests::excitation::voltages;
use host_tests::paper::{FOUR_WHEELS, PaperRobot, THREE_WHEELS};
use model_core::plant::Plant;
use model_core::plant::robot::Robot;

use crate::fixture::{Run, effect, four, three, with_effect};
use crate::newton::frictionless;

fn wound<const N: usize>(robot: Robot<N, f64>, inductance: f64) -> Plant<N, f64> {
    with_effect(robot, effect("winding_inductance"), None, &[inductance])
}

/// Without friction, from rest, all motors at the same voltage, the robot turns on the spot, and L and J make two time
/// constants, τ₁ + τ₂ = τ_m and τ₁·τ₂ = τ_m·L/R:
///
/// ```text
/// w = w∞·(1 − (τ₁·e^(−t/τ₁) − τ₂·e^(−t/τ₂))/(τ₁ − τ₂))        i = J·dw/dt over N·…·K_t
/// ```
///
/// Returns the largest error of the speed over w∞ and of the current over u/R.
fn off<const N: usize>(robot: Robot<N, f64>, p: &PaperRobot, inductance: f64, dt: f64) -> [f64; 2] {
    let (u, emf) = (6.0, p.l * p.kv);
    let (settled, electrical) = (u / emf, inductance / p.resistance);
    // J·dω/dt = N·d/r·l·Kt·i
    let mechanical = p.inertia * p.resistance * p.r * p.r / (N as f64 * p.d * p.d * p.l * p.l * p.kt * p.kv);
    let root = (mechanical * mechanical - 4.0 * mechanical * electrical).sqrt();
    let (slow, fast) = (0.5 * (mechanical + root), 0.5 * (mechanical - root));
    let left = |t: f64| [(-t / slow).exp(), (-t / fast).exp()];
    let mut run = Run::new(wound(frictionless(robot), inductance));
    let mut worst = [0.0_f64; 2];
    while run.state.time < 3.0 * mechanical {
        let t = run.state.time;
        let read = run.drive([u; N], dt);
        let [a, b] = left(t);
        let speed = settled * (1.0 - (slow * a - fast * b) / (slow - fast));
        // read 10 µs later; i = τ_m/R·K_v·dw/dt
        let [a, b] = left(t + 10e-6);
        let current = mechanical / p.resistance * emf * settled * (a - b) / (slow - fast);
        for j in 0..N {
            worst[0] = worst[0].max((read.wheel_speed[j] - speed).abs() / settled);
            worst[1] = worst[1].max((read.current[j] - current).abs() * p.resistance / u);
        }
    }
    worst
}

#[test]
fn a_start_is_that_of_two_time_constants_in_second_order() {
    let both =
        |inductance, dt| [off(three(), &THREE_WHEELS, inductance, dt), off(four(), &FOUR_WHEELS, inductance, dt)];
    // L/R shorter than a step, as long, and much longer
    for inductance in [0.1e-3, 0.5e-3, 4e-3, 20e-3] {
        for dt in [2e-3, 1e-3, 5e-4] {
            for [speed, current] in both(inductance, dt) {
                let part = (dt / 0.1) * (dt / 0.1);
                // (Δt/τ_m)²/(12·e), τ_m of 0.1 s; the first steps, in which the speed rises as the current does and not
                // evenly, are up to 4·(Δt/τ_m)² of current off: one that is a step late would be off by Δt/τ_m
                assert!(
                    speed < part / 32.0 && current < 4.0 * part,
                    "{inductance} H at {dt} s: {speed:e}, {current:e}"
                );
            }
        }
    }
    // once the steps are shorter than L/R
    for inductance in [4e-3, 20e-3] {
        for (coarse, fine) in both(inductance, 5e-4).into_iter().zip(both(inductance, 2.5e-4)) {
            for k in 0..2 {
                assert!(fine[k] < 0.27 * coarse[k], "{inductance} H: {coarse:?}, {fine:?}");
            }
        }
    }
}

/// Over a run, ∫(u − R·i − K_v·ω) dt = L·i: the largest difference over the run, by its integrals up to there [V·s].
fn flux_lost<const N: usize>(robot: Robot<N, f64>, inductance: f64, steps: u32) -> f64 {
    let (resistance, emf) = (robot.motor.resistance, robot.motor.gear_ratio * robot.motor.emf_constant);
    let (mut run, dt) = (Run::new(wound(robot, inductance)), 1e-3 / f64::from(steps));
    let (mut left, mut worst) = ([0.0; N], 0.0_f64);
    for hold in voltages::<N>(11, 10, 9.0) {
        for _ in 0..hold.milliseconds * steps {
            let (before, speed) = (run.state.current, run.drive(hold.u, dt).wheel_speed);
            let after = run.plant.robot().wheels.wheel_speeds(run.state.twist);
            for j in 0..N {
                let current = 0.5 * (before[j] + run.state.current[j]);
                left[j] += dt * (hold.u[j] - resistance * current - emf * 0.5 * (speed[j] + after[j]));
                worst = worst.max((left[j] - inductance * run.state.current[j]).abs());
            }
        }
    }
    worst
}

#[test]
fn the_voltage_over_time_is_in_the_flux() {
    let inductance = 2e-3;
    for (what, coarse, fine) in [
        ("three", flux_lost(three(), inductance, 20), flux_lost(three(), inductance, 40)),
        ("four", flux_lost(four(), inductance, 20), flux_lost(four(), inductance, 40)),
    ] {
        // the trapezium's part of a current that bends at each of ten changes of up to 4 A: x²/12 of L·Δi with x = R·Δt/L
        let x = 4.3111 * 5e-5 / inductance;
        assert!(coarse < 10.0 * x * x / 12.0 * inductance * 4.0, "{what}: {coarse:e} V·s");
        assert!(fine < 0.3 * coarse, "{what}: {coarse:e}, then {fine:e} V·s");
    }
}

#[test]
fn an_inductance_that_all_but_vanishes_changes_all_but_nothing() {
    let (mut none, mut little) = (Run::new(wound(four::<f64>(), 0.0)), Run::new(wound(four::<f64>(), 1e-9)));
    for hold in voltages::<4>(3, 8, 9.0) {
        for _ in 0..hold.milliseconds {
            let (a, b) = (none.drive(hold.u, 1e-3), little.drive(hold.u, 1e-3));
            // L/R is 0.23 ns, of which a current of 4 A comes late in a step of 1 ms; the rest is rounding
            let apart = (0..4).map(|j| (a.current[j] - b.current[j]).abs()).fold(0.0, f64::max);
            assert!(apart < 4.0 * 2.3e-7, "{apart:e} A");
        }
    }
}
