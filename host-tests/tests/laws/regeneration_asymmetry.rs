//! The loss of the bridge while braking: coasting down with the motors shorted, reversals, and energy.

use host_tests::excitation::voltages;
use host_tests::paper::{FOUR_WHEELS, PaperRobot, THREE_WHEELS};
use model_core::plant::Plant;
use model_core::plant::robot::Robot;

use crate::fixture::{Run, effect, four, gap, plain, three, with_effect};
use crate::newton::{frictionless, runge_kutta};

/// V_b [V], i₀ [A]
const SIZES: [f64; 2] = [0.6, 0.05];

fn lossy<const N: usize>(robot: Robot<N, f64>) -> Plant<N, f64> {
    with_effect(frictionless(robot), effect("regeneration_asymmetry"), None, &SIZES)
}

/// dw/dt of wheels that all turn alike, over their torque: N·d²/(J·r²)
fn per_torque<const N: usize>(p: &PaperRobot) -> f64 {
    N as f64 * p.d * p.d / (p.inertia * p.r * p.r)
}

/// Turning on the spot with shorted motors: J·dw/dt = −K_t·(K_v·w − V_b)/R, so w falls by the exponential towards V_b/K_v,
/// until the current is down to i₀. Returns the largest error until then [rad/s].
fn coasts<const N: usize>(robot: Robot<N, f64>, p: &PaperRobot, dt: f64) -> f64 {
    let [loss, ripple] = SIZES;
    let (emf, first) = (p.l * p.kv, 40.0);
    let tau = p.resistance / (per_torque::<N>(p) * p.l * p.kt * emf);
    let mut run = Run::from(lossy(robot), [0.0; 3], [0.0, 0.0, first * p.r / p.d]);
    let mut worst = 0.0_f64;
    loop {
        let read = run.drive([0.0; N], dt);
        let t = run.state.time;
        let exact = loss / emf + (first - loss / emf) * (-t / tau).exp();
        if exact * emf - loss <= p.resistance * ripple {
            return worst;
        }
        worst = worst.max((p.d / p.r * run.twist()[2] - exact).abs());
        assert!(read.current.iter().all(|i| *i < -ripple), "{:?}", read.current);
    }
}

#[test]
fn shorted_motors_brake_down_to_what_the_diodes_take() {
    for (what, coarse, fine) in [
        ("three", coasts(three(), &THREE_WHEELS, 2e-3), coasts(three(), &THREE_WHEELS, 1e-3)),
        ("four", coasts(four(), &FOUR_WHEELS, 2e-3), coasts(four(), &FOUR_WHEELS, 1e-3)),
    ] {
        // (Δt/τ)²/(12·e) of 40 rad/s, τ of 0.1 s
        assert!(coarse < 6e-4 && fine < 0.26 * coarse, "{what}: {coarse:e}, {fine:e} rad/s");
    }
}

/// Up, and braked and reversed by the opposite voltage, against the law as it reads, solved by halving. The largest error
/// of the wheels' speed [rad/s].
fn reverses<const N: usize>(robot: Robot<N, f64>, p: &PaperRobot, dt: f64) -> f64 {
    let [loss, ripple] = SIZES;
    let emf = p.l * p.kv;
    // u − K_v·w = R·i + Δu(i), and the right side rises
    let current = |u: f64, w: f64| {
        let lost = |i: f64| if i * w < 0.0 { loss.min((emf * w).abs()) * (i / ripple).clamp(-1.0, 1.0) } else { 0.0 };
        let (mut low, mut high) = (-20.0, 20.0);
        for _ in 0..60 {
            let i = 0.5 * (low + high);
            if p.resistance * i + lost(i) < u - emf * w { low = i } else { high = i }
        }
        0.5 * (low + high)
    };
    let (mut run, mut speed, mut worst) = (Run::new(lossy(robot)), [0.0], 0.0_f64);
    for k in 0..(1.2 / dt).round() as u32 {
        let u = [6.0, 2.0, -4.0][(f64::from(k) * dt / 0.4 + 1e-9) as usize];
        let read = run.drive([u; N], dt);
        assert!((read.current[0] - current(u, read.wheel_speed[0])).abs() < 1e-9, "{:?}", read.current);
        // in parts, for the law has corners
        for _ in 0..4 {
            speed = runge_kutta(|[w]| [per_torque::<N>(p) * p.l * p.kt * current(u, w)], speed, dt / 4.0);
        }
        worst = worst.max((p.d / p.r * run.twist()[2] - speed[0]).abs());
    }
    worst
}

#[test]
fn a_robot_that_is_slowed_down_and_reversed_goes_as_the_law_reads() {
    for (what, coarse, fine) in [
        ("three", reverses(three(), &THREE_WHEELS, 2e-3), reverses(three(), &THREE_WHEELS, 5e-4)),
        ("four", reverses(four(), &FOUR_WHEELS, 2e-3), reverses(four(), &FOUR_WHEELS, 5e-4)),
    ] {
        // at each corner the slope changes within a step: V_b/R of 400 rad/s² per ampere, times Δt²/τ
        assert!(coarse < 4e-3 && fine < 0.2 * coarse, "{what}: {coarse:e}, {fine:e} rad/s");
    }
}

#[test]
fn while_no_motor_brakes_nothing_is_lost() {
    let (mut lossy, mut free) = (Run::new(lossy(four::<f64>())), Run::new(plain(frictionless(four::<f64>()))));
    for _ in 0..1000 {
        let (a, b) = (lossy.drive([6.0; 4], 1e-3), free.drive([6.0; 4], 1e-3));
        // roundings
        assert!(gap(a.current, b.current) < 1e-13 && b.current[0] > 0.0);
    }
}

#[test]
fn what_the_bridge_gives_is_never_more_than_it_takes() {
    let p = FOUR_WHEELS;
    let mut run = Run::new(lossy(four::<f64>()));
    let mut lost = 0.0_f64;
    for hold in voltages::<4>(12, 30, 9.0) {
        for _ in 0..hold.milliseconds {
            let read = run.drive(hold.u, 1e-3);
            for ((u, i), w) in hold.u.into_iter().zip(read.current).zip(read.wheel_speed) {
                // (u − R·i − K_v·w)·i
                let power = (u - p.resistance * i - p.l * p.kv * w) * i;
                // roundings of 9 V times some amperes
                assert!(power > -1e-12 && (power < 1e-12 || i * w < 0.0), "{power} W at {i} A, {w} rad/s");
                lost += power * 1e-3;
            }
        }
    }
    assert!(lost > 0.1, "{lost} J");
}
