//! # Wheel friction: one wheel turns harder than the others
//!
//! ```text
//! τ_f = τ_b·sign(ω) + b·ω
//! ```
//!
//! The friction of the model belongs to the body and is spread over all wheels. A bearing that is clamped too tight, hair
//! around an axle or a rim that touches its guard brakes one wheel alone. The dry part is a budget: it opposes motion,
//! and holds a wheel that stands up to τ_b. The viscous part is that of the grease.
//!
//! symbol  code       unit   meaning
//! ------  ---------  -----  ----------------------------------------
//! τ_b     `torque`   N·m    dry friction of this wheel at its shaft
//! b       `damping`  N·m·s  viscous friction of this wheel at its shaft
//! ω       `speed`    rad/s  speed of the wheel shaft
//!
//! Friction that all wheels have alike is not this effect: it is Coulomb and viscous friction of the body.
//!
//! Fails when: the friction changes as the wheel goes round, as of a bent axle or a rim that rubs in one place.
//! How to measure it: lift the robot, raise the voltage of each wheel until it turns, and read the current at which it
//! does: the tight wheel needs more. The slope of current over speed shows b.
//! Source: Coulomb and viscous friction: Olsson, Åström, Canudas de Wit, Gäfvert, Lischinsky, Friction models and friction
//! compensation, European Journal of Control 4, 1998; sizes: estimated, 0.005 to 0.1 N·m and up to 1e-3 N·m·s.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{EffectContext, Gear};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::undoing::{Place, RimMotion, way};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "wheel_friction",
    title: "Friction of one wheel",
    summary: "One wheel turns harder than the others, as with a tight bearing.",
    equation: "τ_f = τ_b·sign(ω) + b·ω",
    source: "Coulomb and viscous friction: Olsson, Åström, Canudas de Wit, Gäfvert, Lischinsky, Friction models and friction compensation, European Journal of Control 4, 1998; sizes: estimated, 0.005 to 0.1 N·m and up to 1e-3 N·m·s",
    seams: &[Seam::Gear],
    scope: Scope::OneWheel,
    params: &[
        Param {
            key: "torque_Nm",
            symbol: "τ_b",
            unit: "N·m",
            absent: 0.0,
            typical: 0.02,
            within: (0.0, 3.0),
            role: Role::Size,
        },
        Param {
            key: "damping_Nms",
            symbol: "b",
            unit: "N·m·s",
            absent: 0.0,
            typical: 1e-4,
            within: (0.0, 0.1),
            role: Role::Size,
        },
    ],
    needs_current: false,
    shows: Shows {
        channels: &[Channel::YawRate, Channel::WheelSpeed],
        regime: Regime::Motion,
        parity: Parity::Odd,
        order: None,
    },
    signature: "torque short on one wheel alone, by as much both ways (τ_b) or in step with its speed (b)",
    look_alikes: &[LookAlike {
        with: "asymmetric_friction",
        settled_by: "lift the robot and raise the wheel's voltage slowly until it turns, once each way: the two differ if friction is asymmetric",
    }],
    code: 15,
    undone: Undone::By("the wheel's own friction is added to its torque, by the rim speed of the reference"),
    physics: Physics::DRY_AT_WHEELS,
};

/// Torque that friction takes from a wheel [N·m] that turns at a speed [rad/s]; `way` is the sign of it.
#[inline]
pub fn taken<T: Real>(torque: T, damping: T, way: T, speed: T) -> T {
    // τ_f = τ_b·sign(ω) + b·ω
    torque * way + damping * speed
}

/// Friction of one wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelFriction<T> {
    /// τ_b, dry friction of this wheel at its shaft [N·m]
    pub torque: T,
    /// b, viscous friction of this wheel at its shaft [N·m·s]
    pub damping: T,
}

impl<T: Copy> Catalogued<T> for WheelFriction<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[torque, damping] = params else { return None };
        Some(Self { torque, damping })
    }
}

impl<T: Real> Hooks<T> for WheelFriction<T> {
    type State = ();
    const UNDONE_AT: Option<Place> = Some(Place::Shaft);

    fn gear(&self, _: &(), _: &EffectContext<T>, x: &mut Gear<T>) {
        let Self { torque, damping } = *self;
        x.budget += torque;
        x.damping += damping;
    }

    fn undo_shaft(&self, motion: &RimMotion<T>, torque: &mut T) {
        *torque += taken(self.torque, self.damping, way(motion.speed), motion.wheel_speed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAIN: Gear<f64> = Gear {
        motor_torque: 0.1,
        coulomb_share: 0.02,
        torque: 0.1,
        budget: 0.013,
        bias: 0.0,
        damping: 1e-4,
        inertia: 2e-5,
    };

    fn geared(p: [f64; 2]) -> Gear<f64> {
        let mut x = PLAIN;
        WheelFriction::of(&p).expect("as many as on the card").gear(&(), &EffectContext::default(), &mut x);
        x
    }

    #[test]
    fn without_friction_of_its_own_the_gear_is_left_bit_for_bit() {
        let bits = |x: Gear<f64>| [x.torque, x.budget, x.damping, x.inertia].map(f64::to_bits);
        assert_eq!(bits(geared([0.0, 0.0])), bits(PLAIN));
    }

    #[test]
    fn dry_friction_is_a_budget_and_viscous_friction_damps() {
        let x = geared([0.02, 3e-4]);
        assert!((x.budget - 0.033).abs() < 1e-15 && (x.damping - 4e-4).abs() < 1e-15);
        assert_eq!((x.torque, x.inertia), (PLAIN.torque, PLAIN.inertia));
    }

    #[test]
    fn it_takes_power_both_ways() {
        for k in -10..=10 {
            let speed = f64::from(k);
            let power = taken(0.02, 3e-4, speed.sign(), speed) * speed;
            assert!((power - (0.02 * speed.abs() + 3e-4 * speed * speed)).abs() < 1e-15 && power >= 0.0);
        }
    }

    #[test]
    fn what_undoes_it_is_what_the_gear_takes_and_nothing_at_rest() {
        let friction = WheelFriction { torque: 0.02, damping: 3e-4 };
        for (speed, expected) in [(0.65, 0.026), (-0.65, -0.026), (0.0, 0.0)] {
            let motion = RimMotion { coulomb_share: 0.0, speed, wheel_speed: speed / 0.0325 };
            let mut torque = 0.0;
            friction.undo_shaft(&motion, &mut torque);
            assert!((torque - expected).abs() < 1e-15, "{speed} m/s: {torque}");
        }
    }
}
