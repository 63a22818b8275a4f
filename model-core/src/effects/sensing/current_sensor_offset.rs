//! # Current sensor offset: the zero of the current is off
//!
//! ```text
//! i_read = i + o
//! ```
//!
//! Amplifier and converter have a zero that drifts with temperature and is rarely trimmed. The reading then carries a
//! constant that the motor never sees: speed and pose are as they should be.
//!
//! symbol  code      unit  meaning
//! ------  --------  ----  --------------------------
//! o       `offset`  A     reading at zero current
//!
//! Fails when: the sensor reads the amount of the current: then the offset turns with the current's sign.
//! How to measure it: read the current with the bridge off.
//! Source: Zero error of a shunt amplifier; sizes: input offset of data sheets over the shunt, 10 to 100 mA.

use crate::effects::card::{Card, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{EffectContext, Sense};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::undoing::Place;
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "current_sensor_offset",
    title: "Offset of the current sensor",
    summary: "The current sensor does not read zero at zero current.",
    equation: "i_read = i + o",
    source: "zero error of a shunt amplifier; sizes: input offset of data sheets over the shunt, 10 to 100 mA",
    seams: &[Seam::Sense],
    scope: Scope::Wheels,
    params: &[Param {
        key: "offset_A",
        symbol: "o",
        unit: "A",
        absent: 0.0,
        typical: 0.05,
        within: (-3.0, 3.0),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows { channels: &[Channel::Current], regime: Regime::Always, parity: Parity::Even, order: None },
    signature: "a constant in the current",
    look_alikes: &[],
    code: 13,
    undone: Undone::By("the current wanted is asked for as its sensor will show it"),
    physics: Physics {
        // a current that changes its sign is read with the other offset
        mirrored: &[0],
        ..Physics::PASSIVE
    },
};

/// Reading of the current [A].
#[inline]
pub fn reading<T: Real>(offset: T, current: T) -> T {
    // i_read = i + o, written so that no offset keeps even the sign of a zero
    current - (T::zero() - offset)
}

/// Offset of the current sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurrentSensorOffset<T> {
    /// o, reading at zero current [A]
    pub offset: T,
}

impl<T: Copy> Catalogued<T> for CurrentSensorOffset<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[offset] = params else { return None };
        Some(Self { offset })
    }
}

impl<T: Real> Hooks<T> for CurrentSensorOffset<T> {
    type State = ();
    const UNDONE_AT: Option<Place> = Some(Place::Reading);

    fn sense(&self, _: &(), _: &EffectContext<T>, x: &mut Sense<T>) {
        let Self { offset } = *self;
        x.current = reading(offset, x.current);
    }

    fn invert_sensing(&self, _: &EffectContext<T>, x: &mut Sense<T>) {
        let Self { offset } = *self;
        x.current -= offset;
    }

    fn undo_reading(&self, current: &mut T) {
        *current = reading(self.offset, *current);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sensed(offset: f64, current: f64) -> Sense<f64> {
        let mut x = Sense { current, wheel_speed: 3.0, ..Sense::default() };
        CurrentSensorOffset { offset }.sense(&(), &EffectContext::default(), &mut x);
        x
    }

    #[test]
    fn without_offset_the_reading_is_the_truth_bit_for_bit() {
        for current in [0.0, -0.0, 0.7, -1.3] {
            let mut x = sensed(0.0, current);
            assert_eq!(x.current.to_bits(), current.to_bits());
            CurrentSensorOffset { offset: 0.0 }.invert_sensing(&EffectContext::default(), &mut x);
            assert_eq!(x.current.to_bits(), current.to_bits());
        }
    }

    #[test]
    fn at_zero_current_the_reading_is_the_offset() {
        assert_eq!(sensed(0.05, 0.0).current, 0.05);
        assert_eq!(sensed(-0.05, 0.0).current, -0.05);
        assert_eq!(sensed(0.05, 0.0).wheel_speed, 3.0);
    }

    #[test]
    fn reading_backwards_gives_the_truth() {
        let mut x = sensed(0.05, 0.7);
        CurrentSensorOffset { offset: 0.05 }.invert_sensing(&EffectContext::default(), &mut x);
        assert!((x.current - 0.7).abs() < 1e-15);
    }

    #[test]
    fn the_mean_over_both_directions_is_the_offset() {
        assert!((0.5 * (sensed(0.05, 0.7).current + sensed(0.05, -0.7).current) - 0.05).abs() < 1e-15);
    }
}
