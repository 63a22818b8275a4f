//! # Reference: the wanted motion, no faster changed than the robot can follow
//!
//! ```text
//! δ = want − x                                      what the command asks for
//! size = √((δ_v/(A_v·Δt))² + (δ_vn/(A_vn·Δt))²)     in steps of the largest acceleration
//! δ_(v,vn) ← δ_(v,vn)/max(1, size)                  its direction is kept
//! δ_ω ← δ_ω held within ±A_ω·Δt
//! x ← x + δ,   a = δ/Δt
//! ```
//!
//! | symbol | code | unit | meaning |
//! |---|---|---|---|
//! | x | `now` | m/s, rad/s | reference: the body twist that is asked of the wheels in this turn |
//! | want | `want` | m/s, rad/s | commanded body twist |
//! | A | `acceleration` | m/s², m/s², rad/s² | largest accelerations along v, along vn and about the vertical |
//! | Δt | `dt` | s | one motion turn |
//!
//! The two translations are limited together, so that a robot that is told to go somewhere goes there on a straight line
//! in (v, vn), whatever it can do; with A_v = A_vn the length of the acceleration is limited, with two numbers an ellipse.
//! Rotation has a limit of its own: a robot may turn slowly while it moves fast.
//!
//! All of it is in the body frame. A reference that turns needs no force for that in this model; the effect `coriolis`,
//! where it is compensated, adds what it does need.
//!
//! Neglects: the jerk at the start and at the end of a ramp. Fails when: the limits are larger than what the motors or the
//! floor can give; the motors' part is [`headroom`](crate::control::headroom)'s.
//!
//! How to measure A: raise it until the wheels slip or the headroom falls below one, and take two thirds.

use crate::geometry::frames::BodyTwist;
use crate::number::scalar::Real;

/// How fast the reference may change, ready to compute with.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AccelerationLimiter<T = f32> {
    /// 1/(A_v·Δt), 1/(A_vn·Δt) [s/m]
    per_step: [T; 2],
    /// A_ω·Δt [rad/s]
    yaw_step: T,
}

impl<T: Real> AccelerationLimiter<T> {
    /// The limiter for these largest accelerations [m/s², m/s², rad/s²] and this turn [s].
    ///
    /// An acceleration of zero or below, or one that is no number, lets that axis stand still.
    pub fn new(acceleration: [T; 3], dt: T) -> Self {
        // no step is smaller than 10⁻¹² m/s: its inverse stays a number, and nothing moves
        let step = acceleration.map(|a| if a * dt > T::lit(1e-12) { a * dt } else { T::lit(1e-12) });
        Self { per_step: [T::one() / step[0], T::one() / step[1]], yaw_step: step[2] }
    }

    /// By how much the reference changes in one turn on its way from `now` to `want` [m/s, m/s, rad/s].
    #[inline(always)]
    pub fn change(&self, now: BodyTwist<T>, want: BodyTwist<T>) -> BodyTwist<T> {
        let (v, vn) = (want.v - now.v, want.vn - now.vn);
        let w = within(want.w - now.w, self.yaw_step);
        let (p, q) = (v * self.per_step[0], vn * self.per_step[1]);
        let square = p * p + q * q;
        if square > T::one() {
            // δ/size; a wish so large that its square is no number stands for none
            let shrink = square.inverse_sqrt();
            return BodyTwist { v: shrink * v, vn: shrink * vn, w };
        }
        BodyTwist { v, vn, w }
    }
}

/// A number held within ± a limit; most are.
#[inline(always)]
fn within<T: Real>(x: T, limit: T) -> T {
    if !x.exceeds(limit) {
        x
    } else if x < T::zero() {
        -limit
    } else {
        limit
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_that_is_too_large_keeps_its_direction_and_has_the_largest_length() {
        let limiter = AccelerationLimiter::new([3.0_f64, 3.0, 20.0], 1e-3);
        let now = BodyTwist { v: 0.2, vn: -0.1, w: 1.0 };
        let change = limiter.change(now, BodyTwist { v: 1.0, vn: 0.5, w: -4.0 });
        // a product of a few roundings
        assert!((change.v * 0.6 - change.vn * 0.8).abs() < 1e-17);
        assert!((change.v * change.v + change.vn * change.vn - 9e-6).abs() < 1e-20);
        assert_eq!(change.w, -0.02);
    }

    #[test]
    fn two_limits_make_an_ellipse() {
        let limiter = AccelerationLimiter::new([4.0_f64, 2.0, 20.0], 1e-3);
        let change = limiter.change(BodyTwist::default(), BodyTwist { v: 9.0, vn: 9.0, w: 0.0 });
        let (p, q) = (change.v / 4e-3, change.vn / 2e-3);
        assert!((p * p + q * q - 1.0).abs() < 1e-14 && change.v == change.vn, "{change:?}");
    }

    #[test]
    fn what_is_near_is_reached_at_once_and_exactly() {
        let limiter = AccelerationLimiter::new([3.0_f32, 3.0, 20.0], 1e-3);
        let now = BodyTwist { v: 0.001, vn: -0.002, w: 0.015 };
        let change = limiter.change(now, BodyTwist::default());
        assert_eq!([now.v + change.v, now.vn + change.vn, now.w + change.w], [0.0; 3]);
    }

    #[test]
    fn an_axis_without_acceleration_stands_still() {
        for none in [0.0, -1.0, f64::NAN] {
            let limiter = AccelerationLimiter::new([none, 3.0, none], 1e-3);
            let change = limiter.change(BodyTwist::default(), BodyTwist { v: 1.0, vn: 0.0, w: 1.0 });
            assert!(change.v.abs() < 2e-12 && change.w.abs() < 2e-12, "{change:?}");
        }
    }
}
