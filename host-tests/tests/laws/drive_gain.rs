//! The gain of one bridge: another robot by Thévenin's theorem, and the currents that an offset drives round.

use host_tests::excitation::{VoltageHold, voltages};
use host_tests::generic_robot::GenericRobot;
use host_tests::paper::{FOUR_HEADINGS_DEG, FOUR_WHEELS, THREE_HEADINGS_DEG, THREE_WHEELS};
use host_tests::reference::Reference;
use model_core::effects::active::Effects;
use model_core::plant::Plant;
use model_core::plant::robot::Robot;

use crate::fixture::{Run, core_robot, effect, four, gap, three, with_effect};
use crate::newton::frictionless;

const ODD: usize = 1;

/// A bridge that gives 1 + g times the command is, for current and torque, a motor with R/(1 + g) and K_v/(1 + g) behind
/// a true bridge: (u·(1 + g) − K_v·ω)/R = (u − K_v/(1 + g)·ω)/(R/(1 + g)).
fn is_another_motor_behind_a_true_bridge<const N: usize>(rig: GenericRobot<N>, gain: f64) {
    let mut other = rig;
    other.wheels[ODD].drivetrain.resistance /= 1.0 + gain;
    other.wheels[ODD].drivetrain.kv /= 1.0 + gain;
    let mut exact = Reference::derived(&other);
    let robot = core_robot::<N, f64>(&rig);
    let mut run = Run::new(with_effect(robot, effect("drive_gain"), Some(ODD), &[gain, 0.0]));
    let mut apart = [0.0_f64; 3];
    for hold in voltages::<N>(4, 12, 9.0) {
        for _ in 0..hold.milliseconds {
            let current = exact.currents(hold.u);
            let read = run.drive(hold.u, 1e-3);
            exact.advance(hold.u, 1e-3);
            let ([v, vn, w], [a, b, c]) = (run.twist(), exact.twist);
            let now = [gap([v, vn], [a, b]), (w - c).abs(), gap(read.current, current)];
            apart = std::array::from_fn(|k| apart[k].max(now[k]));
        }
    }
    // the step's own error at 1 ms (proof/integration.rs): 8e-6 m/s, 1.2e-4 rad/s, and with them 1e-5 A; a gain of 1.3
    // makes one motor as much stronger
    let most = [8e-6, 1.2e-4, 1e-5].map(|most| 1.3 * most);
    assert!(apart.iter().zip(most).all(|(apart, most)| *apart < most), "{gain}: {apart:?}");
}

#[test]
fn a_wrong_gain_is_a_motor_with_less_resistance_and_back_emf_behind_a_true_bridge() {
    for gain in [-0.3, -0.05, 0.3] {
        is_another_motor_behind_a_true_bridge(THREE_WHEELS.generic(THREE_HEADINGS_DEG), gain);
        is_another_motor_behind_a_true_bridge(FOUR_WHEELS.generic(FOUR_HEADINGS_DEG), gain);
    }
}

/// A robot without friction, with an offset on one bridge, after all has settled under voltages [V]: (speeds, currents).
fn settled<const N: usize>(mut robot: Robot<N, f64>, params: [f64; 2], u: [f64; N]) -> ([f64; N], [f64; N]) {
    robot = frictionless(robot);
    let mut run = Run::new(with_effect(robot, effect("drive_gain"), Some(ODD), &params));
    // 20 s are some 40 of the slowest time constant, below 0.5 s
    run.play(&[VoltageHold { u, milliseconds: 20_000 }], 1, |_, _| {});
    let read = run.drive(u, 1e-3);
    (read.wheel_speed, read.current)
}

#[test]
fn without_friction_each_of_three_wheels_runs_at_the_speed_of_the_voltage_across_its_motor() {
    let robot = three::<f64>();
    let emf = robot.motor.gear_ratio * robot.motor.emf_constant;
    let (speed, current) = settled(robot, [-0.05, 0.2], [4.0, 2.0, -3.0]);
    // three forces that hold a body at rest are all zero: no current flows; 2 V less 5 % and 0.2 V more are 2.1 V
    assert!(gap(speed, [4.0 / emf, 2.1 / emf, -3.0 / emf]) < 1e-9, "{speed:?}");
    assert!(gap(current, [0.0; 3]) < 1e-9, "{current:?}");
}

#[test]
fn on_four_wheels_a_quarter_of_an_offset_drives_a_current_through_every_motor() {
    let robot = four::<f64>();
    let (_, current) = settled(robot, [0.0, 0.2], [0.0; 4]);
    // forces (f, −f, f, −f) move no body, so the wheels brake the odd one: 4·R·i = o round the four
    let round = 0.2 / (4.0 * robot.motor.resistance);
    assert!(gap(current, [-round, round, -round, round]) < 1e-9, "{current:?} against {round}");
}

#[test]
fn behind_a_delay_it_is_the_delayed_command_that_is_scaled_and_the_offset_that_is_not_delayed() {
    let (delay, gain) = ([0.0037], [-0.05, 0.0]);
    let mut effects = Effects::default();
    effects.add(effect("actuation_delay"), None, &delay).expect("room");
    effects.add(effect("drive_gain"), Some(ODD), &gain).expect("room");
    let mut run = Run::new(Plant::new(four::<f64>(), effects));
    let mut told = Run::new(with_effect(four::<f64>(), effect("actuation_delay"), None, &delay));
    for hold in voltages::<4>(2, 10, 9.0) {
        let mut weaker = hold.u;
        weaker[ODD] *= 0.95;
        for _ in 0..hold.milliseconds {
            let (a, b) = (run.drive(hold.u, 1e-3), told.drive(weaker, 1e-3));
            // a delay is linear: the same but for roundings of 9 V
            assert!(gap(a.current, b.current) < 1e-12 && gap(run.twist(), told.twist()) < 1e-11);
        }
    }
    let mut effects = Effects::default();
    effects.add(effect("actuation_delay"), None, &delay).expect("room");
    effects.add(effect("drive_gain"), Some(ODD), &[0.0, 0.2]).expect("room");
    let mut run = Run::new(Plant::new(four::<f64>(), effects));
    let here = run.drive([5.0; 4], 1e-3);
    // nothing of the 5 V has come when the first current is sampled: what flows is o/R
    assert!(gap(here.current, [0.0, 0.2 / 4.3111, 0.0, 0.0]) < 1e-15, "{:?}", here.current);
}
