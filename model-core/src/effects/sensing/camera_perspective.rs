//! # Perspective of the camera: distances are read longer on one side than on the other
//!
//! ```text
//! p_read = p/(1 − k·p)        k·p = k_x·x + k_y·y
//! ```
//!
//! A camera overhead that leans is nearer to the floor on one side: there a metre is read longer, and on the other side
//! shorter. Straight ways stay straight, and squares become trapeziums. Of all that a camera and a flat floor can do to each
//! other (a homography), this is what is left when the middle, the axes and the scale there are read rightly; a camera at
//! the height H that leans by τ has |k| = tan τ/H. A lean that was calibrated on markers of another height is the same.
//!
//! The heading is that of a short line on the robot, from one of its ends to the other, and is turned as the camera turns
//! such a line: by the derivative of p_read.
//!
//! symbol    code                              unit  meaning
//! --------  --------------------------------  ----  -------------------------------------------------------------
//! k_x, k_y  `perspective_x`, `perspective_y`  1/m   share by which the scale of lines across grows, a metre along x, y
//! p         `pose`                            m     position in the world, whose origin the camera reads rightly
//!
//! Fails when: the lens distorts: then straight ways are bent.
//! How to measure it: lay two rods of one length side by side on the floor, a metre apart: the share by which one is read
//! longer than the other is k along the way from one to the other.
//! Source: Homography of a plane, its projective part alone: Hartley and Zisserman, Multiple View Geometry in Computer
//! Vision, ch. 2; sizes: tan τ/H of cameras at 2 to 4 m that lean by 1 to 5°, 0.4 to 4 % per metre.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{EffectContext, Sense};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks};
use crate::geometry::frames::Pose;
use crate::number::scalar::Real;

/// Least of 1 − k·p [1]: closer to the camera's horizon nothing is seen, and the reading grows no further.
const HORIZON: f64 = 0.1;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "camera_perspective",
    title: "Perspective of the camera",
    summary: "The camera leans, so that it reads distances longer on one side than on the other.",
    equation: "p_read = p/(1 − k_x·x − k_y·y)",
    source: "homography of a plane, its projective part alone: Hartley and Zisserman, Multiple View Geometry in Computer Vision, ch. 2; sizes: tan τ/H of cameras at 2 to 4 m that lean by 1 to 5°, 0.4 to 4 % per metre",
    seams: &[Seam::Sense],
    scope: Scope::Robot,
    params: &[
        Param {
            key: "perspective_x_per_m",
            symbol: "k_x",
            unit: "1/m",
            absent: 0.0,
            typical: 0.01,
            within: (-0.1, 0.1),
            role: Role::Size,
        },
        Param {
            key: "perspective_y_per_m",
            symbol: "k_y",
            unit: "1/m",
            absent: 0.0,
            typical: -0.008,
            within: (-0.1, 0.1),
            role: Role::Size,
        },
    ],
    needs_current: false,
    shows: Shows {
        channels: &[Channel::Position, Channel::Heading],
        regime: Regime::Distance,
        parity: Parity::Even,
        order: None,
    },
    signature: "x and y change by more than the wheels say on one side of the floor and by less on the other",
    look_alikes: &[LookAlike {
        with: "camera_scale",
        settled_by: "move the robot along a tape measure on both sides of the floor: a wrong scale reads both too long by the same share",
    }],
    code: 46,
    undone: Undone::No("the control loop on the robot does not see the camera"),
    physics: Physics { mirrored: &[1], ..Physics::PASSIVE },
};

/// The pose that a camera reads; with −k the way back.
#[inline]
pub fn seen<T: Real>([k_x, k_y]: [T; 2], pose: Pose<T>) -> Pose<T> {
    let Pose { x, y, theta } = pose;
    let left = (T::one() - (k_x * x + k_y * y)).max(T::lit(HORIZON));
    let (sin, cos) = theta.sin_cos();
    let along = k_x * cos + k_y * sin;
    // e_read ∝ e·(1 − k·p) + p·(k·e); by how much it is turned: (e × e_read, e · e_read)
    let (across, ahead) = (along * (cos * y - sin * x), left + along * (cos * x + sin * y));
    // p_read = p/(1 − k·p); the turn is written so that none keeps even the sign of a zero
    Pose { x: x / left, y: y / left, theta: theta - (T::zero() - across.atan2(ahead)) }
}

/// Perspective of the camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraPerspective<T> {
    /// k_x, share by which the scale of lines across grows, a metre along x [1/m]
    pub perspective_x: T,
    /// k_y, the same along y [1/m]
    pub perspective_y: T,
}

impl<T: Copy> Catalogued<T> for CameraPerspective<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[perspective_x, perspective_y] = params else { return None };
        Some(Self { perspective_x, perspective_y })
    }
}

impl<T: Real> Hooks<T> for CameraPerspective<T> {
    type State = ();

    fn sense(&self, _: &(), _: &EffectContext<T>, x: &mut Sense<T>) {
        x.pose = seen([self.perspective_x, self.perspective_y], x.pose);
    }

    fn invert_sensing(&self, _: &EffectContext<T>, x: &mut Sense<T>) {
        // p = p_read/(1 + k·p_read)
        x.pose = seen([-self.perspective_x, -self.perspective_y], x.pose);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HERE: Pose<f64> = Pose { x: 1.5, y: -0.4, theta: 2.1 };
    const TYPICAL: [f64; 2] = [0.01, -0.008];

    fn read(k: [f64; 2], pose: Pose<f64>) -> Sense<f64> {
        let mut x = Sense { pose, gyro: 0.7, ..Sense::default() };
        CameraPerspective::of(&k).expect("as many as on the card").sense(&(), &EffectContext::default(), &mut x);
        x
    }

    fn behind(k: [f64; 2], pose: Pose<f64>) -> Pose<f64> {
        let mut x = Sense { pose, ..Sense::default() };
        CameraPerspective::of(&k).expect("as many as on the card").invert_sensing(&EffectContext::default(), &mut x);
        x.pose
    }

    fn bits(p: Pose<f64>) -> [u64; 3] {
        [p.x, p.y, p.theta].map(f64::to_bits)
    }

    #[test]
    fn without_perspective_the_pose_is_the_truth_bit_for_bit() {
        for theta in [-0.0, 0.0, 0.7, 2.1, 4.0, -0.7] {
            for pose in [Pose { theta, ..HERE }, Pose { x: -0.0, y: 0.0, theta }, Pose { x: 0.1, y: -0.0, theta }] {
                assert_eq!(bits(read([0.0; 2], pose).pose), bits(pose));
                assert_eq!(bits(behind([0.0; 2], pose)), bits(pose));
            }
        }
    }

    #[test]
    fn the_origin_the_heading_there_and_the_yaw_rate_are_read_rightly() {
        let x = read([0.1, -0.1], Pose { x: 0.0, y: 0.0, theta: 2.1 });
        assert_eq!((x.pose.x, x.pose.y, x.pose.theta, x.gyro), (0.0, 0.0, 2.1, 0.7));
    }

    #[test]
    fn a_metre_further_along_k_lines_across_are_read_longer_by_k() {
        let ends = [0.1, -0.1].map(|y| read([0.02, 0.0], Pose { x: 1.0, y, theta: 0.0 }).pose.y);
        assert!(((ends[0] - ends[1]) / 0.2 - 1.0 / 0.98).abs() < 1e-14);
        let ends = [0.1, -0.1].map(|y| read([0.02, 0.0], Pose { x: -1.0, y, theta: 0.0 }).pose.y);
        assert!(((ends[0] - ends[1]) / 0.2 - 1.0 / 1.02).abs() < 1e-14);
    }

    #[test]
    fn straight_ways_stay_straight_and_the_heading_is_that_of_the_way() {
        for theta in [0.3, 2.0, -1.2] {
            let (sin, cos) = libm::sincos(theta);
            let on = |s: f64| read([0.05, -0.08], Pose { x: 0.8 + s * cos, y: -0.5 + s * sin, theta }).pose;
            let (a, b, c) = (on(-1.0), on(0.3), on(1.0));
            assert!(((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)).abs() < 1e-15);
            // the way that is read points where the heading that is read does, all along it
            let way = libm::atan2(c.y - a.y, c.x - a.x);
            assert!([a, b, c].iter().all(|p| (p.theta - way).abs() < 1e-14), "{way}: {a:?} {b:?} {c:?}");
        }
    }

    #[test]
    fn reading_backwards_gives_the_truth() {
        for k in [TYPICAL, [0.1, 0.1], [-0.1, 0.03]] {
            for theta in [2.1, -20.0, 0.0] {
                let back = behind(k, read(k, Pose { theta, ..HERE }).pose);
                let off = (back.x - HERE.x).abs().max((back.y - HERE.y).abs()).max((back.theta - theta).abs());
                assert!(off < 1e-14, "{back:?} at {k:?}");
            }
        }
    }

    #[test]
    fn at_the_horizon_and_behind_it_the_reading_stays_finite() {
        for x in [9.99, 10.0, 10.01, 1e6] {
            let p = read([0.1, 0.0], Pose { x, y: 1.0, theta: 0.5 }).pose;
            assert!(p.x.is_finite() && p.y.is_finite() && (p.theta - 0.5).abs() < 4.0);
        }
    }
}
