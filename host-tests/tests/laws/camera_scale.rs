//! Scale of the camera: a pinhole camera that sees a marker above the floor on which it was calibrated.

use host_tests::excitation::voltages;
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::plant::Input;
use model_core::plant::robot::Robot;

use crate::fixture::{Run, effect, four, gap, three, with_effect};

/// Camera and marker above the floor [m].
const CAMERA: f64 = 3.0;
const MARKER: f64 = 0.12;

/// What a pinhole camera above the origin says that it sees: calibrated so that points of the floor are read rightly.
fn through_a_pinhole([x, y]: [f64; 2]) -> [f64; 2] {
    let focal_length = 900.0;
    // a point at the depth z stands at f·x/z in the picture; what stands there on the floor is at depth H
    [x, y].map(|x| focal_length * x / (CAMERA - MARKER) / (focal_length / CAMERA))
}

fn position(pose: Pose<f64>) -> [f64; 2] {
    [pose.x, pose.y]
}

#[test]
fn a_marker_above_the_floor_is_read_where_a_pinhole_camera_sees_it() {
    fn check<const N: usize>(robot: Robot<N, f64>) {
        let share = MARKER / (CAMERA - MARKER);
        let plant = with_effect(robot, effect("camera_scale"), None, &[share]);
        let mut run = Run::from(plant, [1.0, -0.5, 0.3], [0.4, -0.3, 2.0]);
        for hold in voltages::<N>(3, 20, 9.0) {
            for _ in 0..hold.milliseconds {
                let (truth, gyro) = (run.state.pose, run.state.twist.w);
                let read = run.drive(hold.u, 1e-3);
                // roundings of some metres
                assert!(gap(position(read.pose), through_a_pinhole(position(truth))) < 1e-14);
                assert_eq!((read.pose.theta, read.gyro), (truth.theta, gyro));
                let back = run.plant.invert_sensing(run.state.time, run.state.twist, read);
                assert!(gap(position(back.pose), position(truth)) < 1e-14);
            }
        }
    }
    check(three());
    check(four());
}

/// Radius of the circle through three points [m].
fn circumradius([a, b, c]: [[f64; 2]; 3]) -> f64 {
    let side = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
    let twice_the_area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    side(a, b) * side(b, c) * side(c, a) / (2.0 * twice_the_area)
}

#[test]
fn a_circle_is_read_too_large_and_gone_round_too_fast_but_in_the_same_time() {
    fn check<const N: usize>(robot: Robot<N, f64>) {
        let (v, w, share) = (0.8, 2.0, 0.02);
        let plant = with_effect(robot, effect("camera_scale"), None, &[share]);
        let speeds = robot.wheels.wheel_speeds(BodyTwist { v, vn: 0.0, w });
        let mut run = Run::from(plant, [0.7, 0.2, 0.3], [0.0; 3]);
        let read: Vec<_> = (0..=2000).map(|_| run.step(&Input::Speed(speeds), 1e-3).pose).collect();
        let radius = circumradius([0, 900, 1700].map(|k| position(read[k])));
        // chords of the plant's steps are too long by (ω·Δt)²/24 = 1.7e-7 of themselves
        assert!((radius / (v / w) - 1.02).abs() < 2e-7, "{radius} m");
        for pair in read.windows(2) {
            let [a, b] = [position(pair[0]), position(pair[1])];
            let (speed, turn) = ((b[0] - a[0]).hypot(b[1] - a[1]) / 1e-3, (pair[1].theta - pair[0].theta) / 1e-3);
            // positions of 1 m are rounded by 2e-16 m, headings of 4 rad by 9e-16 rad, over 1 ms
            assert!((speed - 1.02 * v).abs() < 1e-12 && (turn - w).abs() < 2e-12, "{speed} m/s, {turn} rad/s");
            // the robot is still seen to go where it looks
            let middle = 0.5 * (pair[0].theta + pair[1].theta);
            assert!(((b[1] - a[1]) * middle.cos() - (b[0] - a[0]) * middle.sin()).abs() < 1e-15);
        }
    }
    check(three());
    check(four());
}
