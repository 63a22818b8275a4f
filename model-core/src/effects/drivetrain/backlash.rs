//! # Backlash: between two flanks the teeth do not touch
//!
//! ```text
//! J·dω_r/dt = τ_m − τ_s        τ_s = k·(δ + T·dδ/dt),  δ = φ beyond ±½·b
//! ```
//!
//! Teeth have room between them, so that they turn without jamming. Whenever the torque turns round, the rotor crosses that
//! room with nothing to hold it, gains speed, and meets the other flank with a blow. For that time the wheel is free of its
//! motor: it coasts, and an encoder at the motor counts an angle that no wheel has turned.
//!
//! symbol  code            unit     meaning
//! ------  --------------  -------  ------------------------------------------------------------
//! b       `play`          rad      room from one flank to the other, counted at the wheel shaft
//! k       `stiffness`     N·m/rad  stiffness of teeth that touch, at the wheel shaft
//! T       `damping_time`  s        damping over stiffness of teeth that touch
//! J       `rotor_inertia` kg·m²    inertia that turns with the rotor, at the wheel shaft
//! φ       `shaft_twist`   rad      by how much the rotor is ahead of the wheel
//!
//! A run begins with the rotor in the middle of the play. Teeth push and never pull: where the damping would hold two flanks
//! together that part, the torque is zero. J is that of `rotor_inertia` where the model has it, else what stands here. A
//! shaft that is elastic too (`shaft_elasticity`) joins in series: twists add, and the softer of the two rules.
//!
//! Which flank the teeth touch at depends on all that was before: after many reversals two runs that differ by nearly
//! nothing may part. A fit has to see the first reversals.
//!
//! Fails when: friction between rotor and teeth holds the rotor within the play; then it is a dead zone of the angle.
//! How to measure it: hold the wheel, turn the rotor to and fro with two fingers and read its angle, over the gear ratio.
//! Source: Dead zone with a spring and a damper that never pulls: Nordin, Galic', Gutman, New models for backlash and gear
//! play, International Journal of Adaptive Control and Signal Processing 11, 1997; sizes: estimated for small spur and
//! planetary gears, 0.5 to 2°, with steel teeth of some 100 N·m/rad.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{EffectContext, Shaft};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::springs::{self, Spring};
use crate::effects::{Catalogued, Hooks, Needs};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "backlash",
    title: "Play of the gear",
    summary: "The teeth of the gear have room between them, which the rotor crosses whenever the torque turns round.",
    equation: "J·dω_r/dt = τ_m − τ_s,  τ_s = k·(δ + T·dδ/dt),  δ = φ beyond ±½·b",
    source: "dead zone with a spring and a damper that never pulls: Nordin, Galic', Gutman, New models for backlash and gear play, International Journal of Adaptive Control and Signal Processing 11, 1997; sizes: estimated for small spur and planetary gears, 0.5 to 2°, with steel teeth of some 100 N·m/rad",
    seams: &[Seam::Shaft],
    scope: Scope::Wheels,
    params: &[
        Param {
            key: "play_rad",
            symbol: "b",
            unit: "rad",
            absent: 0.0,
            typical: 0.015,
            within: (0.0, 0.2),
            role: Role::Size,
        },
        Param {
            key: "stiffness_Nm_per_rad",
            symbol: "k",
            unit: "N·m/rad",
            absent: 200.0,
            typical: 200.0,
            within: (10.0, 20_000.0),
            role: Role::Fixed,
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
    signature: "whenever the torque turns round the current drops for a moment and then jumps, and the wheel follows late",
    look_alikes: &[
        LookAlike {
            with: "shaft_elasticity",
            settled_by: "hold a wheel and turn its rotor lightly to and fro: play gives way without any torque, a spring never does",
        },
        LookAlike {
            with: "presliding",
            settled_by: "push the standing robot lightly to and fro: play gives way without any force, presliding never does",
        },
    ],
    code: 38,
    undone: Undone::No("the robot does not see at which flank the teeth touch"),
    physics: Physics {
        // the rotor keeps energy and gives it back
        passive: false,
        corner_at_absent: true,
        ..Physics::PASSIVE
    },
};

/// Play of the gear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Backlash<T> {
    /// b, room from one flank to the other, at the wheel shaft; 0 is rigid [rad]
    pub play: T,
    /// k, stiffness of teeth that touch, at the wheel shaft [N·m/rad]
    pub stiffness: T,
    /// T, damping over stiffness of teeth that touch [s]
    pub damping_time: T,
    /// J, inertia of the rotor at the wheel shaft, where nothing else says it [kg·m²]
    pub rotor_inertia: T,
}

impl<T: Copy> Catalogued<T> for Backlash<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[play, stiffness, damping_time, rotor_inertia] = params else { return None };
        Some(Self { play, stiffness, damping_time, rotor_inertia })
    }
}

impl<T: Real> Hooks<T> for Backlash<T> {
    type State = ();
    /// A rotor crosses its play within a few milliseconds.
    const NEEDS: Needs = Needs { steps_per_s: 1000, ..Needs::NOTHING };

    fn shaft(&self, _: &(), _: &EffectContext<T>, x: &mut Shaft<T>) {
        let Self { play, stiffness, damping_time, rotor_inertia: rotor } = *self;
        if play > T::zero() {
            Spring { compliance: T::one() / stiffness, damping_time, rotor }.join(x);
            x.play += play;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::drivetrain::shaft_elasticity::ShaftElasticity;

    fn shaft(play: f64, mut x: Shaft<f64>) -> Shaft<f64> {
        let effect = Backlash { play, stiffness: 200.0, damping_time: 2e-4, rotor_inertia: 6e-5 };
        effect.shaft(&(), &EffectContext::default(), &mut x);
        x
    }

    #[test]
    fn teeth_without_play_leave_the_shaft_bit_for_bit() {
        let bits = |x: Shaft<f64>| [x.inertia, x.stiffness, x.damping, x.play, x.rotor].map(f64::to_bits);
        for plain in [Shaft::default(), Shaft { inertia: 2e-5, ..Shaft::default() }, shaft(0.01, Shaft::default())] {
            assert_eq!(bits(shaft(0.0, plain)), bits(plain));
        }
    }

    #[test]
    fn play_is_room_and_teeth_that_touch_are_a_spring() {
        let x = shaft(0.015, Shaft::default());
        assert_eq!((x.play, x.inertia, x.rotor), (0.015, 0.0, 6e-5));
        assert!((x.stiffness - 200.0).abs() < 1e-12 && (x.damping - 0.04).abs() < 1e-15);
        assert_eq!(shaft(0.01, x).play, 0.025, "two gears one behind the other");
    }

    #[test]
    fn teeth_and_an_elastic_shaft_join_in_any_order() {
        let elastic = ShaftElasticity { compliance: 0.05, damping_time: 2e-4, rotor_inertia: 8e-5 };
        let at = EffectContext::default();
        let mut first = Shaft::default();
        elastic.shaft(&(), &at, &mut first);
        let first = shaft(0.015, first);
        let mut last = shaft(0.015, Shaft::default());
        elastic.shaft(&(), &at, &mut last);
        assert!((first.stiffness - last.stiffness).abs() < 1e-12 && (first.stiffness - 1.0 / 0.055).abs() < 1e-12);
        assert!((first.damping - last.damping).abs() < 1e-15);
        assert_eq!((first.play, first.rotor), (last.play, last.rotor));
    }
}
