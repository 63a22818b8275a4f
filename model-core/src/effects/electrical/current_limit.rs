//! # Current limit: the drive lets only so much current flow
//!
//! ```text
//! |i| ≤ i_max
//! ```
//!
//! A drive protects itself and its motor: when the current reaches a limit it lowers the voltage until no more flows. The
//! command then has no say, and nor has the back-EMF: the motor gives a constant torque. At hard starts and reversals, where
//! little or opposite back-EMF stands against the voltage, a wheel pulls less than the command asks for; once it turns, all
//! is as before.
//!
//! symbol  code     unit  meaning
//! ------  -------  ----  ------------------------------------------------------
//! i_max   `limit`  A     most current, either way; 0 stands for no limit
//!
//! A limit of zero stands for a drive without one: the nominal model. The way there leads over large limits, so a fit
//! starts from the typical value. A limit that no run ever reaches changes nothing, and nothing can be said of it then.
//!
//! Neglects: that a drive that limits takes less duty, so that its current weighs less on the battery.
//! Fails when: the limit is slow, or closes for a while after it was passed; when it is that of the whole battery.
//! How to measure it: lock a wheel and raise the voltage slowly: the current rises by u/R and stops at the limit.
//! Source: Current limit of a motor drive: Mohan, Undeland, Robbins, Power Electronics, 2003, ch. 13; sizes: estimated after
//! data sheets of small drives, 1 to 10 A.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{Bridge, EffectContext};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "current_limit",
    title: "Limit of the current",
    summary: "The drive lowers its voltage when the current is too large, so that hard starts and reversals are softer.",
    equation: "|i| ≤ i_max",
    source: "current limit of a motor drive: Mohan, Undeland, Robbins, Power Electronics, 2003, ch. 13; sizes: estimated after data sheets of small drives, 1 to 10 A",
    seams: &[Seam::Bridge],
    scope: Scope::Wheels,
    params: &[Param {
        key: "limit_A",
        symbol: "i_max",
        unit: "A",
        absent: 0.0,
        typical: 2.0,
        within: (0.0, 30.0),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows { channels: &[Channel::Current], regime: Regime::Current, parity: Parity::Odd, order: None },
    signature: "current cut off at the same height at starts and reversals, and right elsewhere; acceleration constant meanwhile",
    look_alikes: &[LookAlike {
        with: "wheel_slip",
        settled_by: "lock a wheel and raise its voltage slowly: a limit stops the current, a floor that lets go does not",
    }],
    code: 34,
    undone: Undone::No("the drive protects itself; ask for less acceleration"),
    physics: Physics { corner_at_absent: true, is_limit: true, ..Physics::PASSIVE },
};

/// The smaller of two limits, of which zero stands for none [A].
#[inline]
pub fn tighter<T: Real>(limit: T, other: T) -> T {
    if limit <= T::zero() {
        other
    } else if other <= T::zero() {
        limit
    } else {
        // i_max
        limit.min(other)
    }
}

/// Limit of the current.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurrentLimit<T> {
    /// i_max, either way; 0 stands for no limit [A]
    pub limit: T,
}

impl<T: Copy> Catalogued<T> for CurrentLimit<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[limit] = params else { return None };
        Some(Self { limit })
    }
}

impl<T: Real> Hooks<T> for CurrentLimit<T> {
    type State = ();

    fn bridge(&self, _: &(), _: &EffectContext<T>, x: &mut Bridge<T>) {
        x.current_limit = tighter(self.limit, x.current_limit);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn limited(limit: f64, before: f64) -> Bridge<f64> {
        let mut x = Bridge { command: 7.0, voltage: 6.5, sampled: 6.5, current_limit: before, ..Bridge::default() };
        CurrentLimit { limit }.bridge(&(), &EffectContext::default(), &mut x);
        x
    }

    #[test]
    fn without_a_limit_the_bridge_is_left_bit_for_bit() {
        for before in [0.0, 3.0] {
            let x = limited(0.0, before);
            assert_eq!([x.current_limit, x.voltage].map(f64::to_bits), [before, 6.5].map(f64::to_bits));
        }
    }

    #[test]
    fn the_tighter_of_two_limits_holds() {
        assert_eq!([limited(2.0, 0.0), limited(2.0, 3.0), limited(3.0, 2.0)].map(|x| x.current_limit), [2.0; 3]);
    }

    #[test]
    fn the_voltage_is_left_to_the_plant() {
        let x = limited(2.0, 0.0);
        assert_eq!((x.voltage, x.sampled, x.drop), (6.5, 6.5, 0.0));
    }
}
