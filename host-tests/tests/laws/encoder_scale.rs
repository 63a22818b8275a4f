//! The scale of one encoder: turns that are counted against turns of the body, and what four wheels know of each other.

use host_tests::excitation::voltages;
use model_core::plant::robot::Robot;

use crate::fixture::{Run, effect, four, plain, three, with_effect};

const ODD: usize = 2;
const SCALE: f64 = 0.02;

/// The angle that each encoder counts while the robot turns on the spot, against that of the wheel [rad].
fn counts_as_the_body_turns<const N: usize>(robot: Robot<N, f64>) {
    let mut run = Run::new(with_effect(robot, effect("encoder_scale"), Some(ODD), &[SCALE]));
    let mut counted = [0.0; N];
    for k in 0..1500 {
        let u = if k < 1200 { [5.0; N] } else { [-3.0; N] };
        let before = run.drive(u, 1e-3);
        let after = run.clone().drive(u, 1e-3);
        for (counted, (before, after)) in counted.iter_mut().zip(before.wheel_speed.iter().zip(after.wheel_speed)) {
            *counted += 0.5e-3 * (before + after);
        }
    }
    let turned = run.pose()[2];
    for (j, counted) in counted.into_iter().enumerate() {
        let wheel = robot.wheels.wheels()[j];
        // the way of a rim is that of an arc about the centre, whatever drives it
        let angle = turned * wheel.distance / wheel.radius;
        let share = if j == ODD { 1.0 + SCALE } else { 1.0 };
        // pose and count go by the same trapezoids: roundings of 1500 sums
        assert!((counted - share * angle).abs() < 1e-11, "wheel {j} counts {counted} on {angle} rad");
        assert!(angle.abs() > 10.0);
    }
}

#[test]
fn while_the_body_turns_one_encoder_counts_a_fixed_share_too_many_turns() {
    counts_as_the_body_turns(three());
    counts_as_the_body_turns(four());
}

#[test]
fn wheels_that_contradict_each_other_do_so_by_the_share_of_the_odd_one() {
    let mut run = Run::new(with_effect(four::<f64>(), effect("encoder_scale"), Some(ODD), &[SCALE]));
    let mut most = 0.0_f64;
    for hold in voltages::<4>(3, 12, 9.0) {
        for _ in 0..hold.milliseconds {
            let [_, _, w] = run.twist();
            let read = run.drive(hold.u, 1e-3).wheel_speed;
            // opposite wheels roll against each other along the body's axes, so that each pair shows d/r·ω twice; what
            // the pair with the odd wheel shows beyond the other pair is s times the odd wheel's speed
            let beyond = (read[0] + read[2]) - (read[1] + read[3]);
            let odd = 2.0 * 0.089 / 0.0325 * w - read[0];
            assert!((beyond - SCALE * odd).abs() < 1e-12, "{read:?}: {beyond} of {odd}");
            most = most.max(beyond.abs());
        }
    }
    // the odd wheel goes at some 8 rad/s
    assert!(most > 0.1, "{most} rad/s");
}

#[test]
fn nothing_but_the_reading_of_that_wheel_knows_of_it() {
    let mut run = Run::new(with_effect(four::<f64>(), effect("encoder_scale"), Some(ODD), &[SCALE]));
    let mut without = Run::new(plain(four::<f64>()));
    for hold in voltages::<4>(3, 12, 9.0) {
        for _ in 0..hold.milliseconds {
            let (a, b) = (run.drive(hold.u, 1e-3), without.drive(hold.u, 1e-3));
            assert_eq!((a.current, a.pose, a.gyro), (b.current, b.pose, b.gyro));
            assert_eq!((run.twist(), run.pose()), (without.twist(), without.pose()));
            for j in (0..4).filter(|j| *j != ODD) {
                assert_eq!(a.wheel_speed[j], b.wheel_speed[j]);
            }
        }
    }
}
