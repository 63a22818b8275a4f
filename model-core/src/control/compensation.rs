//! # Compensation: effects that the controller undoes
//!
//! What a diagnosis has found and a robot file carries as `[effects.<id>]`, the controller can undo with the same law: it
//! asks the motors for what the effect will take away. This file holds which effects are undone; how each one is, or why
//! it cannot be, stands in its own file and on its card, and [`motion_controller`](crate::control::motion_controller) goes
//! through them.
//!
//! Everything here follows the reference and never the measurement: dry friction that followed a measured speed would
//! chatter around standstill.
//!
//! Neglects: that effects act on each other, but for the order in which the plant applies them. Fails when: the motion
//! leaves the reference; feedback then takes care of the rest.
//!
//! How to get the numbers: `omni-gap diagnose`, which writes them into `corrected_robot.toml`.

mod own_wheels;

use crate::effects::active::MOST_UNDONE;
use crate::effects::undoing::Wheels;
use crate::effects::{Effect, EffectKind};
use crate::number::scalar::Real;

/// An effect that is undone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Undo<T = f32> {
    /// Which, with its parameters.
    pub effect: Effect<T>,
    /// Where it sits: all wheels of an effect of the robot.
    pub wheels: Wheels,
}

/// The effects that the controller undoes; [`Compensation::none`] undoes nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compensation<const N: usize, T = f32> {
    items: [Option<Undo<T>>; MOST_UNDONE],
}

/// Why an effect is not undone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotCompensable {
    /// It cannot be: its card says why.
    Effect(EffectKind),
    /// The wheel named is not there, or the effect is the robot's, or it needs a wheel and none is named.
    Wheel,
    /// The effect is undone on this wheel already.
    Twice,
    /// There are [`MOST_UNDONE`] already.
    Full,
}

impl NotCompensable {
    /// The reason, for a person.
    pub const fn reason(self) -> &'static str {
        match self {
            Self::Effect(kind) => kind.card().undone.words(),
            Self::Wheel => "the effect does not sit on the wheel named",
            Self::Twice => "the effect is undone on this wheel already",
            Self::Full => "the robot has no room for more effects to undo",
        }
    }
}

impl<const N: usize, T: Real> Default for Compensation<N, T> {
    fn default() -> Self {
        Self::none()
    }
}

impl<const N: usize, T: Real> Compensation<N, T> {
    /// Nothing is undone.
    pub fn none() -> Self {
        Self { items: [None; MOST_UNDONE] }
    }

    /// Undoes an effect too; `wheel` the only wheel that has it. Its parameters are within the bounds of its card: whoever
    /// reads them holds them to these.
    ///
    /// # Errors
    /// [`NotCompensable`] says why; what was undone stays.
    pub fn add(&mut self, effect: Effect<T>, wheel: Option<usize>) -> Result<(), NotCompensable> {
        let kind = effect.kind();
        if !kind.undone() {
            return Err(NotCompensable::Effect(kind));
        }
        if !kind.scope().admits(wheel, N) {
            return Err(NotCompensable::Wheel);
        }
        let wheels = Wheels(wheel.map(|wheel| wheel as u8));
        let meets = |other: &Undo<T>| (0..N).any(|j| other.wheels.contain(j) && wheels.contain(j));
        if self.iter().any(|other| other.effect.kind() == kind && meets(other)) {
            return Err(NotCompensable::Twice);
        }
        let room = self.items.iter_mut().find(|item| item.is_none()).ok_or(NotCompensable::Full)?;
        *room = Some(Undo { effect, wheels });
        Ok(())
    }

    /// All of them, in the order in which they were added.
    #[inline]
    pub fn iter(&self) -> impl Iterator<Item = &Undo<T>> {
        self.items.iter().map_while(Option::as_ref)
    }

    /// Those that act on a wheel.
    #[inline]
    pub fn on(&self, wheel: usize) -> impl Iterator<Item = &Undo<T>> {
        self.iter().filter(move |undo| undo.wheels.contain(wheel))
    }

    /// The same in signal order, which is that in which effects act at a place that they share.
    #[must_use]
    pub fn in_signal_order(&self) -> Self {
        let mut sorted = *self;
        let rank = |item: &Option<Undo<T>>| item.map_or(usize::MAX, |undo| undo.effect.kind() as usize);
        // the few that there are, each put before those that come after it
        for k in 1..MOST_UNDONE {
            let mut place = k;
            while place > 0 && rank(&sorted.items[place - 1]) > rank(&sorted.items[place]) {
                sorted.items.swap(place - 1, place);
                place -= 1;
            }
        }
        sorted
    }

    /// Those of a mask, whose bit k is the effect that was added k-th, the last one first: the way back.
    #[inline(always)]
    pub fn back_of(&self, mut mask: u32) -> impl Iterator<Item = &Undo<T>> {
        core::iter::from_fn(move || {
            if mask == 0 {
                return None;
            }
            let k = u32::BITS - 1 - mask.leading_zeros();
            mask &= !(1 << k);
            self.items.get(k as usize)?.as_ref()
        })
    }

    /// Those of a mask, in the order in which they were added.
    #[inline(always)]
    pub fn of(&self, mut mask: u32) -> impl Iterator<Item = &Undo<T>> {
        core::iter::from_fn(move || {
            if mask == 0 {
                return None;
            }
            let k = mask.trailing_zeros() as usize;
            mask &= mask - 1;
            self.items.get(k)?.as_ref()
        })
    }
}

#[cfg(test)]
mod tests;
