//! # Camera scale: distances are read too long
//!
//! ```text
//! (x, y)_read = (1 + s)·(x, y)
//! ```
//!
//! A camera overhead that is calibrated on the floor sees a marker above the floor too far out: at a height h below a
//! camera at the height H by the share s = h/(H − h), by similar triangles. A focal length or a length of the calibration
//! pattern that is wrong does the same. Every way is then read too long by one share, while heading and wheels are right.
//!
//! symbol  code           unit  meaning
//! ------  -------------  ----  ----------------------------------------------------------
//! s       `scale_error`  1     share by which a distance is read too long
//! x, y    `pose`         m     position in the world, whose origin the camera reads rightly
//!
//! Which point is read rightly cannot be seen: another one shifts every reading alike, as another origin would.
//!
//! Fails when: the lens distorts, or the camera looks at a slant: then the share depends on the place.
//! How to measure it: move the robot along a tape measure: s is the distance read over that of the tape, less 1.
//! Source: Pinhole camera (Hartley and Zisserman, Multiple View Geometry in Computer Vision, chapter 6); sizes: h/(H − h)
//! of markers at 50 to 150 mm below cameras at 2.5 to 4 m, 1 to 6 %.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{EffectContext, Sense};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks};
use crate::geometry::frames::Pose;
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "camera_scale",
    title: "Scale of the camera",
    summary: "The camera reads distances too long or too short by a constant share.",
    equation: "(x, y)_read = (1 + s)·(x, y)",
    source: "pinhole camera (Hartley and Zisserman, Multiple View Geometry in Computer Vision, chapter 6); sizes: h/(H − h) of markers at 50 to 150 mm below cameras at 2.5 to 4 m, 1 to 6 %",
    seams: &[Seam::Sense],
    scope: Scope::Robot,
    params: &[Param {
        key: "scale_error",
        symbol: "s",
        unit: "1",
        absent: 0.0,
        typical: 0.02,
        within: (-0.2, 0.2),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows { channels: &[Channel::Position], regime: Regime::Distance, parity: Parity::Odd, order: None },
    signature: "x and y change by one share more than the wheels say, in all directions alike",
    look_alikes: &[
        LookAlike {
            with: "wheel_radius",
            settled_by: "drive a metre along a tape measure: a camera of a wrong scale reads another length than the tape",
        },
        LookAlike {
            with: "camera_perspective",
            settled_by: "move the robot along a tape measure on both sides of the floor: a wrong scale reads both too long by the same share",
        },
    ],
    code: 21,
    undone: Undone::No("the control loop on the robot does not see the camera"),
    physics: Physics::PASSIVE,
};

/// The pose that a camera reads.
#[inline]
pub fn scaled<T: Real>(scale_error: T, pose: Pose<T>) -> Pose<T> {
    let factor = T::one() + scale_error;
    // (x, y)_read = (1 + s)·(x, y)
    Pose { x: pose.x * factor, y: pose.y * factor, theta: pose.theta }
}

/// Scale of the camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraScale<T> {
    /// s, share by which a distance is read too long [1]
    pub scale_error: T,
}

impl<T: Copy> Catalogued<T> for CameraScale<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[scale_error] = params else { return None };
        Some(Self { scale_error })
    }
}

impl<T: Real> Hooks<T> for CameraScale<T> {
    type State = ();

    fn sense(&self, _: &(), _: &EffectContext<T>, x: &mut Sense<T>) {
        x.pose = scaled(self.scale_error, x.pose);
    }

    fn invert_sensing(&self, _: &EffectContext<T>, x: &mut Sense<T>) {
        let factor = T::one() + self.scale_error;
        x.pose = Pose { x: x.pose.x / factor, y: x.pose.y / factor, ..x.pose };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HERE: Pose<f64> = Pose { x: 1.5, y: -0.4, theta: 2.1 };

    fn read(scale_error: f64, pose: Pose<f64>) -> Sense<f64> {
        let mut x = Sense { pose, gyro: 0.7, ..Sense::default() };
        CameraScale { scale_error }.sense(&(), &EffectContext::default(), &mut x);
        x
    }

    fn behind(scale_error: f64, pose: Pose<f64>) -> Pose<f64> {
        let mut x = Sense { pose, ..Sense::default() };
        CameraScale { scale_error }.invert_sensing(&EffectContext::default(), &mut x);
        x.pose
    }

    fn bits(p: Pose<f64>) -> [u64; 3] {
        [p.x, p.y, p.theta].map(f64::to_bits)
    }

    #[test]
    fn without_scale_error_the_pose_is_the_truth_bit_for_bit() {
        for pose in [HERE, Pose { x: -0.0, y: 0.0, theta: -0.0 }, Pose { x: 0.1, y: -0.0, theta: 0.3 }] {
            assert_eq!(bits(read(0.0, pose).pose), bits(pose));
            assert_eq!(bits(behind(0.0, pose)), bits(pose));
        }
    }

    #[test]
    fn a_distance_is_read_too_long_by_the_share_in_every_direction() {
        let there = Pose { x: -0.3, y: 0.9, theta: 0.2 };
        for s in [0.02, -0.2, 0.2] {
            let (a, b) = (read(s, HERE).pose, read(s, there).pose);
            let (seen, true_one) = (libm::hypot(a.x - b.x, a.y - b.y), libm::hypot(HERE.x - there.x, HERE.y - there.y));
            assert!((seen / true_one - 1.0 - s).abs() < 1e-15, "{seen} of {true_one} m at {s}");
        }
    }

    #[test]
    fn the_origin_the_heading_and_the_yaw_rate_are_read_rightly() {
        let origin = read(0.02, Pose { x: 0.0, y: 0.0, theta: 2.1 });
        assert_eq!((origin.pose.x, origin.pose.y, origin.pose.theta, origin.gyro), (0.0, 0.0, 2.1, 0.7));
    }

    #[test]
    fn reading_backwards_gives_the_truth() {
        for s in [-0.2, -0.013, 0.02, 0.2] {
            let back = behind(s, read(s, HERE).pose);
            assert!((back.x - HERE.x).abs() < 1e-15 && (back.y - HERE.y).abs() < 1e-15, "{back:?} at {s}");
            assert_eq!(back.theta, HERE.theta);
        }
    }
}
