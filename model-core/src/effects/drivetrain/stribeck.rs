//! # Stribeck friction: dry friction is larger near standstill
//!
//! ```text
//! τ_C → τ_C · (1 + e · exp(−(|v| / v_s)^a))        v = r·ω
//! ```
//!
//! At rest the surfaces settle into each other and squeeze the grease out; once they move, a film builds up and
//! friction falls to its kinetic value. So a wheel that starts has to break away, and a slow wheel may stick and slip.
//! The excess is counted on each wheel's share of the body's Coulomb friction and adds to the friction budget.
//!
//! symbol  code               unit  meaning
//! ------  -----------------  ----  ------------------------------------------------
//! e       `static_excess`    1     static over kinetic friction, minus one
//! v_s     `stribeck_speed`   m/s   rim speed at which the excess has fallen to 1/e¹
//! a       `exponent`         1     how sharply it falls
//! v       `rim_speed`        m/s   rim speed
//! τ_C     `coulomb_share`    N·m   this wheel's share of the Coulomb friction
//!
//! Fails when: the surfaces move by less than their own bristles: then friction is a spring.
//! How to measure it: raise the voltage slowly until the robot moves, lower it slowly until it stops: the two differ.
//! Source: Bo, Pavelescu, The friction-speed relation and its influence on the critical velocity of stick-slip motion,
//! Wear 82, 1982; sizes: Armstrong-Hélouvry, Dupont, Canudas de Wit, Automatica 30, 1994.

use crate::effects::card::{Card, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{EffectContext, Gear};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::undoing::{Place, RimMotion, way};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "stribeck",
    title: "Stribeck friction",
    summary: "Near standstill dry friction is larger than in motion, so that wheels break away with a jerk.",
    equation: "τ_C → τ_C · (1 + e · exp(−(|v| / v_s)^a))",
    source: "Bo, Pavelescu, The friction-speed relation and its influence on the critical velocity of stick-slip motion, Wear 82, 1982; sizes: Armstrong-Hélouvry, Dupont, Canudas de Wit, Automatica 30, 1994",
    seams: &[Seam::Gear],
    scope: Scope::Wheels,
    params: &[
        Param {
            key: "static_excess",
            symbol: "e",
            unit: "1",
            absent: 0.0,
            typical: 0.5,
            within: (0.0, 3.0),
            role: Role::Size,
        },
        Param {
            key: "stribeck_speed_m_s",
            symbol: "v_s",
            unit: "m/s",
            absent: 0.05,
            typical: 0.05,
            within: (0.005, 0.5),
            role: Role::Shape,
        },
        Param {
            key: "exponent",
            symbol: "a",
            unit: "1",
            absent: 2.0,
            typical: 2.0,
            within: (0.5, 3.0),
            role: Role::Fixed,
        },
    ],
    needs_current: false,
    shows: Shows {
        channels: &[Channel::YawRate, Channel::WheelSpeed],
        regime: Regime::Creeping,
        parity: Parity::Odd,
        order: None,
    },
    signature: "torque short near zero speed, at starts and reversals",
    look_alikes: &[],
    code: 6,
    undone: Undone::By("each wheel's static excess is added, against the rim speed of the reference"),
    physics: Physics::DRY_AT_WHEELS,
};

/// The share of the static excess that is left at a rim speed: 1 at rest, 0 well above the Stribeck speed.
#[inline]
pub fn left<T: Real>(stribeck_speed: T, exponent: T, rim_speed: T) -> T {
    // exp(−(|v| / v_s)^a); the floor keeps the power's derivatives finite at rest
    let ratio = (rim_speed.abs() / stribeck_speed).max(T::lit(1e-12));
    (-ratio.pow(exponent)).exp()
}

/// Stribeck friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stribeck<T> {
    /// e, static over kinetic friction, minus one [1]
    pub static_excess: T,
    /// v_s, rim speed at which the excess has fallen to 1/e¹ [m/s]
    pub stribeck_speed: T,
    /// a, how sharply it falls [1]
    pub exponent: T,
}

impl<T: Copy> Catalogued<T> for Stribeck<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[static_excess, stribeck_speed, exponent] = params else { return None };
        Some(Self { static_excess, stribeck_speed, exponent })
    }
}

impl<T: Real> Hooks<T> for Stribeck<T> {
    type State = ();
    const UNDONE_AT: Option<Place> = Some(Place::Shaft);

    fn gear(&self, _: &(), at: &EffectContext<T>, x: &mut Gear<T>) {
        let Self { static_excess, stribeck_speed, exponent } = *self;
        x.budget += x.coulomb_share * static_excess * left(stribeck_speed, exponent, at.rim_speed);
    }

    fn undo_shaft(&self, motion: &RimMotion<T>, torque: &mut T) {
        let left = left(self.stribeck_speed, self.exponent, motion.speed);
        // τ = e·τ_C·exp(−(|v|/v_s)^a)·sign(v)
        *torque += self.static_excess * motion.coulomb_share * left * way(motion.speed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn budget(p: [f64; 3], rim_speed: f64) -> f64 {
        let at = EffectContext { rim_speed, ..EffectContext::default() };
        let mut x = Gear { coulomb_share: 0.02, budget: 0.02, ..Gear::default() };
        Stribeck::of(&p).expect("as many as on the card").gear(&(), &at, &mut x);
        x.budget
    }

    #[test]
    fn without_excess_the_budget_is_left_bit_for_bit() {
        for rim_speed in [0.0, -0.03, 1.2] {
            assert_eq!(budget([0.0, 0.05, 2.0], rim_speed).to_bits(), 0.02_f64.to_bits());
        }
    }

    #[test]
    fn static_friction_at_rest_kinetic_friction_well_above_the_stribeck_speed() {
        assert!((budget([0.5, 0.05, 2.0], 0.0) - 0.03).abs() < 1e-15);
        assert!((budget([0.5, 0.05, 2.0], 0.5) - 0.02).abs() < 1e-15);
        // whatever the exponent, 1/e of the excess is left at the Stribeck speed
        for exponent in [0.5, 1.0, 2.0, 3.0] {
            assert!((left(0.05, exponent, 0.05) - core::f64::consts::E.recip()).abs() < 1e-12);
        }
    }

    #[test]
    fn it_solves_the_equation_of_a_film_that_builds_up() {
        // a = 1: dφ/dv = −φ/v_s;  a = 2: dφ/dv = −2v/v_s²·φ
        let (v, v_s, h) = (0.03, 0.05, 1e-6);
        for (exponent, rate) in [(1.0, 1.0 / v_s), (2.0, 2.0 * v / (v_s * v_s))] {
            let slope = (left(v_s, exponent, v + h) - left(v_s, exponent, v - h)) / (2.0 * h);
            assert!((slope + rate * left(v_s, exponent, v)).abs() < 1e-6);
        }
    }

    #[test]
    fn it_adds_friction_and_knows_no_direction() {
        for k in 0..100 {
            let v = f64::from(k) * 0.01;
            let b = budget([0.5, 0.05, 1.3], v);
            assert!((0.02..=0.03).contains(&b));
            assert_eq!(b, budget([0.5, 0.05, 1.3], -v));
        }
    }
}
