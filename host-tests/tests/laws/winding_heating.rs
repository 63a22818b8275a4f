//! The heating of the windings: a wheel that is held at a voltage and one at a current, and that a restart keeps the warmth.

use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::plant::Input;
use model_core::plant::robot::Robot;

use crate::fixture::{Run, effect, four, three, with_effect};
use crate::newton::{frictionless, runge_kutta};

/// R_θ [K/W], τ [s], α [1/K], β [1/K]; warm so soon that a run of some seconds shows it.
const SIZES: [f64; 4] = [15.0, 5.0, 0.0039, 0.0011];

fn held<const N: usize>(mut robot: Robot<N, f64>) -> Run<N, f64> {
    robot.friction.coulomb = [1e3; 3];
    Run::new(with_effect(robot, effect("winding_heating"), None, &SIZES))
}

/// Largest error of the current of wheels that are held at voltages, over ten seconds [A].
fn at_a_voltage<const N: usize>(robot: Robot<N, f64>, u: [f64; N], dt: f64) -> f64 {
    let [thermal, tau, alpha, _] = SIZES;
    let resistance = robot.motor.resistance;
    let mut run = held(robot);
    let (mut rise, mut worst) = ([0.0; N], 0.0_f64);
    for _ in 0..(10.0 / dt).round() as u32 {
        let read = run.drive(u, dt);
        for j in 0..N {
            worst = worst.max((read.current[j] - u[j] / (resistance * (1.0 + alpha * rise[j]))).abs());
            // τ·dΔT/dt = R_θ·u²/R(ΔT) − ΔT
            let rate = |[rise]: [f64; 1]| [(thermal * u[j] * u[j] / (resistance * (1.0 + alpha * rise)) - rise) / tau];
            [rise[j]] = runge_kutta(rate, [rise[j]], dt);
        }
    }
    assert!(rise.iter().any(|rise| *rise > 50.0), "it gets warm: {rise:?}");
    worst
}

#[test]
fn held_at_a_voltage_a_motor_warms_up_as_newtons_law_of_cooling_says() {
    for (u, dt) in [([6.0, -3.0, 0.5], 0.02), ([-6.0, 6.0, 2.0], 0.005)] {
        let (coarse, fine) = (at_a_voltage(three(), u, dt), at_a_voltage(three(), u, dt / 2.0));
        // the heat is that of the resistance at the step's beginning, first order: 0.1 A/s of a warming motor
        assert!(coarse < 0.1 * dt && fine < 0.55 * coarse, "{coarse:e}, {fine:e} A at {dt} s");
    }
    let (coarse, fine) =
        (at_a_voltage(four(), [6.0, -3.0, 0.5, 0.0], 0.01), at_a_voltage(four(), [6.0, -3.0, 0.5, 0.0], 0.005));
    assert!(coarse < 1e-3 && fine < 0.55 * coarse, "{coarse:e}, {fine:e} A");
}

#[test]
fn in_the_end_as_much_heat_goes_out_as_the_current_makes() {
    let [thermal, _, alpha, _] = SIZES;
    let robot = four::<f64>();
    let (u, resistance) = ([6.0, -4.0, 2.0, 0.0], robot.motor.resistance);
    let mut run = held(robot);
    for _ in 0..10_000 {
        run.drive(u, 0.02);
    }
    let read = run.drive(u, 0.02);
    for (u, current) in u.into_iter().zip(read.current) {
        // ΔT·(1 + α·ΔT) = R_θ·u²/R, the positive root
        let power = thermal * u * u / resistance;
        let rise = ((1.0 + 4.0 * alpha * power).sqrt() - 1.0) / (2.0 * alpha);
        // 40 time constants
        let exact = u / (resistance * (1.0 + alpha * rise));
        assert!((current - exact).abs() < 1e-12, "{current} against {exact}");
    }
}

/// At an imposed current the heat grows with the rise, so that R_θ·R·i²·α of the cooling is lost:
/// ΔT = ΔT∞·(1 − e^(−t/τ′)), τ′ = τ/(1 − q·α), ΔT∞ = q/(1 − q·α), q = R_θ·R·i². The torque for that current falls by β·ΔT.
fn loses_torque<const N: usize>(robot: Robot<N, f64>, dt: f64) -> f64 {
    let [thermal, tau, alpha, beta] = SIZES;
    let (i, kt) = (1.2, robot.motor.gear_ratio * robot.motor.torque_constant);
    let heat = thermal * robot.motor.resistance * i * i;
    let (last, slow) = (heat / (1.0 - heat * alpha), tau / (1.0 - heat * alpha));
    // without friction, all motors alike: J·dω/dt = N·d/r·τ_w
    let robot = frictionless(robot);
    let wheel = robot.wheels.wheels()[0];
    let per_torque = N as f64 * wheel.distance / wheel.radius / robot.inertia;
    let mut run = Run::new(with_effect(robot, effect("winding_heating"), None, &SIZES));
    let mut worst = 0.0_f64;
    for k in 1..=(4.0 / dt).round() as u32 {
        run.step(&Input::Current([i; N]), dt);
        let t = f64::from(k) * dt;
        // ∫(1 − β·ΔT) dt
        let strong = t - beta * last * (t + slow * (-t / slow).exp_m1());
        worst = worst.max((run.twist()[2] / (per_torque * kt * i) - strong).abs());
    }
    worst
}

#[test]
fn at_an_imposed_current_the_torque_falls_by_the_closed_form() {
    for (coarse, fine) in [
        (loses_torque(three(), 0.02), loses_torque(three(), 0.01)),
        (loses_torque(four(), 0.02), loses_torque(four(), 0.01)),
    ] {
        // ΔT of the step's beginning: half a step late, of a loss of up to β·ΔT = 7 %
        assert!(coarse < 0.07 * 0.02 && fine < 0.55 * coarse && coarse > 1e-6, "{coarse:e}, {fine:e} s");
    }
}

#[test]
fn a_restart_in_the_middle_keeps_the_motors_warm_and_a_new_run_is_cold() {
    let u = [6.0; 4];
    let mut run = held(four());
    let cold = run.drive(u, 0.01).current;
    for _ in 0..500 {
        run.drive(u, 0.01);
    }
    let state =
        run.plant.start_from(&run.state, run.state.time, Pose { x: 1.0, y: 2.0, theta: 0.5 }, BodyTwist::default());
    run.plant.restart(&state, &mut run.memory);
    let mut goes_on = run.clone();
    goes_on.state = state;
    let (warm, other) = (run.drive(u, 0.01).current, goes_on.drive(u, 0.01).current);
    assert!(warm == other && warm[0] < 0.9 * cold[0], "{warm:?}, {other:?}, cold {cold:?}");
    assert_eq!(held(four()).drive(u, 0.01).current, cold);
}

#[test]
fn wheels_whose_speeds_are_imposed_stay_as_warm_as_their_cooling_lets_them() {
    let mut run = held(four());
    for _ in 0..500 {
        run.drive([6.0; 4], 0.01);
    }
    let warm = run.drive([6.0; 4], 0.01).current[0];
    for _ in 0..500 {
        run.step(&Input::Speed([0.0; 4]), 0.01);
    }
    // 5 s are one time constant
    let r = run.plant.robot().motor.resistance;
    let rise = |current: f64| (6.0 / (r * current) - 1.0) / SIZES[2];
    let cooler = rise(run.drive([6.0; 4], 0.01).current[0]);
    // a step of heating between the two readings, 0.6 K
    assert!((cooler / rise(warm) - (-1.0_f64).exp()).abs() < 0.01, "{cooler} K after {} K", rise(warm));
}
