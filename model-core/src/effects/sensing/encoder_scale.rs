//! # Encoder scale: one encoder counts too much or too little
//!
//! ```text
//! w_read = w·(1 + s)
//! ```
//!
//! The counts of an encoder become a speed by a number of counts per turn. Where that number is wrong for one wheel, or
//! a gear with another number of teeth sits before its encoder, that wheel is read too fast or too slow by a fixed share.
//! The robot itself moves as before.
//!
//! symbol  code           unit  meaning
//! ------  -------------  ----  ----------------------------------------
//! s       `scale_error`  1     speed read too much, over the true speed
//!
//! Fails when: counts are lost above some speed, or the wheel itself has another radius: then the robot moves otherwise.
//! How to measure it: turn the wheel by hand through ten turns and compare the angle that is read.
//! Source: Scale factor error of a sensor: IEEE Std 528; sizes: estimated, one tooth of fifty is 2 %.

use crate::effects::card::{Card, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{EffectContext, Sense};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "encoder_scale",
    title: "Scale of one encoder",
    summary: "One wheel's encoder reads a speed that is too high or too low by a fixed share.",
    equation: "w_read = w·(1 + s)",
    source: "scale factor error of a sensor: IEEE Std 528; sizes: estimated, one tooth of fifty is 2 %",
    seams: &[Seam::Sense],
    scope: Scope::OneWheel,
    params: &[Param {
        key: "scale_error",
        symbol: "s",
        unit: "1",
        absent: 0.0,
        typical: 0.02,
        within: (-0.3, 0.3),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows { channels: &[Channel::WheelSpeed], regime: Regime::Speed, parity: Parity::Odd, order: None },
    signature: "speed of one wheel wrong in step with itself; the other wheels right",
    look_alikes: &[],
    code: 24,
    undone: Undone::Folded("the wheel's speed is counted as w_read/(1 + s)"),
    physics: Physics::PASSIVE,
};

/// Reading of the wheel speed [rad/s].
#[inline]
pub fn reading<T: Real>(scale_error: T, wheel_speed: T) -> T {
    // w_read = w·(1 + s)
    wheel_speed * (T::one() + scale_error)
}

/// Scale of one encoder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EncoderScale<T> {
    /// s, speed read too much, over the true speed [1]
    pub scale_error: T,
}

impl<T: Copy> Catalogued<T> for EncoderScale<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[scale_error] = params else { return None };
        Some(Self { scale_error })
    }
}

impl<T: Real> Hooks<T> for EncoderScale<T> {
    type State = ();

    fn sense(&self, _: &(), _: &EffectContext<T>, x: &mut Sense<T>) {
        x.wheel_speed = reading(self.scale_error, x.wheel_speed);
    }

    fn invert_sensing(&self, _: &EffectContext<T>, x: &mut Sense<T>) {
        // w = w_read/(1 + s)
        x.wheel_speed = x.wheel_speed / (T::one() + self.scale_error);
    }

    fn fold_reading(&self, speed: &mut T) {
        // w = w_read/(1 + s)
        *speed = *speed / (T::one() + self.scale_error);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sensed(scale_error: f64, wheel_speed: f64) -> Sense<f64> {
        let mut x = Sense { current: 0.7, wheel_speed, ..Sense::default() };
        EncoderScale { scale_error }.sense(&(), &EffectContext::default(), &mut x);
        x
    }

    #[test]
    fn without_an_error_the_reading_is_the_truth_bit_for_bit() {
        for speed in [0.0, -0.0, 13.7, -41.3] {
            let mut x = sensed(0.0, speed);
            assert_eq!(x.wheel_speed.to_bits(), speed.to_bits());
            EncoderScale { scale_error: 0.0 }.invert_sensing(&EffectContext::default(), &mut x);
            assert_eq!(x.wheel_speed.to_bits(), speed.to_bits());
        }
    }

    #[test]
    fn it_reads_too_much_either_way_and_nothing_of_a_wheel_at_rest() {
        assert!((sensed(0.02, 50.0).wheel_speed - 51.0).abs() < 1e-14);
        assert!((sensed(0.02, -50.0).wheel_speed + 51.0).abs() < 1e-14);
        assert!((sensed(-0.3, 50.0).wheel_speed - 35.0).abs() < 1e-14);
        assert_eq!(sensed(0.02, 0.0).wheel_speed, 0.0);
        assert_eq!(sensed(0.02, 50.0).current, 0.7);
    }

    #[test]
    fn reading_backwards_gives_the_truth() {
        for scale_error in [-0.3, 0.02, 0.3] {
            let mut x = sensed(scale_error, 17.3);
            EncoderScale { scale_error }.invert_sensing(&EffectContext::default(), &mut x);
            assert!((x.wheel_speed - 17.3).abs() < 1e-14);
        }
    }
}
