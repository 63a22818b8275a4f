//! Gain of the current sensor: on all wheels alike it is a robot whose motors have another resistance and torque constant.

use host_tests::excitation::voltages;
use model_core::plant::robot::Robot;

use crate::fixture::{Run, effect, four, gap, plain, three, with_effect};

const GAIN: f64 = 0.05;

#[test]
fn motors_that_draw_the_current_that_is_read_make_the_same_recording() {
    fn check<const N: usize>(robot: Robot<N, f64>) {
        // (u − K·ω)/(R/(1 + g)) is what is read, and K_t/(1 + g) of it the torque
        let mut other = robot;
        other.motor.resistance /= 1.0 + GAIN;
        other.motor.torque_constant /= 1.0 + GAIN;
        let mut seen = Run::new(with_effect(robot, effect("current_sensor_gain"), None, &[GAIN]));
        let mut same = Run::new(plain(other));
        for hold in voltages::<N>(8, 20, 9.0) {
            for _ in 0..hold.milliseconds {
                let (a, b) = (seen.drive(hold.u, 1e-3), same.drive(hold.u, 1e-3));
                // roundings of some ampere and m/s, which friction keeps small
                assert!(gap(a.current, b.current) < 1e-12 && gap(a.wheel_speed, b.wheel_speed) < 1e-11);
                assert!(gap(seen.twist(), same.twist()) < 1e-12);
            }
        }
    }
    check(three());
    check(four());
}

#[test]
fn on_one_wheel_the_currents_of_four_no_longer_balance() {
    // four rims have one combination that the body does not feel: at rest on a locked robot, equal and opposite voltages
    // draw equal and opposite currents, but for the sensor
    let mut run = Run::new(with_effect(four(), effect("current_sensor_gain"), Some(2), &[GAIN]));
    let read = run.drive([0.5, -0.5, 0.5, -0.5], 1e-3).current;
    let each = 0.5 / 4.3111;
    assert!(gap(read, [each, -each, (1.0 + GAIN) * each, -each]) < 1e-15);
}
