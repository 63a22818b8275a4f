//! # Camera rotation: the heading is off against the axes of the position
//!
//! ```text
//! θ_read = θ + b
//! ```
//!
//! The camera reads the position in the axes of its picture and the heading from the pattern of the marker. A marker that
//! is put on turned, or a heading that is counted from other axes than the position, makes the two disagree by a constant
//! angle: a robot that drives forward is then seen to drive aslant.
//!
//! symbol  code              unit  meaning
//! ------  ----------------  ----  -------------------------------------------------------
//! b       `heading_offset`  rad   heading that is read less the true one, anticlockwise
//! θ       `pose.theta`      rad   heading in the axes in which the camera reads the position
//!
//! No more than this one angle can be seen. A camera that turns position and heading alike reads rightly in another world
//! frame, so the axes of the position are the world's by definition. One that reads the heading rightly and turns the
//! position by −b is this effect, seen in a world that is turned by b.
//!
//! Fails when: the lens distorts, or the camera looks at a slant: then the angle depends on the place.
//! How to measure it: drive straight forward: b is the heading that is read less the direction of the way that is read.
//! Source: Change of axes in the plane; sizes: estimated, a marker put on by hand is turned by 1 to 5°.

use crate::effects::card::{Card, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{EffectContext, Sense};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "camera_rotation",
    title: "Rotation of the camera",
    summary: "The camera reads the heading turned by a constant angle against the axes in which it reads the position.",
    equation: "θ_read = θ + b",
    source: "change of axes in the plane; sizes: estimated, a marker put on by hand is turned by 1 to 5°",
    seams: &[Seam::Sense],
    scope: Scope::Robot,
    params: &[Param {
        key: "heading_offset_rad",
        symbol: "b",
        unit: "rad",
        absent: 0.0,
        typical: 0.035,
        // beyond that the two are frames that somebody has mixed up, and the checks of a recording say so
        within: (-0.2, 0.2),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows { channels: &[Channel::Position], regime: Regime::Distance, parity: Parity::Odd, order: None },
    signature: "the robot seems to drive aslant by a constant angle; lengths and turns are right",
    look_alikes: &[],
    code: 22,
    undone: Undone::No("the control loop on the robot does not see the camera"),
    physics: Physics {
        // in a mirror the heading is off the other way
        mirrored: &[0],
        ..Physics::PASSIVE
    },
};

/// Heading that is read [rad].
#[inline]
pub fn heading<T: Real>(heading_offset: T, theta: T) -> T {
    // θ_read = θ + b, written so that no offset keeps even the sign of a zero
    theta - (T::zero() - heading_offset)
}

/// Rotation of the camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraRotation<T> {
    /// b, heading that is read less the true one [rad]
    pub heading_offset: T,
}

impl<T: Copy> Catalogued<T> for CameraRotation<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[heading_offset] = params else { return None };
        Some(Self { heading_offset })
    }
}

impl<T: Real> Hooks<T> for CameraRotation<T> {
    type State = ();

    fn sense(&self, _: &(), _: &EffectContext<T>, x: &mut Sense<T>) {
        x.pose.theta = heading(self.heading_offset, x.pose.theta);
    }

    fn invert_sensing(&self, _: &EffectContext<T>, x: &mut Sense<T>) {
        x.pose.theta -= self.heading_offset;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::frames::Pose;

    fn read(heading_offset: f64, theta: f64) -> Sense<f64> {
        let mut x = Sense { pose: Pose { x: 1.5, y: -0.4, theta }, gyro: 0.7, ..Sense::default() };
        CameraRotation { heading_offset }.sense(&(), &EffectContext::default(), &mut x);
        x
    }

    fn behind(heading_offset: f64, theta: f64) -> f64 {
        let mut x = Sense { pose: Pose { theta, ..Pose::default() }, ..Sense::default() };
        CameraRotation { heading_offset }.invert_sensing(&EffectContext::default(), &mut x);
        x.pose.theta
    }

    #[test]
    fn without_offset_the_heading_is_the_truth_bit_for_bit() {
        for theta in [0.0, -0.0, 0.4, -17.3] {
            assert_eq!(read(0.0, theta).pose.theta.to_bits(), theta.to_bits());
            assert_eq!(behind(0.0, theta).to_bits(), theta.to_bits());
        }
    }

    #[test]
    fn the_heading_is_off_by_the_offset_in_its_direction_whatever_it_is() {
        assert_eq!(read(0.035, 0.0).pose.theta, 0.035);
        assert_eq!(read(-0.5, 0.0).pose.theta, -0.5);
        for theta in [-20.0, -0.3, 2.9, 9.0] {
            assert!((read(0.035, theta).pose.theta - theta - 0.035).abs() < 4e-15);
        }
    }

    #[test]
    fn position_and_yaw_rate_are_read_rightly() {
        let x = read(0.035, 0.8);
        assert_eq!((x.pose.x, x.pose.y, x.gyro), (1.5, -0.4, 0.7));
    }

    #[test]
    fn reading_backwards_gives_the_truth() {
        for b in [-0.5, 0.035, 0.5] {
            assert!((behind(b, read(b, 2.1).pose.theta) - 2.1).abs() < 1e-15);
        }
    }
}
