//! # Current sensor gain: the current is read too large by a constant share
//!
//! ```text
//! i_read = (1 + g)·i
//! ```
//!
//! The current is the voltage over a shunt, or over a transistor that is switched on, and both have a tolerance. The
//! reading is then wrong in proportion, and what the motor does is right. On all wheels alike no recording of this robot
//! can tell it from motors with another resistance and another torque constant, R/(1 + g) and K_t/(1 + g): they draw the
//! current that is read and do the same. On one wheel alone the others show it.
//!
//! symbol  code          unit  meaning
//! ------  ------------  ----  ----------------------------------
//! g       `gain_error`  1     share by which a current is read too large
//!
//! Fails when: the gain drifts with the temperature, as that of a transistor's own resistance does by 0.4 %/K.
//! How to measure it: put an ammeter into a lead of a motor that is held, and compare.
//! Source: Gain error of a shunt and its amplifier; sizes: tolerances of data sheets, 1 to 5 % for shunts, 10 to 30 % for
//! the resistance of a transistor.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{EffectContext, Sense};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::undoing::Place;
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "current_sensor_gain",
    title: "Gain of the current sensor",
    summary: "The current sensor reads currents too large or too small by a constant share.",
    equation: "i_read = (1 + g)·i",
    source: "gain error of a shunt and its amplifier; sizes: tolerances of data sheets, 1 to 5 % for shunts, 10 to 30 % for the resistance of a transistor",
    seams: &[Seam::Sense],
    scope: Scope::Wheels,
    params: &[Param {
        key: "gain_error",
        symbol: "g",
        unit: "1",
        absent: 0.0,
        typical: 0.05,
        within: (-0.4, 0.4),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows { channels: &[Channel::Current], regime: Regime::Current, parity: Parity::Odd, order: None },
    signature: "current wrong by one share at every speed and load",
    look_alikes: &[
        LookAlike {
            with: "resistance",
            settled_by: "put an ammeter into a lead of a motor that is held, and compare it with what the robot reads",
        },
        LookAlike {
            with: "kt_over_kv",
            settled_by: "put an ammeter into a lead of a motor that is held, and compare it with what the robot reads",
        },
        LookAlike {
            with: "motor_mismatch",
            settled_by: "put an ammeter into a lead of the odd motor while it is held: it agrees with what the robot reads if the motor is the odd one, and not if its sensor is",
        },
    ],
    code: 47,
    undone: Undone::By("the current wanted is asked for as its sensor will show it"),
    physics: Physics::PASSIVE,
};

/// Reading of the current [A].
#[inline]
pub fn reading<T: Real>(gain_error: T, current: T) -> T {
    // i_read = (1 + g)·i
    (T::one() + gain_error) * current
}

/// Gain of the current sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurrentSensorGain<T> {
    /// g, share by which a current is read too large [1]
    pub gain_error: T,
}

impl<T: Copy> Catalogued<T> for CurrentSensorGain<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[gain_error] = params else { return None };
        Some(Self { gain_error })
    }
}

impl<T: Real> Hooks<T> for CurrentSensorGain<T> {
    type State = ();
    const UNDONE_AT: Option<Place> = Some(Place::Reading);

    fn sense(&self, _: &(), _: &EffectContext<T>, x: &mut Sense<T>) {
        x.current = reading(self.gain_error, x.current);
    }

    fn invert_sensing(&self, _: &EffectContext<T>, x: &mut Sense<T>) {
        x.current = x.current / (T::one() + self.gain_error);
    }

    fn undo_reading(&self, current: &mut T) {
        *current = reading(self.gain_error, *current);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sensed(gain_error: f64, current: f64) -> Sense<f64> {
        let mut x = Sense { current, wheel_speed: 3.0, ..Sense::default() };
        CurrentSensorGain { gain_error }.sense(&(), &EffectContext::default(), &mut x);
        x
    }

    #[test]
    fn without_gain_error_the_reading_is_the_truth_bit_for_bit() {
        for current in [0.0, -0.0, 0.7, -1.3] {
            let mut x = sensed(0.0, current);
            assert_eq!(x.current.to_bits(), current.to_bits());
            CurrentSensorGain { gain_error: 0.0 }.invert_sensing(&EffectContext::default(), &mut x);
            assert_eq!(x.current.to_bits(), current.to_bits());
        }
    }

    #[test]
    fn at_zero_current_the_reading_is_right_and_both_ways_wrong_by_the_same_share() {
        for g in [0.05, -0.4] {
            assert_eq!(sensed(g, 0.0).current, 0.0);
            for current in [2.0, -2.0, 0.01] {
                let x = sensed(g, current);
                assert!((x.current / current - 1.0 - g).abs() < 1e-15);
                assert_eq!(x.wheel_speed, 3.0);
            }
        }
    }

    #[test]
    fn reading_backwards_gives_the_truth_and_what_is_asked_for_is_what_is_read() {
        let mut x = sensed(0.05, 0.7);
        CurrentSensorGain { gain_error: 0.05 }.invert_sensing(&EffectContext::default(), &mut x);
        assert!((x.current - 0.7).abs() < 1e-15);
        let mut asked = 0.7;
        CurrentSensorGain { gain_error: 0.05 }.undo_reading(&mut asked);
        assert_eq!(asked, sensed(0.05, 0.7).current);
    }
}
