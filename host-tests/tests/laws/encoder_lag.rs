//! The lag of the encoders: closed forms of a low-pass on a ramp and on an exponential, and that it loses no angle.

use host_tests::excitation::voltages;
use host_tests::paper::{FOUR_WHEELS, PaperRobot, THREE_WHEELS};
use model_core::effects::active::Effects;
use model_core::plant::robot::Robot;
use model_core::plant::{Input, Plant};

use crate::fixture::{Run, effect, four, plain, three, typical, with_effect};
use crate::newton::frictionless;

const LAG: f64 = 0.008;

fn lagging<const N: usize>(robot: Robot<N, f64>) -> Plant<N, f64> {
    with_effect(robot, effect("encoder_lag"), None, &[LAG])
}

#[test]
fn on_a_ramp_of_imposed_speeds_the_reading_is_the_closed_form_at_steps_of_any_length() {
    let rates = [300.0, -120.0, 0.0, 45.0];
    // after a restart at the speeds w₀ = 0
    let mut run = Run::new(lagging(four::<f64>()));
    run.plant.restart(&run.state, &mut run.memory);
    let lengths = [1e-4, 0.02, 1e-3, 0.005, 3e-4, 0.01];
    for dt in lengths.into_iter().cycle().take(120) {
        let t = run.state.time;
        let read = run.step(&Input::Speed(rates.map(|rate| rate * t)), dt);
        for (rate, read) in rates.into_iter().zip(read.wheel_speed) {
            // T·dr/dt + r = a·t from r(0) = 0:  r = a·(t − T·(1 − e^(−t/T)))
            let exact = rate * (t + LAG * (-t / LAG).exp_m1());
            // roundings of up to 220 rad/s
            assert!((read - exact).abs() < 1e-12, "{read} against {exact} at {t} s");
        }
    }
}

/// A robot without friction, from rest, all motors at the same voltage: it turns on the spot, and the wheels follow
/// w = w∞·(1 − e^(−t/τ)), which the low-pass makes w∞·(1 − (τ·e^(−t/τ) − T·e^(−t/T))/(τ − T)).
fn follows_a_start<const N: usize>(mut robot: Robot<N, f64>, p: &PaperRobot, dt: f64) -> f64 {
    robot = frictionless(robot);
    let u = 6.0;
    let settled = u / (p.l * p.kv);
    // J·dω/dt = N·d/r·l·Kt·i
    let tau = p.inertia * p.resistance * p.r * p.r / (N as f64 * p.d * p.d * p.l * p.l * p.kt * p.kv);
    let mut run = Run::new(lagging(robot));
    run.plant.restart(&run.state, &mut run.memory);
    let mut worst = 0.0_f64;
    while run.state.time < 5.0 * tau {
        let t = run.state.time;
        let read = run.drive([u; N], dt).wheel_speed;
        let exact = settled * (1.0 - (tau * (-t / tau).exp() - LAG * (-t / LAG).exp()) / (tau - LAG));
        worst = read.into_iter().fold(worst, |worst, read| worst.max((read - exact).abs()));
    }
    // lag times the first acceleration is what there is to see
    assert!(worst < 0.01 * LAG * settled / tau, "{worst} of {} rad/s", LAG * settled / tau);
    worst * (tau / dt).powi(2) / settled
}

#[test]
fn the_start_of_a_robot_is_read_as_the_closed_form_of_two_time_constants_says() {
    for dt in [2.5e-4, 1e-3] {
        // in parts of w∞·(Δt/τ)²: the straight line between steps is off by an eighth of it, and the plant's own step by
        // 1/(12·e)
        let most = 1.0 / 8.0 + 1.0 / (12.0 * std::f64::consts::E);
        let off = [follows_a_start(three(), &THREE_WHEELS, dt), follows_a_start(four(), &FOUR_WHEELS, dt)];
        assert!(off.iter().all(|off| *off < most), "{off:?} at {dt} s");
    }
}

#[test]
fn between_rest_and_rest_no_angle_is_lost() {
    // ∫(w − r) dt = T·(r_end − r_start)
    let (mut run, mut without) = (Run::new(lagging(four::<f64>())), Run::new(plain(four::<f64>())));
    let (mut counted, mut turned, mut most) = ([0.0; 4], [0.0; 4], 0.0_f64);
    let mut holds = voltages::<4>(7, 8, 9.0);
    holds.iter_mut().for_each(|hold| hold.milliseconds = 100);
    for k in 0..1500 {
        let u = holds.get(k / 100).map_or([0.0; 4], |hold| hold.u);
        let (read, truth) = (run.drive(u, 1e-3).wheel_speed, without.drive(u, 1e-3).wheel_speed);
        for j in 0..4 {
            counted[j] += 1e-3 * read[j];
            turned[j] += 1e-3 * truth[j];
            most = most.max((counted[j] - turned[j]).abs());
        }
    }
    assert_eq!(run.twist(), [0.0; 3]);
    for j in 0..4 {
        // sums for integrals from rest to rest: Δt²/12 times each bend of the true speed, 16 of up to 600 rad/s²
        assert!((counted[j] - turned[j]).abs() < 1e-3, "{counted:?} of {turned:?} rad");
    }
    assert!(most > 0.1, "on the way {most} rad are behind");
}

#[test]
fn a_lag_behind_an_encoder_of_wrong_scale_is_read_at_that_scale() {
    let scale = effect("encoder_scale");
    let mut effects = Effects::default();
    effects.add(effect("encoder_lag"), None, &[LAG]).expect("room");
    effects.add(scale, Some(1), &typical(scale.card())).expect("room");
    let (mut both, mut alone) = (Run::new(Plant::new(three::<f64>(), effects)), Run::new(lagging(three::<f64>())));
    for hold in voltages::<3>(5, 8, 9.0) {
        for _ in 0..hold.milliseconds {
            let (a, b) = (both.drive(hold.u, 1e-3).wheel_speed, alone.drive(hold.u, 1e-3).wheel_speed);
            // a low-pass is linear: it does not matter which comes first
            assert_eq!(a, [b[0], b[1] * 1.02, b[2]]);
        }
    }
}
