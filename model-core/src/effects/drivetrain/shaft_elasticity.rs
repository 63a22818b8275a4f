//! # Elastic shaft: the wheel follows its motor through a spring
//!
//! ```text
//! J·dω_r/dt = τ_m − τ_s        τ_s = (φ + T·dφ/dt)/κ,  dφ/dt = ω_r − ω_w
//! ```
//!
//! Plastic gears, toothed belts, long shafts and glued hubs twist under torque. Then the rotor runs ahead of the wheel and
//! swings against it: every step of the voltage makes the wheel ring, and a speed that is measured at the motor is not that
//! of the wheel. Rotor and body are two masses on a spring, with the resonance √((1/J + 1/J_load)/κ).
//!
//! symbol  code            unit         meaning
//! ------  --------------  -----------  ---------------------------------------------------------------
//! κ       `compliance`    rad/(N·m)    twist over torque, counted at the wheel shaft
//! T       `damping_time`  s            damping over stiffness: loss of the material
//! J       `rotor_inertia` kg·m²        inertia that turns with the rotor, at the wheel shaft
//! φ       `shaft_twist`   rad          by how much the rotor is ahead of the wheel
//!
//! J is that of `rotor_inertia` where the model has it; `rotor_inertia_kg_m2` here holds only where it has not. So this
//! effect alone lets the rotors weigh something too: a shaft that hardly gives way is a rigid one with their inertia, and
//! not the plain model, which knows none.
//!
//! Fails when: the spring hardens with the torque, as belts do, or there is play: that is `backlash`, which joins in series.
//! How to measure it: clamp the wheel, put a known current on the motor and read the angle at the rotor; or strike the
//! clamped wheel's rotor with a step of current and read the frequency.
//! Source: Two masses and a spring: Spong, Modeling and control of elastic joint robots, Journal of Dynamic Systems,
//! Measurement, and Control 109, 1987; sizes: estimated for small plastic gears and belts, 5 to 100 N·m/rad, with a
//! damping ratio of some per cent.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{EffectContext, Shaft};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::springs::{self, Spring};
use crate::effects::{Catalogued, Hooks, Needs};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "shaft_elasticity",
    title: "Elastic shaft",
    summary: "Gear or shaft twists under torque, so that the rotor swings against the wheel.",
    equation: "J·dω_r/dt = τ_m − τ_s,  τ_s = (φ + T·dφ/dt)/κ,  dφ/dt = ω_r − ω_w",
    source: "two masses and a spring: Spong, Modeling and control of elastic joint robots, Journal of Dynamic Systems, Measurement, and Control 109, 1987; sizes: estimated for small plastic gears and belts, 5 to 100 N·m/rad, with a damping ratio of some per cent",
    seams: &[Seam::Shaft],
    scope: Scope::Wheels,
    params: &[
        Param {
            key: "compliance_rad_per_Nm",
            symbol: "κ",
            unit: "rad/(N·m)",
            absent: 0.0,
            typical: 0.05,
            within: (0.0, 1.0),
            role: Role::Size,
        },
        springs::DAMPING_TIME,
        springs::ROTOR_INERTIA,
    ],
    needs_current: false,
    shows: Shows {
        channels: &[Channel::Current, Channel::YawRate],
        regime: Regime::CommandChange,
        parity: Parity::Odd,
        order: None,
    },
    signature: "currents and speeds ring for some hundredths of a second after every step of the voltage",
    look_alikes: &[
        LookAlike {
            with: "backlash",
            settled_by: "hold a wheel and turn its rotor lightly to and fro: play gives way without any torque, a spring never does",
        },
        LookAlike {
            with: "rotor_inertia",
            settled_by: "clamp a wheel and step its current: a rotor on a spring swings, one on a rigid shaft stands",
        },
    ],
    code: 39,
    undone: Undone::No("the robot measures either the rotor or the wheel, and its turn is too slow for the ringing"),
    physics: Physics {
        // spring and rotor keep energy and give it back
        passive: false,
        corner_at_absent: true,
        ..Physics::PASSIVE
    },
};

/// Elastic shaft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShaftElasticity<T> {
    /// κ, twist over torque, at the wheel shaft; 0 is rigid [rad/(N·m)]
    pub compliance: T,
    /// T, damping over stiffness [s]
    pub damping_time: T,
    /// J, inertia of the rotor at the wheel shaft, where nothing else says it [kg·m²]
    pub rotor_inertia: T,
}

impl<T: Copy> Catalogued<T> for ShaftElasticity<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[compliance, damping_time, rotor_inertia] = params else { return None };
        Some(Self { compliance, damping_time, rotor_inertia })
    }
}

impl<T: Real> Hooks<T> for ShaftElasticity<T> {
    type State = ();
    /// A rotor swings within some ten milliseconds.
    const NEEDS: Needs = Needs { steps_per_s: 1000, ..Needs::NOTHING };

    fn shaft(&self, _: &(), _: &EffectContext<T>, x: &mut Shaft<T>) {
        let Self { compliance, damping_time, rotor_inertia: rotor } = *self;
        if compliance > T::zero() {
            Spring { compliance, damping_time, rotor }.join(x);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shaft(compliance: f64, mut x: Shaft<f64>) -> Shaft<f64> {
        let effect = ShaftElasticity { compliance, damping_time: 2e-4, rotor_inertia: 6e-5 };
        effect.shaft(&(), &EffectContext::default(), &mut x);
        x
    }

    #[test]
    fn a_rigid_shaft_is_left_bit_for_bit() {
        let bits = |x: Shaft<f64>| [x.inertia, x.stiffness, x.damping, x.play, x.rotor].map(f64::to_bits);
        for plain in [Shaft::default(), Shaft { inertia: 2e-5, ..Shaft::default() }, shaft(0.03, Shaft::default())] {
            assert_eq!(bits(shaft(0.0, plain)), bits(plain));
        }
    }

    #[test]
    fn a_torque_twists_it_by_the_compliance() {
        let x = shaft(0.05, Shaft::default());
        assert!((0.3 / x.stiffness - 0.05 * 0.3).abs() < 1e-16);
        assert_eq!((x.inertia, x.play), (0.0, 0.0));
    }

    #[test]
    fn the_typical_shaft_rings_at_some_hundred_hertz_and_is_damped_by_some_per_cent() {
        let [compliance, time, inertia] = [0, 1, 2].map(|k| CARD.params[k].typical);
        // wheel clamped: ω = 1/√(κ·J), ζ = ½·ω·T
        let rate = 1.0 / libm::sqrt(compliance * inertia);
        let hertz = rate / core::f64::consts::TAU;
        assert!((50.0..300.0).contains(&hertz), "{hertz} Hz");
        assert!((0.01..0.1).contains(&(0.5 * rate * time)), "{}", 0.5 * rate * time);
    }

    #[test]
    fn it_damps_and_never_drives() {
        for compliance in [1e-4, 0.05, 1.0] {
            let x = shaft(compliance, Shaft::default());
            assert!(x.stiffness > 0.0 && x.damping >= 0.0);
        }
    }
}
