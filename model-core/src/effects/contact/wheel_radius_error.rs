//! # Wheel radius error: one wheel is larger or smaller than the model says
//!
//! ```text
//! r → r·(1 + e)
//! ```
//!
//! Rollers wear, a rubber ring swells, a replaced wheel comes from another batch. A larger wheel turns more slowly at the
//! same speed of the robot, and pushes less at the same torque, so that the power is the same on both sides of the rim.
//! To the body it is a motor whose constants K_v and K_t are both divided by 1 + e; only the wheel's own speed tells the
//! two apart.
//!
//! symbol  code            unit  meaning
//! ------  --------------  ----  ------------------------------------------------
//! e       `radius_error`  1     this wheel's radius over that of the model, minus one
//! r       `radius`        m     wheel radius
//!
//! All wheels too large or too small by the same factor are a wrong `wheel_radius`, not this effect.
//!
//! Fails when: the wheel is worn on one side: then the radius depends on the angle.
//! How to measure it: turn the robot ten times on the spot by hand and count the turns of each wheel.
//! Source: Unequal wheel diameters: Borenstein, Feng, Measurement and correction of systematic odometry errors in mobile
//! robots, IEEE Transactions on Robotics and Automation 12, 1996; sizes: estimated for wear and swollen rings, 1 to 5 %.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{Contact, EffectContext};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "wheel_radius_error",
    title: "Radius error of one wheel",
    summary: "One wheel is larger or smaller than the model says, so that it turns more slowly or faster than expected.",
    equation: "r → r·(1 + e)",
    source: "unequal wheel diameters: Borenstein, Feng, Measurement and correction of systematic odometry errors in mobile robots, IEEE Transactions on Robotics and Automation 12, 1996; sizes: estimated for wear and swollen rings, 1 to 5 %",
    seams: &[Seam::Contact],
    scope: Scope::OneWheel,
    params: &[Param {
        key: "radius_error",
        symbol: "e",
        unit: "1",
        absent: 0.0,
        typical: 0.02,
        within: (-0.3, 0.3),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows { channels: &[Channel::WheelSpeed], regime: Regime::Speed, parity: Parity::Odd, order: None },
    signature: "one wheel's speed wrong by the same factor at any speed; on four wheels the speeds contradict each other",
    look_alikes: &[LookAlike {
        with: "motor_mismatch",
        settled_by: "turn the robot on the spot by hand: a wheel of another radius turns by another angle than the others, an odd motor does not",
    }],
    code: 18,
    undone: Undone::Folded("the wheel is counted with its own radius"),
    physics: Physics::PASSIVE,
};

/// The wheel's own radius [m].
#[inline]
pub fn own<T: Real>(radius_error: T, radius: T) -> T {
    // r·(1 + e)
    radius * (T::one() + radius_error)
}

/// Radius error of one wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelRadiusError<T> {
    /// e, this wheel's radius over that of the model, minus one [1]
    pub radius_error: T,
}

impl<T: Copy> Catalogued<T> for WheelRadiusError<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[radius_error] = params else { return None };
        Some(Self { radius_error })
    }
}

impl<T: Real> Hooks<T> for WheelRadiusError<T> {
    type State = ();
    const SETTLES_CONTACT: bool = true;

    fn contact(&self, _: &(), _: &EffectContext<T>, x: &mut Contact<T>) {
        x.radius = own(self.radius_error, x.radius);
    }

    fn fold_wheel(&self, x: &mut Contact<T>) {
        self.contact(&(), &EffectContext::default(), x);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain() -> Contact<f64> {
        let radius = 0.0325;
        Contact {
            row: [0.0, 1.0, 0.089],
            position: [0.089, 0.0],
            radius,
            per_radius: 1.0 / radius,
            ..Contact::default()
        }
    }

    fn touched(radius_error: f64, mut x: Contact<f64>) -> Contact<f64> {
        WheelRadiusError { radius_error }.contact(&(), &EffectContext::default(), &mut x);
        x.complete();
        x
    }

    #[test]
    fn without_error_the_contact_is_left_bit_for_bit() {
        let x = touched(0.0, plain());
        assert_eq!([x.radius, x.per_radius].map(f64::to_bits), [plain().radius, plain().per_radius].map(f64::to_bits));
        assert_eq!((x.row, x.position), (plain().row, plain().position));
    }

    #[test]
    fn a_larger_wheel_turns_more_slowly_and_pushes_less_by_the_same_factor() {
        let x = touched(0.02, plain());
        let (speed, torque) = (1.3, 0.2);
        // ω = v/r,  f = τ/r: f·v = τ·ω
        let (turns, force) = (speed * x.per_radius, torque * x.per_radius);
        assert!((turns * 1.02 - speed * plain().per_radius).abs() < 1e-12);
        assert!((force * speed - torque * turns).abs() < 1e-15);
        assert!(force < torque * plain().per_radius);
    }

    #[test]
    fn a_wheel_that_has_swollen_and_worn_back_is_the_old_one() {
        for e in [-0.3, -0.02, 0.1, 0.3] {
            let back = touched(-e / (1.0 + e), touched(e, plain()));
            assert!((back.radius - plain().radius).abs() < 1e-17, "{e}: {}", back.radius);
        }
    }
}
