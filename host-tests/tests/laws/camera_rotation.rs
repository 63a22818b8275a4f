//! Rotation of the camera: what is left of a camera's turn when its choice of the world's axes is taken off.

use host_tests::excitation::voltages;
use model_core::geometry::frames::BodyTwist;
use model_core::plant::Input;
use model_core::plant::robot::Robot;

use crate::fixture::{Run, effect, four, gap, plain, three, with_effect, wrapped};

const OFFSET: f64 = 0.035;

#[test]
fn the_robot_is_seen_to_drive_aslant_by_the_offset_however_it_moves() {
    fn check<const N: usize>(robot: Robot<N, f64>) {
        let plant = with_effect(robot, effect("camera_rotation"), None, &[OFFSET]);
        for [v, vn, w] in [[0.8, 0.0, 0.0], [0.0, -0.5, 0.0], [-0.6, 0.4, 3.0], [0.5, 0.5, -6.0]] {
            let speeds = robot.wheels.wheel_speeds(BodyTwist { v, vn, w });
            let mut run = Run::from(plant, [0.3, -0.2, 1.1], [0.0; 3]);
            let read: Vec<_> = (0..500).map(|_| run.step(&Input::Speed(speeds), 1e-3).pose).collect();
            for pair in read.windows(2) {
                let (dx, dy) = (pair[1].x - pair[0].x, pair[1].y - pair[0].y);
                // the chord of a step lies along the velocity in its middle
                let seen = dy.atan2(dx) - 0.5 * (pair[0].theta + pair[1].theta);
                let wheels_say = f64::atan2(vn, v);
                // a way of 0.5 mm between positions that are rounded by 2e-16 m
                assert!(wrapped(wheels_say - seen - OFFSET).abs() < 2e-12, "{seen} at {v}, {vn}, {w}");
                assert!((dx.hypot(dy) - v.hypot(vn) * 1e-3).abs() < 1e-15);
                assert!((pair[1].theta - pair[0].theta - w * 1e-3).abs() < 2e-15);
            }
        }
    }
    check(three());
    check(four());
}

/// A camera whose picture is turned, while its heading is right: it reads the position in axes that lie at `angle`.
fn in_turned_axes([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    // along the unit vectors (cos, sin) and (−sin, cos)
    [x * angle.cos() + y * angle.sin(), y * angle.cos() - x * angle.sin()]
}

#[test]
fn it_is_a_camera_with_turned_axes_in_a_world_that_is_turned() {
    fn check<const N: usize>(robot: Robot<N, f64>) {
        let start = [1.0, -0.5, 0.3];
        let mut run =
            Run::from(with_effect(robot, effect("camera_rotation"), None, &[OFFSET]), start, [0.4, -0.3, 2.0]);
        // the same robot in a world turned by b: there its position is (x, y) in axes that lie at b, its heading θ + b
        let [x, y] = in_turned_axes([start[0], start[1]], -OFFSET);
        let mut turned = Run::from(plain(robot), [x, y, start[2] + OFFSET], [0.4, -0.3, 2.0]);
        for hold in voltages::<N>(4, 20, 9.0) {
            for _ in 0..hold.milliseconds {
                let truth = run.state.pose;
                let (here, there) = (run.drive(hold.u, 1e-3), turned.drive(hold.u, 1e-3));
                let [x, y] = in_turned_axes([there.pose.x, there.pose.y], OFFSET);
                // thousands of steps, each rounded by some 1e-16
                assert!(gap([here.pose.x, here.pose.y, here.pose.theta], [x, y, there.pose.theta]) < 1e-11);
                assert_eq!((here.current, here.gyro), (there.current, there.gyro));
                let back = run.plant.invert_sensing(run.state.time, run.state.twist, here).pose;
                assert!((back.x, back.y) == (truth.x, truth.y) && (back.theta - truth.theta).abs() < 1e-14);
            }
        }
    }
    check(three());
    check(four());
}
