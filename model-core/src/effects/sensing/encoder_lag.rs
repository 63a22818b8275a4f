//! # Encoder lag: the wheel speed is smoothed, and so comes late
//!
//! ```text
//! T · dw_read/dt + w_read = w
//! ```
//!
//! A speed made of counts is rough, and is smoothed before it is used. A first-order low-pass is the plain case; a mean
//! over a window lags by half the window. At constant speed the reading is right; while the speed changes it is behind by
//! T times the acceleration.
//!
//! symbol  code     unit  meaning
//! ------  -------  ----  ------------------------------
//! T       `lag`    s     time constant of the smoothing
//! Δt      `at.dt`  s     length of the step
//!
//! The wheel speed is taken to change along a straight line from step to step. What the reading is behind, b = w − w_read,
//! then follows exactly, at steps of any length:
//!
//! ```text
//! b⁺ = b·e⁻ˣ + (w⁺ − w)·(1 − e⁻ˣ)/x,   x = Δt/T
//! ```
//!
//! Memory: wheel speed and b at the beginning of the last step, and its length. At a restart the robot is taken to have
//! come with constant velocity, so that nothing is behind; for the same reason a smoothed reading is the truth that a
//! prediction starts from.
//!
//! Fails when: the speed jumps within a step, as that of a wheel that slips: the jump is then spread over the step.
//! How to measure it: lift the robot, switch the voltage of a wheel off and on: the speed that is read turns late by T.
//! Source: Low-pass of first order behind a triangle hold: Franklin, Powell, Workman, Digital Control of Dynamic
//! Systems, 1998, ch. 6; sizes: estimated, windows of 2 to 40 ms.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{EffectContext, Sense, StepOutcome};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks, Numbers, State};
use crate::number::decay;
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "encoder_lag",
    title: "Lag of the encoders",
    summary: "The wheel speed is smoothed before it is recorded, so that it follows changes late.",
    equation: "T · dw_read/dt + w_read = w",
    source: "low-pass of first order behind a triangle hold: Franklin, Powell, Workman, Digital Control of Dynamic Systems, 1998, ch. 6; sizes: estimated, windows of 2 to 40 ms",
    seams: &[Seam::Sense],
    scope: Scope::Wheels,
    params: &[Param {
        key: "lag_s",
        symbol: "T",
        unit: "s",
        absent: 0.0,
        typical: 0.008,
        within: (0.0, 0.2),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows { channels: &[Channel::WheelSpeed], regime: Regime::Acceleration, parity: Parity::Odd, order: None },
    signature: "wheel speed behind by T times its acceleration, and right at constant speed",
    look_alikes: &[LookAlike {
        with: "speed_loop",
        settled_by: "film the wheel, or log a pose: a drive that answers late moves the robot late, an encoder that reads late does not",
    }],
    code: 25,
    undone: Undone::No("a speed that is smoothed is known late, and the controller does not guess what it is now"),
    physics: Physics::PASSIVE,
};

/// How far the reading is behind after a time in which the wheel gained speed evenly [rad/s].
#[inline]
pub fn behind<T: Real>(lag: T, elapsed: T, before: T, gained: T) -> T {
    // b⁺ = b·e⁻ˣ + (w⁺ − w)·(1 − e⁻ˣ)/x
    before * decay::remaining(lag, elapsed) + gained * decay::mean_remaining(lag, elapsed)
}

/// The last step.
#[derive(Clone, Copy, Debug)]
pub struct LastStep<T> {
    /// Wheel speed at its beginning [rad/s]
    speed: T,
    /// b, how far the reading was behind then [rad/s]
    behind: T,
    /// Its length [s]
    dt: T,
    /// False before there was one
    known: bool,
}

impl<T: Real> LastStep<T> {
    /// How far the reading is behind now that the wheel turns at this speed [rad/s].
    fn behind_at(&self, lag: T, speed: T) -> T {
        if self.known { behind(lag, self.dt, self.behind, speed - self.speed) } else { T::zero() }
    }
}

impl<T: Real> Numbers<T> for LastStep<T> {
    fn for_each_mut(&mut self, visit: impl FnMut(&mut T)) {
        [&mut self.speed, &mut self.behind, &mut self.dt].into_iter().for_each(visit);
    }
}

impl<T: Real> State<T> for LastStep<T> {
    fn start() -> Self {
        Self { speed: T::zero(), behind: T::zero(), dt: T::zero(), known: false }
    }
}

/// Lag of the encoders.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EncoderLag<T> {
    /// T, time constant of the smoothing [s]
    pub lag: T,
}

impl<T: Copy> Catalogued<T> for EncoderLag<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[lag] = params else { return None };
        Some(Self { lag })
    }
}

impl<T: Real> Hooks<T> for EncoderLag<T> {
    type State = LastStep<T>;

    fn sense(&self, s: &LastStep<T>, at: &EffectContext<T>, x: &mut Sense<T>) {
        // w_read = w − b, written so that nothing behind keeps even the sign of a zero
        x.wheel_speed -= T::zero() + s.behind_at(self.lag, at.wheel_speed);
    }

    fn restart(&self, s: &mut LastStep<T>, at: &EffectContext<T>) {
        *s = LastStep { speed: at.wheel_speed, known: true, ..LastStep::start() };
    }

    fn advance(&self, s: &mut LastStep<T>, at: &EffectContext<T>, done: &StepOutcome<T>) {
        let speed = done.wheel_speed;
        *s = LastStep { speed, behind: s.behind_at(self.lag, speed), dt: at.dt, known: true };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::dual::Dual;

    fn read<T: Real>(lag: T, s: &LastStep<T>, wheel_speed: T) -> T {
        let at = EffectContext { wheel_speed, ..EffectContext::default() };
        let mut x = Sense { wheel_speed, ..Sense::default() };
        EncoderLag { lag }.sense(s, &at, &mut x);
        x.wheel_speed
    }

    fn advance<T: Real>(lag: T, s: &mut LastStep<T>, wheel_speed: T, dt: T) {
        let at = EffectContext { wheel_speed, dt, ..EffectContext::default() };
        EncoderLag { lag }.advance(s, &at, &StepOutcome { wheel_speed, ..StepOutcome::default() });
    }

    fn restarted<T: Real>(lag: T, wheel_speed: T) -> LastStep<T> {
        let mut s = LastStep { speed: T::lit(7.0), behind: T::lit(3.0), dt: T::lit(0.1), known: true };
        EncoderLag { lag }.restart(&mut s, &EffectContext { wheel_speed, ..EffectContext::default() });
        s
    }

    #[test]
    fn without_lag_the_reading_is_the_truth_bit_for_bit() {
        for mut s in [LastStep::start(), restarted(0.0, -3.0)] {
            for speed in [3.7, -0.0, 0.0, -0.0, -41.3, 2.0] {
                assert_eq!(read(0.0_f64, &s, speed).to_bits(), speed.to_bits());
                advance(0.0, &mut s, speed, 1e-3);
            }
        }
    }

    #[test]
    fn at_constant_speed_the_reading_is_the_truth_bit_for_bit() {
        for mut s in [LastStep::start(), restarted(0.008, 13.7)] {
            for dt in [0.02, 1e-4, 0.5] {
                assert_eq!(read(0.008, &s, 13.7_f64).to_bits(), 13.7_f64.to_bits());
                advance(0.008, &mut s, 13.7, dt);
            }
        }
    }

    #[test]
    fn at_a_jump_the_reading_stays_where_it_was() {
        assert_eq!(read(0.008, &restarted(0.008, 13.7), 20.0_f64), 13.7);
        assert_eq!(read(0.0, &restarted(0.0, 13.7), 20.0_f64), 20.0);
    }

    #[test]
    fn after_a_jump_a_time_constant_later_an_eulerth_of_it_is_left() {
        // 10 rad/s gained in no time, then held
        let left = behind(0.008, 0.008, behind(0.008, 0.0, 0.0, 10.0), 0.0_f64);
        assert!((left - 10.0 * libm::exp(-1.0)).abs() < 1e-14, "{left}");
    }

    #[test]
    fn on_a_ramp_it_ends_up_behind_by_lag_times_acceleration() {
        for dt in [1e-4, 1e-3, 0.008, 0.02, 1.0] {
            let mut left = 0.0;
            for _ in 0..10_000 {
                left = behind(0.008, dt, left, 300.0 * dt);
            }
            // the exponential loses up to 2⁻⁵³/x to cancellation in 1 − e⁻ˣ, x = 0.0125
            assert!((left - 0.008 * 300.0_f64).abs() < 1e-12, "{left} at {dt} s");
        }
    }

    #[test]
    fn a_step_is_its_parts() {
        let (whole, parts) = (0.02, [0.0001, 0.0049, 0.0071, 0.0079]);
        for lag in [1e-5, 0.003, 0.008, 0.2] {
            let at_once = behind(lag, whole, -2.0, 6.0_f64);
            let in_parts = parts.into_iter().fold(-2.0, |left, part| behind(lag, part, left, 6.0 * part / whole));
            assert!((at_once - in_parts).abs() < 1e-13, "{at_once} against {in_parts}");
        }
    }

    #[test]
    fn single_precision_stays_with_double() {
        let (mut single, mut double) = (0.0_f32, 0.0_f64);
        for _ in 0..2000 {
            single = behind(0.2, 1e-4, single, 0.03);
            double = behind(0.2, 1e-4, double, 0.03);
        }
        // 2000 steps, each of which rounds up to 40 rad/s by 2⁻²⁴
        assert!((f64::from(single) - double).abs() < 2000.0 * 40.0 / f64::from(1 << 24), "{single} against {double}");
    }

    #[test]
    fn from_no_lag_on_the_reading_falls_behind_in_proportion() {
        let none = Dual::<1>::variable(0.0, 0);
        let constant = Dual::<1>::constant;
        let mut s = restarted(none, constant(2.0));
        assert_eq!(read(none, &s, constant(2.0)).eps, [0.0]);
        advance(none, &mut s, constant(2.0), constant(2e-3));
        // ∂w_read/∂T = −(5 − 2)/Δt at T = 0
        let exact = read(none, &s, constant(5.0)).eps[0];
        let mut s = restarted(1e-9, 2.0);
        advance(1e-9, &mut s, 2.0, 2e-3);
        let difference = (read(1e-9, &s, 5.0) - 5.0) / 1e-9;
        assert!((exact + 1500.0).abs() < 1e-9 && (difference + 1500.0).abs() < 1e-3, "{exact}, {difference}");
    }
}
