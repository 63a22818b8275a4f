//! Gyro bias: what is read, summed up over a run, is the angle turned and a part that grows with time alone.

use model_core::plant::robot::Robot;

use crate::fixture::{Run, effect, four, three, with_effect};

const BIAS: f64 = 0.02;

/// The angle that the gyro counts over a run against that of the pose [rad].
fn counts<const N: usize>(robot: Robot<N, f64>) {
    let mut run = Run::new(with_effect(robot, effect("gyro_bias"), None, &[BIAS]));
    let mut counted = 0.0;
    for k in 0..1500 {
        // spins one way, then the other, then rests
        let u = [if k < 600 {
            5.0
        } else if k < 1000 {
            -3.0
        } else {
            0.0
        }; N];
        let before = run.drive(u, 1e-3);
        let after = run.clone().drive(u, 1e-3);
        counted += 0.5e-3 * (before.gyro + after.gyro);
    }
    let turned = run.pose()[2];
    // pose and count go by the same trapezoids: roundings of 1500 sums
    assert!((counted - turned - BIAS * 1.5).abs() < 1e-12, "counts {counted} on {turned} rad");
    assert!(turned.abs() > 1.0);
}

#[test]
fn what_the_gyro_counts_beyond_the_turn_grows_with_time_whatever_the_robot_does() {
    counts(three());
    counts(four());
}
