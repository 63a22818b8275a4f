//! # Current lag: the current is smoothed, and so comes late
//!
//! ```text
//! T · di_read/dt + i_read = i
//! ```
//!
//! A current that is switched 20 000 times a second is rough, and an amplifier's filter or a running mean smooths it. After
//! a change of voltage the motor's current jumps and the reading creeps after it; a current that stays is read rightly.
//!
//! symbol  code        unit  meaning
//! ------  ----------  ----  ---------------------------------------------------
//! T       `lag`       s     time constant of the smoothing
//! W       `WINDOW_S`  s     time over which a reading is taken: 0.1 ms
//! Δt      `at.dt`     s     length of the step
//! y       `smooth`    A     smoothed current at the beginning of a step
//!
//! A current jumps from step to step with the voltage, so it is taken to be held over each step. The smoothed current
//! then follows exactly, at steps of any length, and the reading is its mean over a time W from the step's beginning:
//!
//! ```text
//! i_read = i − (i − y)·(1 − e⁻ʷ)/w,   y⁺ = i − (i − y)·e⁻ˣ,   x = Δt/T,  w = min(W, Δt)/T
//! ```
//!
//! W is a period or two of the bridge's switching: less cannot be read of a current that is chopped. Steps longer than that
//! read the same, however long they are.
//!
//! Memory: y. At a start the first current is taken to have flowed for long, so that nothing is late. A prediction that
//! begins again with another motion goes on with the current that was smoothed: no motion says it better.
//!
//! Fails when: rows of a recording are several lags long: every reading is then that of the row before, whatever the lag.
//! How to measure it: hold a wheel and switch its voltage on: the current that is read rises with T.
//! Source: Low-pass of first order behind a hold: Franklin, Powell, Workman, Digital Control of Dynamic Systems, 1998,
//! ch. 6; sizes: estimated, filters and means of 0.5 to 10 ms.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{EffectContext, Sense, StepOutcome};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks, Needs, Numbers, State};
use crate::number::decay;
use crate::number::scalar::Real;

/// W, time over which a reading is taken [s]
pub const WINDOW_S: f64 = 1e-4;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "current_lag",
    title: "Lag of the current sensor",
    summary: "The current is smoothed before it is recorded, so that it follows changes late.",
    equation: "T · di_read/dt + i_read = i",
    source: "low-pass of first order behind a hold: Franklin, Powell, Workman, Digital Control of Dynamic Systems, 1998, ch. 6; sizes: estimated, filters and means of 0.5 to 10 ms",
    seams: &[Seam::Sense],
    scope: Scope::Wheels,
    params: &[Param {
        key: "lag_s",
        symbol: "T",
        unit: "s",
        absent: 0.0,
        typical: 0.002,
        within: (0.0, 0.05),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows { channels: &[Channel::Current], regime: Regime::CommandChange, parity: Parity::Odd, order: None },
    signature: "current behind after every change of voltage, and right where it stays",
    look_alikes: &[LookAlike {
        with: "winding_inductance",
        settled_by: "lock a wheel, step its voltage and hold what the robot reads of its current against an oscilloscope at the same lead: an inductance bends both, a smoothing sensor only what is read",
    }],
    code: 48,
    undone: Undone::No("a current that is smoothed is known late, and the loop does not guess what it is now"),
    physics: Physics::PASSIVE,
};

/// The smoothed current at the beginning of a step.
#[derive(Clone, Copy, Debug)]
pub struct Smoothed<T> {
    /// y [A]
    smooth: T,
    /// False before a current has flowed
    known: bool,
}

impl<T: Real> Smoothed<T> {
    /// i − y, how far it is behind a current [A].
    fn behind(&self, current: T) -> T {
        if self.known { current - self.smooth } else { T::zero() }
    }
}

impl<T: Real> Numbers<T> for Smoothed<T> {
    fn for_each_mut(&mut self, mut visit: impl FnMut(&mut T)) {
        visit(&mut self.smooth);
    }
}

impl<T: Real> State<T> for Smoothed<T> {
    fn start() -> Self {
        Self { smooth: T::zero(), known: false }
    }
}

/// Lag of the current sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurrentLag<T> {
    /// T, time constant of the smoothing [s]
    pub lag: T,
}

impl<T: Copy> Catalogued<T> for CurrentLag<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[lag] = params else { return None };
        Some(Self { lag })
    }
}

impl<T: Real> Hooks<T> for CurrentLag<T> {
    type State = Smoothed<T>;
    /// A current changes with the speed while it is taken to be held.
    const NEEDS: Needs = Needs { steps_per_s: 1000, ..Needs::NOTHING };

    fn sense(&self, s: &Smoothed<T>, at: &EffectContext<T>, x: &mut Sense<T>) {
        // i − (i − y)·(1 − e⁻ʷ)/w, written so that nothing behind keeps even the sign of a zero
        x.current -= T::zero() + s.behind(x.current) * decay::mean_remaining(self.lag, at.dt.min(T::lit(WINDOW_S)));
    }

    fn advance(&self, s: &mut Smoothed<T>, at: &EffectContext<T>, done: &StepOutcome<T>) {
        // y⁺ = i − (i − y)·e⁻ˣ
        let smooth = done.current - s.behind(done.current) * decay::remaining(self.lag, at.dt);
        *s = Smoothed { smooth, known: true };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::dual::Dual;

    fn at<T: Real>(dt: T) -> EffectContext<T> {
        EffectContext { dt, ..EffectContext::default() }
    }

    fn read<T: Real>(lag: T, s: &Smoothed<T>, current: T, dt: T) -> T {
        let mut x = Sense { current, ..Sense::default() };
        CurrentLag { lag }.sense(s, &at(dt), &mut x);
        x.current
    }

    fn advance<T: Real>(lag: T, s: &mut Smoothed<T>, current: T, dt: T) {
        CurrentLag { lag }.advance(s, &at(dt), &StepOutcome { current, ..StepOutcome::default() });
    }

    /// After a current that flowed for long.
    fn after<T: Real>(lag: T, current: T) -> Smoothed<T> {
        let mut s = Smoothed::start();
        advance(lag, &mut s, current, T::lit(1e-3));
        s
    }

    #[test]
    fn without_lag_the_reading_is_the_truth_bit_for_bit() {
        for mut s in [Smoothed::start(), after(0.0, -3.0)] {
            for current in [3.7, -0.0, 0.0, -0.0, -1.3, 2.0] {
                assert_eq!(read(0.0_f64, &s, current, 1e-3).to_bits(), current.to_bits());
                advance(0.0, &mut s, current, 1e-3);
            }
        }
    }

    #[test]
    fn a_current_that_stays_is_read_as_it_is_bit_for_bit() {
        for mut s in [Smoothed::start(), after(0.002, 1.37)] {
            for dt in [0.02, 1e-4, 0.5] {
                assert_eq!(read(0.002, &s, 1.37_f64, dt).to_bits(), 1.37_f64.to_bits());
                advance(0.002, &mut s, 1.37, dt);
            }
        }
    }

    #[test]
    fn after_a_jump_a_time_constant_later_an_eulerth_of_it_is_left() {
        let mut s = after(0.002, 0.0);
        advance(0.002, &mut s, 5.0, 0.002);
        assert!((5.0 - s.smooth - 5.0 * libm::exp(-1.0)).abs() < 1e-15, "{}", s.smooth);
        // just after it the reading is where it was, and with a lag that is short against W where it goes to
        assert!((read(0.002, &after(0.002, 1.0), 5.0, 1e-9) - 1.0).abs() < 2e-6);
        assert!((read(1e-8, &after(1e-8, 1.0), 5.0, 1.0) - 5.0).abs() < 1e-3);
    }

    #[test]
    fn a_reading_is_the_mean_of_its_parts_and_does_not_know_how_long_the_step_is() {
        let parts = [1e-5, 4.9e-5, 4.1e-5];
        for lag in [1e-5, 0.002, 0.05] {
            let (mut s, mut sum) = (after(lag, -2.0_f64), 0.0);
            for part in parts {
                sum += part * read(lag, &s, 4.0, part);
                advance(lag, &mut s, 4.0, part);
            }
            let mut whole = after(lag, -2.0);
            for dt in [WINDOW_S, 0.02] {
                assert!((read(lag, &whole, 4.0, dt) - sum / WINDOW_S).abs() < 1e-13);
            }
            advance(lag, &mut whole, 4.0, WINDOW_S);
            assert!((whole.smooth - s.smooth).abs() < 1e-14);
        }
    }

    #[test]
    fn from_no_lag_on_the_reading_falls_behind_in_proportion() {
        let none = Dual::<1>::variable(0.0, 0);
        let constant = Dual::<1>::constant;
        // ∂i_read/∂T = −(5 − 2)/W at T = 0
        let exact = read(none, &after(none, constant(2.0)), constant(5.0), constant(2e-3)).eps[0];
        let difference = (read(1e-9, &after(1e-9, 2.0), 5.0, 2e-3) - 5.0) / 1e-9;
        assert!((exact + 3e4).abs() < 1e-7 && (difference + 3e4).abs() < 0.02, "{exact}, {difference}");
    }
}
