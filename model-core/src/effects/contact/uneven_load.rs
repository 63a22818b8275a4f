//! # Uneven load: one wheel presses on the floor with another share
//!
//! ```text
//! N_j → N_j·(1 + s)
//! ```
//!
//! Four wheels under a stiff chassis wobble like a table: a short wheel, a warped plate or a bump takes the load off one of
//! them. What it still carries is what it can push with, so it slips long before the others. A wheel whose rollers are worn
//! or dirty looks the same: what counts is the product of its load and its grip.
//!
//! symbol  code     unit  meaning
//! ------  -------  ----  -------------------------------------------------------------
//! s       `share`  1     what the wheel carries more than its share, below zero: less
//! N_j     `load`   N     what wheel j would carry
//!
//! It needs a floor that holds only so much: beside [`wheel_slip`](super::wheel_slip) alone does a load matter. What the
//! other wheels carry is left as it is; on a stiff chassis of four the opposite wheel loses as much and the neighbours gain
//! it, and each of these can be given an uneven load of its own.
//!
//! Fails when: the load changes on the way, with the floor or with the acceleration (`load_transfer`).
//! How to measure it: put each wheel on a kitchen scale, the others on blocks as high.
//! Source: Statics of a stiff body on more than three feet, whose loads no balance determines; sizes: estimated, to a wheel
//! that carries next to nothing.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{Contact, EffectContext};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "uneven_load",
    title: "Uneven load of one wheel",
    summary: "One wheel presses less on the floor than the others, or grips less, and slips first.",
    equation: "N_j → N_j·(1 + s)",
    source: "statics of a stiff body on more than three feet, whose loads no balance determines; sizes: estimated, to a wheel that carries next to nothing",
    seams: &[Seam::Contact],
    scope: Scope::OneWheel,
    params: &[Param {
        key: "share",
        symbol: "s",
        unit: "1",
        absent: 0.0,
        typical: -0.4,
        within: (-0.95, 2.0),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows { channels: &[Channel::WheelSpeed], regime: Regime::Driven, parity: Parity::Odd, order: None },
    signature: "one wheel slips before the others, always the same one",
    look_alikes: &[LookAlike {
        with: "load_transfer",
        settled_by: "drive with the same acceleration forwards and backwards: an uneven wheel slips both times, a load that is shifted makes others slip",
    }],
    code: 52,
    undone: Undone::No("no current makes the floor hold more; lower the largest acceleration"),
    physics: Physics { shows_beside: Some("wheel_slip"), ..Physics::PASSIVE },
};

/// Uneven load of one wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnevenLoad<T> {
    /// s, what the wheel carries more than its share [1]
    pub share: T,
}

impl<T: Copy> Catalogued<T> for UnevenLoad<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[share] = params else { return None };
        Some(Self { share })
    }
}

impl<T: Real> Hooks<T> for UnevenLoad<T> {
    type State = ();
    const SETTLES_CONTACT: bool = true;

    fn contact(&self, _: &(), _: &EffectContext<T>, x: &mut Contact<T>) {
        // N·(1 + s)
        x.load *= T::one() + self.share;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn load(share: f64) -> f64 {
        let mut x = Contact { load: 5.7, ..Contact::default() };
        UnevenLoad { share }.contact(&(), &EffectContext::default(), &mut x);
        x.load
    }

    #[test]
    fn an_even_load_is_left_bit_for_bit() {
        assert_eq!([0.0, -0.0].map(load).map(f64::to_bits), [5.7_f64.to_bits(); 2]);
    }

    #[test]
    fn a_share_less_is_that_much_less() {
        assert!((load(-0.4) - 3.42).abs() < 1e-12);
        assert!((load(1.0) - 11.4).abs() < 1e-12);
    }
}
