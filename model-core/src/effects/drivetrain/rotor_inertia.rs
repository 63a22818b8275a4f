//! # Rotor inertia: what turns with the wheels has to be accelerated too
//!
//! ```text
//! J_w = l²·J_rotor + J_wheel
//! M → M + Σ J_w·cos²α_j / r²        J → J + Σ J_w·d_j² / r²
//! ```
//!
//! The paper's model accelerates the body alone. The rotor turns l times faster than the wheel and so counts l² times
//! at the wheel shaft; with a gear it is often more than the wheel itself. Seen from the body it acts like more mass
//! and more moment of inertia, but it takes no weight and no centrifugal force.
//!
//! symbol   code                unit    meaning
//! -------  ------------------  ------  ---------------------------------------
//! J_w      `inertia_at_wheel`  kg·m²   inertia of rotor, gear and wheel at the wheel shaft
//! J_rotor  `rotor`             kg·m²   inertia of the rotor
//! J_wheel  `wheel`             kg·m²   inertia of the wheel
//! l        `gear_ratio`        1       motor speed over wheel speed
//!
//! On a shaft that yields it is the rotor's alone, which then moves on its own.
//!
//! Fails when: the gear is elastic or has play, and the model says that it is rigid.
//! How to measure it: lift the robot, step the voltage and time the run-up of the wheels.
//! Source: Kinetic energy of the turning parts; sizes: rotors of small brushless motors times the gear ratio squared,
//! 3e-5 to 2e-4 kg·m².

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{EffectContext, Shaft};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "rotor_inertia",
    title: "Inertia of rotors and wheels",
    summary: "Rotors and wheels have to be accelerated along with the body.",
    equation: "J_w = l²·J_rotor + J_wheel",
    source: "kinetic energy of the turning parts; sizes: rotors of small brushless motors times the gear ratio squared, 3e-5 to 2e-4 kg·m²",
    seams: &[Seam::Shaft],
    scope: Scope::Wheels,
    params: &[Param {
        key: "inertia_at_wheel_kg_m2",
        symbol: "J_w",
        unit: "kg·m²",
        absent: 0.0,
        typical: 7.5e-5,
        within: (0.0, 5e-3),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows {
        channels: &[Channel::YawRate, Channel::WheelSpeed],
        regime: Regime::Acceleration,
        parity: Parity::Odd,
        order: None,
    },
    signature: "torque missing in step with the wheels' acceleration, on all axes at once",
    look_alikes: &[
        LookAlike {
            with: "mass",
            settled_by: "lift the wheels off the floor and step the voltage: their run-up shows the rotors without the mass",
        },
        LookAlike {
            with: "inertia",
            settled_by: "lift the wheels off the floor and step the voltage: their run-up shows the rotors without the body",
        },
        LookAlike {
            with: "shaft_elasticity",
            settled_by: "clamp a wheel and step its current: a rotor on a spring swings, one on a rigid shaft stands",
        },
    ],
    code: 7,
    undone: Undone::Folded("what turns with the wheels is added to M and J: Σ J_w/r²·G_jᵀG_j"),
    physics: Physics { inertia: Some(0), ..Physics::PASSIVE },
};

/// Inertia of rotor and wheel at the wheel shaft [kg·m²].
#[inline]
pub fn at_wheel<T: Real>(gear_ratio: T, rotor: T, wheel: T) -> T {
    // J_w = l²·J_rotor + J_wheel
    gear_ratio * gear_ratio * rotor + wheel
}

/// Inertia of rotors and wheels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotorInertia<T> {
    /// J_w, of rotor, gear and wheel at the wheel shaft [kg·m²]
    pub inertia_at_wheel: T,
}

impl<T: Copy> Catalogued<T> for RotorInertia<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[inertia_at_wheel] = params else { return None };
        Some(Self { inertia_at_wheel })
    }
}

impl<T: Real> Hooks<T> for RotorInertia<T> {
    type State = ();

    fn shaft(&self, _: &(), _: &EffectContext<T>, x: &mut Shaft<T>) {
        let Self { inertia_at_wheel } = *self;
        x.inertia += inertia_at_wheel;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turning(inertia: f64) -> Shaft<f64> {
        let mut x = Shaft { inertia: 2e-5, ..Shaft::default() };
        RotorInertia { inertia_at_wheel: inertia }.shaft(&(), &EffectContext::default(), &mut x);
        x
    }

    #[test]
    fn without_inertia_the_shaft_is_left_bit_for_bit() {
        assert_eq!(turning(0.0).inertia.to_bits(), 2e-5_f64.to_bits());
    }

    #[test]
    fn the_energy_at_the_wheel_shaft_is_that_of_the_parts() {
        let (ratio, rotor, wheel, speed) = (5.0, 2.2e-6, 2.0e-5, 30.0);
        let parts = 0.5 * rotor * (ratio * speed) * (ratio * speed) + 0.5 * wheel * speed * speed;
        assert!((0.5 * at_wheel(ratio, rotor, wheel) * speed * speed - parts).abs() < 1e-15);
    }

    #[test]
    fn it_takes_the_energy_of_the_added_inertia_at_every_speed() {
        for k in -10..=10 {
            let speed = f64::from(k);
            let energy = |x: &Shaft<f64>| 0.5 * x.inertia * speed * speed;
            let added = energy(&turning(7.5e-5)) - energy(&turning(0.0));
            assert!(added >= 0.0 && (added - 0.5 * 7.5e-5 * speed * speed).abs() < 1e-15);
        }
    }

    #[test]
    fn four_typical_rotors_weigh_some_percent_of_a_small_robot() {
        // wheels at a right angle: Σ cos²α = 2
        let added = 2.0 * CARD.params[0].typical / (0.0325 * 0.0325);
        assert!((0.03..0.15).contains(&(added / 2.34)));
    }
}
