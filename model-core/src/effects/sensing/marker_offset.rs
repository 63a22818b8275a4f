//! # Marker offset: the camera follows a point beside the robot's centre
//!
//! ```text
//! (x, y)_read = (x, y) + R(θ)·(m_x, m_y)
//! ```
//!
//! The camera reads the position of a marker on the robot, and the model speaks of the centre of the wheels. A marker that
//! is not above it moves as the rigid body does: on straight ways like the centre, in a turn faster or slower by the yaw
//! rate times the offset. A robot that spins on the spot is seen to go round a circle.
//!
//! symbol    code          unit  meaning
//! --------  ------------  ----  --------------------------------------------------
//! m_x       `forward`     m     marker ahead of the centre, along the axis of v
//! m_y       `left`        m     marker to the left of the centre, along the axis of vn
//! θ         `pose.theta`  rad   heading
//! R(θ)                    1     turns the body's axes into those of the world (eq. 1)
//!
//! Behind a camera with [`camera_scale`](super::camera_scale) and [`camera_rotation`](super::camera_rotation) the offset is
//! counted as that camera shows it, in its scale and from the heading that it reads: (1 + s)·R(−b)·m for a marker at m on
//! the robot.
//!
//! Fails when: the robot leans, so that a high marker moves over its centre.
//! How to measure it: turn the robot by 180° on the spot: the position read before less that read after, halved and
//! turned back by the heading before, is (m_x, m_y).
//! Source: A point of a rigid body; sizes: estimated, a marker put on by hand is 2 to 20 mm off.

use crate::effects::card::{Card, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{EffectContext, Sense};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks};
use crate::geometry::frames::Pose;
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "marker_offset",
    title: "Offset of the marker",
    summary: "The marker that the camera follows is not above the robot's centre.",
    equation: "(x, y)_read = (x, y) + R(θ)·(m_x, m_y)",
    source: "a point of a rigid body; sizes: estimated, a marker put on by hand is 2 to 20 mm off",
    seams: &[Seam::Sense],
    scope: Scope::Robot,
    params: &[
        Param {
            key: "forward_m",
            symbol: "m_x",
            unit: "m",
            absent: 0.0,
            typical: 0.010,
            within: (-0.3, 0.3),
            role: Role::Size,
        },
        Param {
            key: "left_m",
            symbol: "m_y",
            unit: "m",
            absent: 0.0,
            typical: 0.005,
            within: (-0.3, 0.3),
            role: Role::Size,
        },
    ],
    needs_current: false,
    shows: Shows { channels: &[Channel::Position], regime: Regime::Turned, parity: Parity::Neither, order: None },
    signature: "x and y go round a circle while the robot spins, and are right on straight ways",
    look_alikes: &[],
    code: 23,
    undone: Undone::No("the control loop on the robot does not see the camera"),
    physics: Physics {
        // in a mirror left is right
        mirrored: &[1],
        ..Physics::PASSIVE
    },
};

/// The pose that a camera reads of a robot with a marker at (m_x, m_y) [m, m].
#[inline]
pub fn marked<T: Real>([forward, left]: [T; 2], pose: Pose<T>) -> Pose<T> {
    let (sin, cos) = pose.theta.sin_cos();
    // (x, y)_read = (x, y) + R(θ)·(m_x, m_y), written so that no offset keeps even the sign of a zero
    Pose {
        x: pose.x - (T::zero() - (cos * forward - sin * left)),
        y: pose.y - (T::zero() - (sin * forward + cos * left)),
        theta: pose.theta,
    }
}

/// Offset of the marker.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarkerOffset<T> {
    /// m_x, marker ahead of the centre [m]
    pub forward: T,
    /// m_y, marker to the left of the centre [m]
    pub left: T,
}

impl<T: Copy> Catalogued<T> for MarkerOffset<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[forward, left] = params else { return None };
        Some(Self { forward, left })
    }
}

impl<T: Real> Hooks<T> for MarkerOffset<T> {
    type State = ();

    fn sense(&self, _: &(), _: &EffectContext<T>, x: &mut Sense<T>) {
        x.pose = marked([self.forward, self.left], x.pose);
    }

    fn invert_sensing(&self, _: &EffectContext<T>, x: &mut Sense<T>) {
        // the heading is read rightly: as far from the marker to the centre as from the centre to the marker
        x.pose = marked([-self.forward, -self.left], x.pose);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::{FRAC_PI_2, PI};

    const HERE: Pose<f64> = Pose { x: 1.5, y: -0.4, theta: 2.1 };
    const TYPICAL: [f64; 2] = [0.010, 0.005];

    fn read(m: [f64; 2], pose: Pose<f64>) -> Sense<f64> {
        let mut x = Sense { pose, gyro: 0.7, ..Sense::default() };
        MarkerOffset::of(&m).expect("as many as on the card").sense(&(), &EffectContext::default(), &mut x);
        x
    }

    fn behind(m: [f64; 2], pose: Pose<f64>) -> Pose<f64> {
        let mut x = Sense { pose, ..Sense::default() };
        MarkerOffset::of(&m).expect("as many as on the card").invert_sensing(&EffectContext::default(), &mut x);
        x.pose
    }

    fn bits(p: Pose<f64>) -> [u64; 3] {
        [p.x, p.y, p.theta].map(f64::to_bits)
    }

    #[test]
    fn without_offset_the_pose_is_the_truth_bit_for_bit() {
        // headings in all quadrants: the offset turned is a zero of either sign
        for theta in [-0.0, 0.0, 0.7, 2.1, 4.0, 5.5, -0.7] {
            for pose in [Pose { theta, ..HERE }, Pose { x: -0.0, y: 0.0, theta }, Pose { x: 0.0, y: -0.0, theta }] {
                assert_eq!(bits(read([0.0; 2], pose).pose), bits(pose));
                assert_eq!(bits(behind([0.0; 2], pose)), bits(pose));
            }
        }
    }

    #[test]
    fn ahead_is_where_the_robot_looks_and_left_a_quarter_turn_on() {
        for (theta, m, seen) in [
            (0.0, [0.01, 0.0], [0.01, 0.0]),
            (0.0, [0.0, 0.01], [0.0, 0.01]),
            (FRAC_PI_2, [0.01, 0.0], [0.0, 0.01]),
            (FRAC_PI_2, [0.0, 0.01], [-0.01, 0.0]),
            (PI, [0.01, 0.005], [-0.01, -0.005]),
        ] {
            let x = read(m, Pose { x: 0.0, y: 0.0, theta }).pose;
            assert!((x.x - seen[0]).abs() < 1e-17 && (x.y - seen[1]).abs() < 1e-17, "{m:?} at {theta}: {x:?}");
        }
    }

    #[test]
    fn the_marker_stays_as_far_from_the_centre_whatever_the_heading() {
        for theta in [-20.0, -0.3, 2.9, 9.0] {
            let Sense { pose, gyro, .. } = read(TYPICAL, Pose { theta, ..HERE });
            let distance = libm::hypot(pose.x - HERE.x, pose.y - HERE.y);
            assert!((distance - libm::hypot(0.010, 0.005)).abs() < 1e-15);
            assert_eq!((pose.theta, gyro), (theta, 0.7));
        }
    }

    #[test]
    fn half_of_what_a_half_turn_moves_the_reading_by_is_the_offset() {
        let (a, b) = (read(TYPICAL, HERE).pose, read(TYPICAL, Pose { theta: HERE.theta + PI, ..HERE }).pose);
        let (sin, cos) = HERE.theta.sin_cos();
        let (x, y) = (0.5 * (a.x - b.x), 0.5 * (a.y - b.y));
        assert!((cos * x + sin * y - 0.010).abs() < 1e-15 && (cos * y - sin * x - 0.005).abs() < 1e-15);
    }

    #[test]
    fn reading_backwards_gives_the_truth() {
        for m in [TYPICAL, [-0.1, 0.1], [0.0, -0.03]] {
            let back = behind(m, read(m, HERE).pose);
            assert!((back.x - HERE.x).abs() < 1e-15 && (back.y - HERE.y).abs() < 1e-15, "{back:?} at {m:?}");
        }
    }
}
