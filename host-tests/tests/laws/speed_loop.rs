//! The answer of a speed loop, in the whole plant: closed forms of a lag after a dead time, and a robot whose body goes
//! where its wheels do.

use model_core::plant::Input;
use model_core::plant::robot::Robot;

use crate::fixture::{Run, effect, four, gap, three, with_effect};

const DEAD_TIME: f64 = 0.037;
const LAG: f64 = 0.09;
const DROOP: f64 = 0.04;

/// Speed and angle of a wheel from rest, told to turn at 1 rad/s: 1 − e^(−s/T) and s − T·(1 − e^(−s/T)), s = t − t_d.
fn of_a_unit(t: f64) -> [f64; 2] {
    let s = (t - DEAD_TIME).max(0.0);
    let reached = -(-s / LAG).exp_m1();
    [reached, s - LAG * reached].map(|x| (1.0 - DROOP) * x)
}

/// A turn on the spot, with steps of this length [s].
fn turns_on_the_spot<const N: usize>(robot: Robot<N, f64>, dt: f64) {
    let mut run = Run::new(with_effect(robot, effect("speed_loop"), None, &[DEAD_TIME, LAG, DROOP]));
    let set = 20.0;
    let wheel = robot.wheels.wheels()[0];
    while run.state.time < 0.8 {
        let t = run.state.time;
        let read = run.step(&Input::SetSpeed([set; N]), dt);
        // a wheel is read within a hundredth of the step
        let [speed, angle] = of_a_unit(t).map(|x| set * x);
        let room = set / LAG * 0.01 * dt + 1e-9;
        assert!(gap(read.wheel_speed, [speed; N]) < room, "{:?} against {speed} at {t} s", read.wheel_speed);
        assert!((read.gyro - speed * wheel.radius / wheel.distance).abs() < room);
        // the way is exact, whatever the step: the sum of means
        let turned = angle * wheel.radius / wheel.distance;
        assert!((read.pose.theta - turned).abs() < 1e-12, "{} against {turned} rad at {t} s", read.pose.theta);
    }
    assert!(run.pose()[2] > 1.0);
}

#[test]
fn a_turn_on_the_spot_is_the_closed_form_at_steps_of_any_length() {
    for dt in [1e-3, 0.01, 0.033] {
        turns_on_the_spot(three(), dt);
        turns_on_the_spot(four(), dt);
    }
}

#[test]
fn one_wheel_that_answers_late_is_late_alone() {
    let mut run = Run::new(with_effect(four::<f64>(), effect("speed_loop"), Some(2), &[DEAD_TIME, LAG, DROOP]));
    for _ in 0..300 {
        let t = run.state.time;
        let read = run.step(&Input::SetSpeed([10.0; 4]), 1e-3).wheel_speed;
        let late = 10.0 * of_a_unit(t)[0];
        assert_eq!([read[0], read[1], read[3]], [10.0; 3]);
        assert!((read[2] - late).abs() < 10.0 / LAG * 1e-5 + 1e-9, "{} against {late}", read[2]);
    }
}

#[test]
fn speeds_that_are_measured_are_no_command_and_voltages_know_no_speed_loop() {
    for input in [Input::Speed([3.0, -2.0, 5.0, 1.0]), Input::Voltage([3.0, -2.0, 5.0, 1.0])] {
        let mut with = Run::new(with_effect(four::<f64>(), effect("speed_loop"), None, &[DEAD_TIME, LAG, DROOP]));
        let mut without = Run::new(crate::fixture::plain(four::<f64>()));
        for _ in 0..100 {
            let read = [with.step(&input, 1e-3), without.step(&input, 1e-3)];
            assert_eq!(read[0].wheel_speed, read[1].wheel_speed);
            assert_eq!(with.twist(), without.twist());
        }
    }
}
