//! # Asymmetric friction: one wheel turns harder one way than the other
//!
//! ```text
//! τ_f = ½·c + ½·|c|·sign(ω)
//! ```
//!
//! Teeth, seals and brushes that have run in one way rub more the other way. The friction that comes on top is |c| where
//! the wheel turns in the direction of the sign of c, and none the other way. A wheel that is held takes whatever is
//! between: no sign of a speed has to be known, and a wheel that stands yields at once to the side that is free and only
//! beyond |c| to the other. So it is dry friction of ½·|c| that lies about ½·c, which takes power or none.
//!
//! symbol  code      unit   meaning
//! ------  --------  -----  ------------------------------------------------------------------
//! c       `torque`  N·m    friction forwards less friction backwards, at the wheel shaft
//! ω       `speed`   rad/s  speed of the wheel shaft, forwards where it drives the body along α
//!
//! Friction that is the same both ways is not this effect: it is that of the wheel or of the body.
//!
//! Fails when: the difference depends on the load, as of helical teeth that press a shaft against its end.
//! How to measure it: lift the robot, raise the voltage of the wheel slowly until it turns, once each way: c is the
//! difference of the two torques.
//! Source: Friction that differs by direction: Armstrong-Hélouvry, Dupont, Canudas de Wit, A survey of models, analysis
//! tools and compensation methods for the control of machines with friction, Automatica 30, 1994; sizes: estimated, a
//! third of the dry friction of a small gear, 0.005 to 0.05 N·m.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{EffectContext, Gear};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::undoing::{Place, RimMotion, way};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "asymmetric_friction",
    title: "Asymmetric friction of one wheel",
    summary: "One wheel turns harder one way than the other.",
    equation: "τ_f = ½·c + ½·|c|·sign(ω)",
    source: "friction that differs by direction: Armstrong-Hélouvry, Dupont, Canudas de Wit, A survey of models, analysis tools and compensation methods for the control of machines with friction, Automatica 30, 1994; sizes: estimated, a third of the dry friction of a small gear, 0.005 to 0.05 N·m",
    seams: &[Seam::Gear],
    scope: Scope::OneWheel,
    params: &[Param {
        key: "torque_Nm",
        symbol: "c",
        unit: "N·m",
        absent: 0.0,
        typical: 0.02,
        within: (-2.0, 2.0),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows {
        channels: &[Channel::YawRate, Channel::WheelSpeed],
        regime: Regime::Motion,
        parity: Parity::Neither,
        order: None,
    },
    signature: "torque short on one wheel alone and while it turns one way",
    look_alikes: &[LookAlike {
        with: "wheel_friction",
        settled_by: "lift the robot and raise the wheel's voltage slowly until it turns, once each way: the two differ if friction is asymmetric",
    }],
    code: 16,
    undone: Undone::By("the torque that is short one way is added while the wheel of the reference turns that way"),
    physics: Physics { mirrored: &[0], ..Physics::DRY_AT_WHEELS },
};

/// What lies between friction backwards and forwards: half of their sum, and half of their difference, which it lies
/// about [N·m, N·m].
#[inline]
pub fn budget_and_bias<T: Real>(torque: T) -> (T, T) {
    let half = T::lit(0.5) * torque;
    // ½·|c|, ½·c
    (half.abs(), half)
}

/// Torque that friction takes from a wheel whose speed has this sign [N·m].
#[inline]
pub fn taken<T: Real>(torque: T, way: T) -> T {
    let (budget, bias) = budget_and_bias(torque);
    // τ_f = ½·c + ½·|c|·sign(ω); a wheel that is between the two ways is given as much of it
    bias * way.abs() + budget * way
}

/// Asymmetric friction of one wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AsymmetricFriction<T> {
    /// c, friction forwards less friction backwards, at the wheel shaft [N·m]
    pub torque: T,
}

impl<T: Copy> Catalogued<T> for AsymmetricFriction<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[torque] = params else { return None };
        Some(Self { torque })
    }
}

impl<T: Real> Hooks<T> for AsymmetricFriction<T> {
    type State = ();
    const UNDONE_AT: Option<Place> = Some(Place::Shaft);

    fn gear(&self, _: &(), _: &EffectContext<T>, x: &mut Gear<T>) {
        let (budget, bias) = budget_and_bias(self.torque);
        x.budget += budget;
        x.bias += bias;
    }

    fn undo_shaft(&self, motion: &RimMotion<T>, torque: &mut T) {
        *torque += taken(self.torque, way(motion.speed));
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
        bias: 0.004,
        damping: 1e-4,
        inertia: 2e-5,
    };

    fn geared(torque: f64, mut x: Gear<f64>) -> Gear<f64> {
        AsymmetricFriction { torque }.gear(&(), &EffectContext::default(), &mut x);
        x
    }

    #[test]
    fn without_a_difference_the_gear_is_left_bit_for_bit() {
        let bits = |x: Gear<f64>| [x.torque, x.budget, x.bias, x.damping, x.inertia].map(f64::to_bits);
        for plain in [PLAIN, Gear { budget: 0.0, bias: 0.0, ..PLAIN }] {
            assert_eq!(bits(geared(0.0, plain)), bits(plain));
        }
    }

    #[test]
    fn the_whole_difference_one_way_and_nothing_the_other() {
        for c in [0.02, -0.02] {
            // half and half meet again without rounding
            assert_eq!(taken(c, c.sign()), c);
            assert_eq!(taken(c, -c.sign()), 0.0);
            assert_eq!(taken(c, 0.0), 0.0);
        }
    }

    #[test]
    fn the_least_and_the_most_that_a_held_wheel_takes_are_what_turning_wheels_take() {
        for c in [0.02, -0.02] {
            let x = geared(c, Gear::default());
            assert_eq!((x.bias - x.budget, x.bias + x.budget), (taken(c, -1.0), taken(c, 1.0)));
        }
    }

    #[test]
    fn it_takes_power_or_none_and_a_mirror_turns_it_round() {
        for k in -10..=10 {
            let (speed, c) = (f64::from(k), 0.02);
            assert!(taken(c, speed.sign()) * speed >= 0.0 && taken(-c, speed.sign()) * speed >= 0.0);
            assert_eq!(taken(-c, -speed.sign()), -taken(c, speed.sign()));
        }
    }
}
