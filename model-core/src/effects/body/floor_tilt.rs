//! # Floor tilt: the floor is not level
//!
//! ```text
//! F_v  = M·g·sin β · cos(φ − θ)
//! F_vn = M·g·sin β · sin(φ − θ)
//! ```
//!
//! On a tilted floor gravity pulls downhill with a force that is fixed in the world: a robot that turns feels it from
//! another side. It pulls at rest too, and the robot rolls away where friction lets it.
//!
//! symbol  code         unit   meaning
//! ------  -----------  -----  -----------------------------------------------
//! β       `tilt`       rad    steepest slope of the floor
//! φ       `direction`  rad    where downhill lies in the world, from x towards y
//! θ       `pose.theta` rad    heading of the robot
//! g                    m/s²   standard gravity
//!
//! A tilt has two components, and slope and direction are their polar form: at zero slope the direction means nothing.
//! A fit starts at the typical slope and has to try several directions. The normal forces, smaller by cos β, are left
//! as they are: 2 % at the steepest floor allowed, 0.02 % at one degree.
//!
//! Gravity pulls at the centre of mass: where another effect puts that beside the middle, the pull also turns the robot.
//!
//! Fails when: the floor is bent: then the slope depends on the place.
//! How to measure it: lay a spirit level on the floor; or drive the same way in both directions and compare.
//! Source: Gravity on an inclined plane; sizes: estimated for floors of rooms and halls, 0.2 to 2°.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{Body, EffectContext, STANDARD_GRAVITY};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::undoing::{BodyMotion, Place};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "floor_tilt",
    title: "Tilt of the floor",
    summary: "The floor is not level, so that gravity pulls the robot one way, whatever its heading.",
    equation: "F = M·g·sin β · (cos(φ − θ), sin(φ − θ))",
    source: "gravity on an inclined plane; sizes: estimated for floors of rooms and halls, 0.2 to 2°",
    seams: &[Seam::Body],
    scope: Scope::Robot,
    params: &[
        Param {
            key: "tilt_rad",
            symbol: "β",
            unit: "rad",
            absent: 0.0,
            typical: 0.0175,
            within: (0.0, 0.2),
            role: Role::Size,
        },
        Param {
            key: "direction_rad",
            symbol: "φ",
            unit: "rad",
            absent: 0.0,
            typical: 0.5,
            within: (-core::f64::consts::PI, core::f64::consts::PI),
            role: Role::Shape,
        },
    ],
    needs_current: false,
    shows: Shows { channels: &[Channel::WheelSpeed], regime: Regime::Motion, parity: Parity::Even, order: None },
    signature: "a constant force in the world frame, which dry friction hides at rest; in the body frame it turns with the heading",
    look_alikes: &[
        LookAlike {
            with: "carpet_nap",
            settled_by: "lay a spirit level on the floor, or turn the carpet round: the pull of a tilt stays, that of a pile turns with the carpet",
        },
        LookAlike {
            with: "cable_pull",
            settled_by: "drive the same way once without the cable: what still pulls is the floor",
        },
    ],
    code: 11,
    undone: Undone::By("the downhill pull is taken away, the heading being that of the reference"),
    physics: Physics {
        // gravity moves a robot without a motor
        passive: false,
        mirrored: &[1],
        direction: Some(1),
        ..Physics::PASSIVE
    },
};

/// Downhill pull over mass of a floor as steep as this [m/s²].
#[inline]
pub fn steepest<T: Real>(tilt: T) -> T {
    let (sin_tilt, _) = tilt.sin_cos();
    // g·sin β
    T::lit(STANDARD_GRAVITY) * sin_tilt
}

/// Force along the robot's axes (v, vn) over mass [m/s², m/s²], of a pull over mass [m/s²] that lies at `bearing` from
/// the heading [rad].
#[inline]
pub fn along_axes<T: Real>(steepest: T, bearing: T) -> [T; 2] {
    let (sin, cos) = bearing.sin_cos();
    // F/M = g·sin β · (cos(φ − θ), sin(φ − θ))
    [steepest * cos, steepest * sin]
}

/// Force along the robot's axes (v, vn) over mass [m/s², m/s²], downhill lying at `bearing` from the heading [rad].
#[inline]
pub fn pull<T: Real>(tilt: T, bearing: T) -> [T; 2] {
    along_axes(steepest(tilt), bearing)
}

/// Tilt of the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FloorTilt<T> {
    /// β, steepest slope of the floor [rad]
    pub tilt: T,
    /// φ, where downhill lies in the world, from x towards y [rad]
    pub direction: T,
}

impl<T: Copy> Catalogued<T> for FloorTilt<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[tilt, direction] = params else { return None };
        Some(Self { tilt, direction })
    }
}

impl<T: Real> Hooks<T> for FloorTilt<T> {
    type State = ();
    const UNDONE_AT: Option<Place> = Some(Place::Body);

    fn body(&self, _: &(), at: &EffectContext<T>, x: &mut Body<T>) {
        let Self { tilt, direction } = *self;
        let [v, vn] = pull(tilt, direction - at.pose.theta);
        for (force, row) in x.force.iter_mut().zip(x.mass) {
            // what accelerates every part of the body alike: F = mass matrix · (F_v/M, F_vn/M, 0);
            // 0 − a, taken away: a force that is absent then keeps even the sign of a zero
            *force -= T::zero() - (row[0] * v + row[1] * vn);
        }
    }

    fn undo_body(&self, motion: &BodyMotion<T>, needed: &mut [T; 3]) {
        let [v, vn] = pull(self.tilt, self.direction - motion.heading);
        needed[0] -= motion.mass * v;
        needed[1] -= motion.mass * vn;
        needed[2] -= motion.moment[0] * v + motion.moment[1] * vn;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::frames::{BodyTwist, Pose};
    use core::f64::consts::PI;

    fn pulled(p: [f64; 2], theta: f64, force: [f64; 3]) -> [f64; 3] {
        let at = EffectContext { pose: Pose { x: 0.4, y: -0.2, theta }, ..EffectContext::default() };
        let mut x = Body { mass: [[2.34, 0.0, 0.0], [0.0, 2.34, 0.0], [0.0, 0.0, 0.0228]], force, ..Body::default() };
        FloorTilt::of(&p).expect("as many as on the card").body(&(), &at, &mut x);
        x.force
    }

    #[test]
    fn on_a_level_floor_the_force_is_left_bit_for_bit() {
        for theta in [-2.0, 0.0, 0.5, 3.0] {
            let force = [0.3, -0.0, 0.0];
            assert_eq!(pulled([0.0, 0.5], theta, force).map(f64::to_bits), force.map(f64::to_bits));
        }
    }

    #[test]
    fn it_is_the_slope_of_the_potential_whatever_the_heading() {
        // height of the floor: −tan β along downhill; along the floor a way ds sinks by sin β·ds
        let (tilt, direction) = (0.0175, 0.5_f64);
        let (sin_tilt, _) = tilt.sin_cos();
        let (sin, cos) = direction.sin_cos();
        for k in 0..12 {
            let pose = Pose { theta: f64::from(k) * PI / 6.0 - 2.0, ..Pose::default() };
            let [v, vn, w] = pulled([tilt, direction], pose.theta, [0.0; 3]);
            let world = pose.to_world(BodyTwist { v, vn, w });
            assert!((world.x - 2.34 * 9.80665 * sin_tilt * cos).abs() < 1e-12);
            assert!((world.y - 2.34 * 9.80665 * sin_tilt * sin).abs() < 1e-12);
            assert_eq!(w, 0.0);
        }
    }

    #[test]
    fn the_robot_turned_round_feels_it_from_the_other_side() {
        let one = pulled([0.0175, 0.5], 0.2, [0.0; 3]);
        let other = pulled([0.0175, 0.5], 0.2 + PI, [0.0; 3]);
        assert!((one[0] + other[0]).abs() < 1e-12 && (one[1] + other[1]).abs() < 1e-12);
    }

    #[test]
    fn beside_the_middle_it_has_a_moment_that_is_the_pull_times_the_arm() {
        use crate::effects::body::cog_offset::CogOffset;
        let at = EffectContext { pose: Pose { theta: 0.2, ..Pose::default() }, ..EffectContext::default() };
        let mut x = Body { mass: [[2.34, 0.0, 0.0], [0.0, 2.34, 0.0], [0.0, 0.0, 0.0228]], ..Body::default() };
        CogOffset { offset_v: 0.03, offset_vn: -0.02 }.body(&(), &at, &mut x);
        FloorTilt { tilt: 0.0175, direction: 0.5 }.body(&(), &at, &mut x);
        let [v, vn, w] = x.force;
        assert_eq!([v, vn], pulled([0.0175, 0.5], 0.2, [0.0; 3])[..2]);
        assert!((w - (0.03 * vn + 0.02 * v)).abs() < 1e-15 && w.abs() > 1e-3, "{w}");
    }

    #[test]
    fn a_way_there_and_back_takes_no_work() {
        // a closed square driven at four headings
        let mut work = 0.0;
        for (theta, x, y) in [(0.3, 1.0, 0.0), (1.1, 0.0, 1.0), (-2.0, -1.0, 0.0), (2.9, 0.0, -1.0)] {
            let [v, vn, _] = pulled([0.0175, 0.5], theta, [0.0; 3]);
            let world = Pose { theta, ..Pose::default() }.to_world(BodyTwist { v, vn, w: 0.0 });
            work += world.x * x + world.y * y;
        }
        assert!(work.abs() < 1e-12);
    }
}
