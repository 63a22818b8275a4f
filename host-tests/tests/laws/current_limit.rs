//! The limit of the current: a start in closed form, and what the bridge leaves of the voltage.

use host_tests::excitation::voltages;
use host_tests::paper::{FOUR_WHEELS, PaperRobot, THREE_WHEELS};
use model_core::effects::active::Effects;
use model_core::plant::Plant;
use model_core::plant::robot::Robot;

use crate::fixture::{Run, effect, four, gap, three, typical, with_effect};
use crate::newton::frictionless;

const LIMIT: f64 = 1.1;

fn limited<const N: usize>(robot: Robot<N, f64>) -> Plant<N, f64> {
    with_effect(robot, effect("current_limit"), None, &[LIMIT])
}

/// All motors at one voltage, from rest and then reversed: the speed changes evenly until the back-EMF leaves no more than
/// R·i_max, and then by the exponential. Returns the largest error of the wheels' speed [rad/s].
fn off<const N: usize>(robot: Robot<N, f64>, p: &PaperRobot, dt: f64) -> f64 {
    let (emf, u) = (p.l * p.kv, 9.0);
    let per_torque = N as f64 * p.d * p.d / (p.inertia * p.r * p.r);
    // dw/dt while it is limited; the time constant after
    let (even, tau) = (per_torque * p.l * p.kt * LIMIT, p.resistance / (per_torque * p.l * p.kt * emf));
    let exact = |from: f64, u: f64, t: f64| {
        let (sign, last) = (u.signum(), u / emf);
        let free = last - sign * p.resistance * LIMIT / emf;
        let until = sign * (free - from) / even;
        if t < until { from + sign * even * t } else { last + (free - last) * (-(t - until) / tau).exp() }
    };
    let (mut run, mut worst) = (Run::new(limited(frictionless(robot))), 0.0_f64);
    let turn = 0.6;
    for k in 1..=(1.6 / dt).round() as u32 {
        let t = f64::from(k) * dt;
        let u = if t < turn + 0.5 * dt { u } else { -u };
        let read = run.drive([u; N], dt);
        assert!(read.current.iter().all(|i| i.abs() <= LIMIT), "{:?}", read.current);
        let want = if u > 0.0 { exact(0.0, u, t) } else { exact(exact(0.0, -u, turn), u, t - turn) };
        worst = worst.max((p.d / p.r * run.twist()[2] - want).abs());
    }
    worst
}

#[test]
fn a_hard_start_is_even_until_the_back_emf_has_grown_and_a_reversal_too() {
    for (what, coarse, fine) in [
        ("three", off(three(), &THREE_WHEELS, 2e-3), off(three(), &THREE_WHEELS, 5e-4)),
        ("four", off(four(), &FOUR_WHEELS, 2e-3), off(four(), &FOUR_WHEELS, 5e-4)),
    ] {
        // in the step in which the limit lets go the torque changes by up to Δt/τ, τ of 0.1 s, of 400 rad/s²: half of that
        // times Δt; second order, but where in a step it falls is chance
        assert!(coarse < 0.5 * 400.0 * 2e-3 * 2e-3 / 0.1, "{what}: {coarse:e} rad/s");
        assert!(fine < 0.2 * coarse, "{what}: {coarse:e}, {fine:e} rad/s");
    }
}

#[test]
fn a_wheel_that_is_held_draws_what_its_voltage_drives_up_to_the_limit_and_no_more() {
    let mut robot = four::<f64>();
    robot.friction.coulomb = [1e3; 3];
    let resistance = robot.motor.resistance;
    for wheel in [None, Some(2)] {
        let mut run = Run::new(with_effect(robot, effect("current_limit"), wheel, &[LIMIT]));
        for u in [0.0, 1.0, 4.7, 4.8, 12.0, -3.0, -4.7, -9.0] {
            let read = run.drive([u; 4], 1e-3);
            let free = u / resistance;
            let held = if free.abs() > LIMIT { LIMIT * free.signum() } else { free };
            let exact = std::array::from_fn(|j| if wheel.is_none_or(|w| w == j) { held } else { free });
            assert!(gap(read.current, exact) < 1e-15, "{u} V: {:?}", read.current);
        }
    }
}

#[test]
fn a_limit_that_is_never_reached_changes_nothing() {
    let mut none = Run::new(with_effect(three::<f64>(), effect("current_limit"), None, &[0.0]));
    let mut high = Run::new(with_effect(three::<f64>(), effect("current_limit"), None, &[30.0]));
    for hold in voltages::<3>(6, 10, 9.0) {
        for _ in 0..hold.milliseconds {
            assert_eq!(none.drive(hold.u, 1e-3).current, high.drive(hold.u, 1e-3).current);
        }
    }
    assert_eq!(none.twist(), high.twist());
}

#[test]
fn with_dead_time_a_delay_slip_and_inductance_no_current_passes_it_either() {
    let mut effects = Effects::default();
    for id in ["actuation_delay", "dead_time", "current_limit", "winding_inductance", "wheel_slip", "rotor_inertia"] {
        let effect = effect(id);
        let params = if id == "current_limit" { vec![LIMIT] } else { typical(effect.card()) };
        effects.add(effect, None, &params).expect("room");
    }
    let mut run = Run::new(Plant::new(four::<f64>(), effects));
    let mut most = 0.0_f64;
    for hold in voltages::<4>(5, 20, 12.0) {
        for _ in 0..hold.milliseconds {
            run.drive(hold.u, 1e-3);
            most = run.state.current.into_iter().fold(most, |most, i| most.max(i.abs()));
        }
    }
    // rounding of the exponential that leads there
    assert!(most <= LIMIT + 1e-14 && most > 0.9 * LIMIT, "{most}");
}
