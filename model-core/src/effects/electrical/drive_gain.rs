//! # Drive gain: one bridge gives more or less than it is told
//!
//! ```text
//! u_eff = u·(1 + g) + o
//! ```
//!
//! A bridge that is set for another supply, a PWM period that is not what the program takes it for, or an analog input
//! with a wrong gain or zero: the mean voltage then follows the command in a straight line that is not the right one. The
//! wheel turns at another speed than its fellows at the same command, and where there is an offset it pulls at rest.
//!
//! symbol  code          unit  meaning
//! ------  ------------  ----  ------------------------------------------------
//! g       `gain_error`  1     voltage given too much, over that commanded
//! o       `offset`      V     voltage given where none is commanded
//!
//! What is scaled is what has arrived of the command, so a delay before the bridge delays no offset. Both are fitted. The
//! offset may stay at 0.
//!
//! A wrong gain alone is, at the motor's terminals, a motor with R/(1 + g) and K_v/(1 + g), but K_t as before: only the
//! torque, or a voltmeter, tells it from a mismatched motor.
//!
//! Neglects: that such a bridge draws another current from the battery than its command says.
//! Fails when: the bridge runs into its supply: it then gives less than the straight line.
//! How to measure it: lift the robot, command a few voltages both ways and measure across the motor: slope and zero.
//! Source: Gain and offset error of a converter: IEEE Std 1658; sizes: estimated, ±2 to ±10 %, and up to 0.2 V.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{Bridge, EffectContext};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::undoing::{BridgeDemand, BridgeRoom, Place};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "drive_gain",
    title: "Gain of one bridge",
    summary: "One wheel's bridge gives a little more or less voltage than it is told, or some where it is told none.",
    equation: "u_eff = u·(1 + g) + o",
    source: "gain and offset error of a converter: IEEE Std 1658; sizes: estimated, ±2 to ±10 %, and up to 0.2 V",
    seams: &[Seam::Bridge],
    scope: Scope::OneWheel,
    params: &[
        Param {
            key: "gain_error",
            symbol: "g",
            unit: "1",
            absent: 0.0,
            typical: -0.05,
            within: (-0.5, 0.5),
            role: Role::Size,
        },
        Param {
            key: "offset_V",
            symbol: "o",
            unit: "V",
            absent: 0.0,
            typical: 0.0,
            within: (-1.0, 1.0),
            role: Role::Shape,
        },
    ],
    needs_current: false,
    shows: Shows { channels: &[Channel::Current], regime: Regime::Voltage, parity: Parity::Odd, order: None },
    signature: "current wrong on one wheel alone, in step with its command (g) or by a constant (o); right where currents are imposed",
    look_alikes: &[LookAlike {
        with: "motor_mismatch",
        settled_by: "measure the voltage across the odd motor: a wrong gain shows there, another motor does not",
    }],
    code: 14,
    undone: Undone::By("the bridge is asked for (u − o)/(1 + g), and so much less voltage is counted on"),
    physics: Physics {
        // an offset drives a motor that is commanded to rest, and pulls the other way in a mirror
        passive: false,
        mirrored: &[1],
        ..Physics::PASSIVE
    },
};

/// Voltage that the bridge gives [V].
#[inline]
pub fn given<T: Real>(gain_error: T, offset: T, voltage: T) -> T {
    // u_eff = u·(1 + g) + o, written so that no offset keeps even the sign of a zero
    voltage * (T::one() + gain_error) - (T::zero() - offset)
}

/// Gain of one bridge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriveGain<T> {
    /// g, voltage given too much, over that commanded [1]
    pub gain_error: T,
    /// o, voltage given where none is commanded [V]
    pub offset: T,
}

impl<T: Copy> Catalogued<T> for DriveGain<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[gain_error, offset] = params else { return None };
        Some(Self { gain_error, offset })
    }
}

impl<T: Real> Hooks<T> for DriveGain<T> {
    type State = ();
    const UNDONE_AT: Option<Place> = Some(Place::Bridge);

    fn bridge(&self, _: &(), _: &EffectContext<T>, x: &mut Bridge<T>) {
        let Self { gain_error, offset } = *self;
        x.voltage = given(gain_error, offset, x.voltage);
        x.sampled = given(gain_error, offset, x.sampled);
    }

    fn undo_bridge(&self, _: &BridgeDemand<T>, voltage: &mut T) {
        // u = (u_eff − o)/(1 + g)
        *voltage = (*voltage - self.offset) / (T::one() + self.gain_error);
    }

    fn bridge_room(&self, room: &mut BridgeRoom<T>) {
        room.share *= T::one() + self.gain_error;
        room.kept += self.offset.abs();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a bridge gives of a mean voltage and one at the sampling instant.
    fn driven(p: [f64; 2], voltage: f64, sampled: f64) -> Bridge<f64> {
        // the command is another one: it may have been delayed or weakened on its way
        let mut x = Bridge { command: 99.0, bus: 12.0, voltage, sampled, ..Bridge::default() };
        DriveGain::of(&p).expect("as many as on the card").bridge(&(), &EffectContext::default(), &mut x);
        x
    }

    #[test]
    fn without_an_error_the_bridge_is_left_bit_for_bit() {
        for voltage in [0.0, -0.0, 7.3, -11.9] {
            let x = driven([0.0, 0.0], voltage, -voltage);
            assert_eq!((x.voltage.to_bits(), x.sampled.to_bits()), (voltage.to_bits(), (-voltage).to_bits()));
        }
    }

    #[test]
    fn a_gain_takes_its_share_of_mean_and_sample_and_nothing_at_zero() {
        let x = driven([-0.05, 0.0], 8.0, -4.0);
        assert!((x.voltage - 7.6).abs() < 1e-15 && (x.sampled + 3.8).abs() < 1e-15, "{x:?}");
        assert_eq!(driven([-0.05, 0.0], 0.0, 0.0).voltage, 0.0);
    }

    #[test]
    fn an_offset_is_there_at_any_voltage() {
        for gain_error in [-0.5, 0.0, 0.5] {
            let [up, none, down] = [6.0, 0.0, -6.0].map(|u| driven([gain_error, 0.2], u, u));
            assert_eq!((none.voltage, none.sampled), (0.2, 0.2));
            assert!((0.5 * (up.voltage + down.voltage) - 0.2).abs() < 1e-15);
        }
    }

    #[test]
    fn the_command_that_it_was_given_is_found_again() {
        let x = driven([0.07, -0.1], 5.0, 5.0);
        assert!(((x.voltage + 0.1) / 1.07 - 5.0).abs() < 1e-15);
        assert_eq!((x.command, x.drop), (99.0, 0.0));
    }
}
