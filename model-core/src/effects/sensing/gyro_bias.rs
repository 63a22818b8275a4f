//! # Gyro bias: the yaw rate does not read zero at rest
//!
//! ```text
//! ω_read = ω + b
//! ```
//!
//! A gyro on a chip reads a small rate while it stands, and that rate wanders with its temperature. Who takes it out in a
//! calibration at rest takes out what it was then. Speed, currents and pose are as they should be.
//!
//! symbol  code    unit   meaning
//! ------  ------  -----  -------------------------
//! b       `bias`  rad/s  yaw rate that is read at rest
//!
//! Fails when: the bias wanders within the recording: then it is a slow function of time.
//! How to measure it: let the robot stand for some seconds and take the mean of the yaw rate.
//! Source: Zero-rate output of a gyro (IEEE 528, inertial sensor terminology); sizes: estimated from data sheets of gyros on
//! chips, 0.1 to 1 °/s after calibration.

use crate::effects::card::{Card, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{EffectContext, Sense};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "gyro_bias",
    title: "Bias of the gyro",
    summary: "The gyro reads a constant yaw rate that the robot does not have.",
    equation: "ω_read = ω + b",
    source: "zero-rate output of a gyro (IEEE 528, inertial sensor terminology); sizes: estimated from data sheets of gyros on chips, 0.1 to 1 °/s after calibration",
    seams: &[Seam::Sense],
    scope: Scope::Robot,
    params: &[Param {
        key: "bias_rad_s",
        symbol: "b",
        unit: "rad/s",
        absent: 0.0,
        typical: 0.02,
        within: (-0.5, 0.5),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows { channels: &[Channel::YawRate], regime: Regime::Always, parity: Parity::Even, order: None },
    signature: "a constant in the yaw rate",
    look_alikes: &[],
    code: 26,
    undone: Undone::No("a robot with a gyro learns its bias by itself whenever it stands"),
    physics: Physics {
        // in a mirror the robot turns the other way, its gyro does not
        mirrored: &[0],
        ..Physics::PASSIVE
    },
};

/// Yaw rate that is read [rad/s].
#[inline]
pub fn reading<T: Real>(bias: T, yaw_rate: T) -> T {
    // ω_read = ω + b, written so that no bias keeps even the sign of a zero
    yaw_rate - (T::zero() - bias)
}

/// Bias of the gyro.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GyroBias<T> {
    /// b, yaw rate that is read at rest [rad/s]
    pub bias: T,
}

impl<T: Copy> Catalogued<T> for GyroBias<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[bias] = params else { return None };
        Some(Self { bias })
    }
}

impl<T: Real> Hooks<T> for GyroBias<T> {
    type State = ();

    fn sense(&self, _: &(), _: &EffectContext<T>, x: &mut Sense<T>) {
        x.gyro = reading(self.bias, x.gyro);
    }

    fn invert_sensing(&self, _: &EffectContext<T>, x: &mut Sense<T>) {
        x.gyro -= self.bias;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sensed(bias: f64, gyro: f64) -> Sense<f64> {
        let mut x = Sense { gyro, wheel_speed: 3.0, ..Sense::default() };
        GyroBias { bias }.sense(&(), &EffectContext::default(), &mut x);
        x
    }

    #[test]
    fn without_bias_the_reading_is_the_truth_bit_for_bit() {
        for gyro in [0.0, -0.0, 0.7, -1.3] {
            let mut x = sensed(0.0, gyro);
            assert_eq!(x.gyro.to_bits(), gyro.to_bits());
            GyroBias { bias: 0.0 }.invert_sensing(&EffectContext::default(), &mut x);
            assert_eq!(x.gyro.to_bits(), gyro.to_bits());
        }
    }

    #[test]
    fn at_rest_the_reading_is_the_bias_and_nothing_else_is_touched() {
        let x = sensed(0.02, 0.0);
        assert_eq!((x.gyro, x.wheel_speed, x.current, x.pose.theta), (0.02, 3.0, 0.0, 0.0));
    }

    #[test]
    fn reading_backwards_gives_the_truth() {
        let mut x = sensed(-0.02, 0.7);
        GyroBias { bias: -0.02 }.invert_sensing(&EffectContext::default(), &mut x);
        assert!((x.gyro - 0.7).abs() < 1e-15);
    }
}
