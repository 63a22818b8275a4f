//! Perspective of the camera: a pinhole camera that leans, calibrated where it is rightly read.

use host_tests::excitation::voltages;
use model_core::plant::robot::Robot;

use crate::fixture::{Run, effect, four, gap, three, with_effect, wrapped};

/// Camera above the floor [m], and by how much it leans [rad], which way [rad].
const HEIGHT: f64 = 3.0;
const LEAN: f64 = 0.06;
const TOWARDS: f64 = 0.9;

/// Where a point of the floor stands in the picture: turned into the camera's axes, over its depth.
fn picture([x, y]: [f64; 2]) -> [f64; 2] {
    let ((sin, cos), (s, c)) = (TOWARDS.sin_cos(), LEAN.sin_cos());
    // along the lean and across it; the axis looks down, and forwards by the lean
    let (along, across) = (cos * x + sin * y, cos * y - sin * x);
    let (ahead, depth) = (c * along - s * HEIGHT, c * HEIGHT + s * along);
    let (u, v) = (ahead / depth, across / depth);
    [cos * u - sin * v, sin * u + cos * v]
}

/// What the camera says: the picture, by the origin and the slopes that were calibrated right under it.
struct Calibrated {
    origin: [f64; 2],
    /// Inverse of the slopes of the picture by x and y
    inverse: [[f64; 2]; 2],
}

impl Calibrated {
    fn new() -> Self {
        let h = 1e-4;
        let slope = |a: [f64; 2], b: [f64; 2]| [0, 1].map(|k| (picture(a)[k] - picture(b)[k]) / (2.0 * h));
        let ([a, c], [b, d]) = (slope([h, 0.0], [-h, 0.0]), slope([0.0, h], [0.0, -h]));
        let determinant = a * d - b * c;
        let inverse = [[d / determinant, -b / determinant], [-c / determinant, a / determinant]];
        Self { origin: picture([0.0; 2]), inverse }
    }

    fn says(&self, point: [f64; 2]) -> [f64; 2] {
        let seen = picture(point);
        let (u, v) = (seen[0] - self.origin[0], seen[1] - self.origin[1]);
        self.inverse.map(|[a, b]| a * u + b * v)
    }
}

#[test]
fn a_robot_is_read_where_and_as_turned_as_a_pinhole_camera_that_leans_shows_it() {
    fn check<const N: usize>(robot: Robot<N, f64>) {
        // the floor towards the lean is farther away: shorter
        let k = -LEAN.tan() / HEIGHT;
        let params = [k * TOWARDS.cos(), k * TOWARDS.sin()];
        let camera = Calibrated::new();
        let plant = with_effect(robot, effect("camera_perspective"), None, &params);
        let mut run = Run::from(plant, [1.0, -0.5, 0.3], [0.4, -0.3, 2.0]);
        for hold in voltages::<N>(3, 20, 9.0) {
            for _ in 0..hold.milliseconds {
                let (truth, gyro) = (run.state.pose, run.state.twist.w);
                let read = run.drive(hold.u, 1e-3);
                // slopes over 0.2 mm: (k·h)² = 4e-12 of them, and roundings of 1e-16 over 2e-4
                assert!(gap([read.pose.x, read.pose.y], camera.says([truth.x, truth.y])) < 3e-11);
                // the line between two points 20 µm apart on the robot
                let (sin, cos) = truth.theta.sin_cos();
                let end = |s: f64| camera.says([truth.x + s * cos, truth.y + s * sin]);
                let ([a, b], [c, d]) = (end(1e-5), end(-1e-5));
                assert!(wrapped((b - d).atan2(a - c) - read.pose.theta).abs() < 2e-10);
                assert_eq!(read.gyro, gyro);
                let back = run.plant.invert_sensing(run.state.time, run.state.twist, read);
                let off = gap([back.pose.x, back.pose.y, back.pose.theta], [truth.x, truth.y, truth.theta]);
                // roundings of some metres and turns
                assert!(off < 1e-13, "{off:e}");
            }
        }
    }
    check(three());
    check(four());
}
