//! # Motor mismatch: one motor is not like the others
//!
//! ```text
//! K_v → k·K_v        K_t → k·K_t        R → ρ·R
//! ```
//!
//! The model has one motor for all wheels. A motor with weakened magnets or a shorted turn has smaller constants, and
//! because back-EMF and torque are two faces of the same flux, both shrink by the same factor k. A worn brush, a bad
//! plug or a long cable adds to the resistance.
//!
//! symbol  code                     unit  meaning
//! ------  -----------------------  ----  ------------------------------------------------------
//! k       `torque_constant_ratio`  1     this motor's constants K_v and K_t over those of the model
//! ρ       `resistance_ratio`       1     this motor's resistance over that of the model
//!
//! Both are fitted. One of them may stay at 1.
//!
//! Fails when: one phase is broken: the torque then depends on the angle.
//! How to measure it: lift the robot and give all wheels the same voltage: the odd wheel runs at another speed (k);
//! lock the wheels: it draws another current (ρ).
//! Source: Equations of the DC motor (the paper's 21 and 22); sizes: estimated, constants −5 to −30 %, resistance +5 to
//! +50 %.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{EffectContext, Winding};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "motor_mismatch",
    title: "Mismatch of one motor",
    summary: "One motor is weaker or stronger than the others, or its winding has another resistance.",
    equation: "K_v → k·K_v,  K_t → k·K_t,  R → ρ·R",
    source: "equations of the DC motor (the paper's 21 and 22); sizes: estimated, constants −5 to −30 %, resistance +5 to +50 %",
    seams: &[Seam::Winding],
    scope: Scope::OneWheel,
    params: &[
        Param {
            key: "torque_constant_ratio",
            symbol: "k",
            unit: "1",
            absent: 1.0,
            typical: 0.88,
            within: (0.4, 1.6),
            role: Role::Size,
        },
        Param {
            key: "resistance_ratio",
            symbol: "ρ",
            unit: "1",
            absent: 1.0,
            typical: 1.0,
            within: (0.4, 2.5),
            role: Role::Shape,
        },
    ],
    needs_current: false,
    shows: Shows { channels: &[Channel::Current], regime: Regime::Speed, parity: Parity::Odd, order: None },
    signature: "current and torque wrong on one wheel alone: in step with its speed (k) or with its current (ρ)",
    look_alikes: &[
        LookAlike {
            with: "drive_gain",
            settled_by: "measure the voltage across the odd motor: a wrong gain shows there, another motor does not",
        },
        LookAlike {
            with: "wheel_radius_error",
            settled_by: "turn the robot on the spot by hand: a wheel of another radius turns by another angle than the others, an odd motor does not",
        },
        LookAlike {
            with: "current_sensor_gain",
            settled_by: "put an ammeter into a lead of the odd motor while it is held: it agrees with what the robot reads if the motor is the odd one, and not if its sensor is",
        },
    ],
    code: 4,
    undone: Undone::Folded("the odd motor is driven by its own R, K_v and K_t"),
    physics: Physics::PASSIVE,
};

/// The winding of the odd motor.
#[inline]
pub fn odd<T: Real>(torque_constant_ratio: T, resistance_ratio: T, x: Winding<T>) -> Winding<T> {
    Winding {
        // K_v → k·K_v,  K_t → k·K_t
        emf_constant: x.emf_constant * torque_constant_ratio,
        torque_constant: x.torque_constant * torque_constant_ratio,
        // R → ρ·R
        resistance: x.resistance * resistance_ratio,
        ..x
    }
}

/// Mismatch of one motor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorMismatch<T> {
    /// k, this motor's constants over those of the model [1]
    pub torque_constant_ratio: T,
    /// ρ, this motor's resistance over that of the model [1]
    pub resistance_ratio: T,
}

impl<T: Copy> Catalogued<T> for MotorMismatch<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[torque_constant_ratio, resistance_ratio] = params else { return None };
        Some(Self { torque_constant_ratio, resistance_ratio })
    }
}

impl<T: Real> Hooks<T> for MotorMismatch<T> {
    type State = ();

    fn winding(&self, _: &(), _: &EffectContext<T>, x: &mut Winding<T>) {
        let Self { torque_constant_ratio, resistance_ratio } = *self;
        *x = odd(torque_constant_ratio, resistance_ratio, *x);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAIN: Winding<f64> = Winding {
        current: 0.7,
        speed: 13.0,
        resistance: 4.3111,
        inductance: 3e-4,
        emf_constant: 0.1295,
        torque_constant: 0.1297,
        torque: 0.0,
        torque_bend: 0.0,
    };

    fn wound(p: [f64; 2]) -> Winding<f64> {
        let mut x = PLAIN;
        MotorMismatch::of(&p).expect("as many as on the card").winding(&(), &EffectContext::default(), &mut x);
        x
    }

    fn bits(x: &Winding<f64>) -> [u64; 6] {
        [x.current, x.speed, x.resistance, x.inductance, x.emf_constant, x.torque_constant].map(f64::to_bits)
    }

    #[test]
    fn a_motor_like_the_others_is_left_bit_for_bit() {
        assert_eq!(bits(&wound([1.0, 1.0])), bits(&PLAIN));
    }

    #[test]
    fn free_speed_goes_with_one_over_k_and_locked_torque_with_k_over_rho() {
        let odd = wound([0.88, 1.2]);
        // ω₀ = u/K_v
        assert!((PLAIN.emf_constant / odd.emf_constant - 1.0 / 0.88).abs() < 1e-12);
        // τ_s = K_t·u/R
        let locked = |x: &Winding<f64>| x.torque_constant / x.resistance;
        assert!((locked(&odd) / locked(&PLAIN) - 0.88 / 1.2).abs() < 1e-12);
    }

    #[test]
    fn it_turns_no_more_electrical_power_into_mechanical_than_before() {
        // e·i against τ·ω
        let balance =
            |x: &Winding<f64>| (x.torque_constant * x.current) * x.speed / (x.emf_constant * x.speed * x.current);
        assert!((balance(&wound([0.6, 1.4])) - balance(&PLAIN)).abs() < 1e-12);
    }
}
