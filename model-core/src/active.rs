//! # Active: the effects that a model carries, with their parameters and their place in the memory
//!
//! A model is a robot and a set of effects. The set has room for [`MAX_EFFECTS`], needs no allocation, and knows for
//! every seam which of its effects act there, so that a seam without effects costs nothing.

use core::ops::Range;

use crate::card::{MAX_PARAMS, Place, Seam};
use crate::effects::Effect;
use crate::scalar::Real;

/// The most effects that one model may carry.
pub const MAX_EFFECTS: usize = 12;

/// An effect in a model.
#[derive(Clone, Copy)]
pub struct Active<T: Real> {
    /// Which effect.
    pub effect: &'static dyn Effect<T>,
    /// On which wheel alone; `None`: on all, or on the robot.
    pub wheel: Option<usize>,
    params: [T; MAX_PARAMS],
    memory_at: usize,
}

impl<T: Real> core::fmt::Debug for Active<T> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Active")
            .field("id", &self.effect.card().id)
            .field("wheel", &self.wheel)
            .field("params", &self.params())
            .finish()
    }
}

impl<T: Real> Active<T> {
    /// The parameters, in the card's order.
    #[inline]
    pub fn params(&self) -> &[T] {
        &self.params[..self.effect.card().params.len()]
    }

    /// True if it acts on this wheel.
    #[inline]
    pub fn on(&self, wheel: usize) -> bool {
        self.wheel.is_none_or(|w| w == wheel)
    }

    /// Its memory for this wheel; for an effect of the robot the wheel does not matter.
    #[inline]
    pub fn memory(&self, wheel: usize) -> Range<usize> {
        let card = self.effect.card();
        let block = if card.place == Place::Robot || self.wheel.is_some() { 0 } else { wheel };
        let start = self.memory_at + block * card.memory;
        start..start + card.memory
    }
}

/// Why an effect cannot join a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refused {
    /// There is no room for another; a model carries [`MAX_EFFECTS`] at most.
    Full,
    /// The wheel named is not there, or an effect of one wheel names none.
    Wheel,
    /// The number of parameters is not that of its card.
    Parameters,
}

/// The effects of a model.
#[derive(Clone, Copy, Debug)]
pub struct Effects<const N: usize, T: Real> {
    items: [Option<Active<T>>; MAX_EFFECTS],
    len: usize,
    memory: usize,
    at_seam: [u16; Seam::ALL.len()],
    with_memory: u16,
    needs_current: bool,
}

impl<const N: usize, T: Real> Default for Effects<N, T> {
    fn default() -> Self {
        Self {
            items: [None; MAX_EFFECTS],
            len: 0,
            memory: 0,
            at_seam: [0; Seam::ALL.len()],
            with_memory: 0,
            needs_current: false,
        }
    }
}

impl<const N: usize, T: Real> Effects<N, T> {
    /// Adds an effect; `params` in the card's order.
    ///
    /// # Errors
    /// [`Refused`] says why; the set is then as it was.
    pub fn add(&mut self, effect: &'static dyn Effect<T>, wheel: Option<usize>, params: &[T]) -> Result<(), Refused> {
        let card = effect.card();
        if self.len == MAX_EFFECTS {
            return Err(Refused::Full);
        }
        if wheel.is_some_and(|w| w >= N || card.place == Place::Robot)
            || (wheel.is_none() && card.place == Place::OneWheel)
        {
            return Err(Refused::Wheel);
        }
        if params.len() != card.params.len() || params.len() > MAX_PARAMS {
            return Err(Refused::Parameters);
        }
        let mut held = [T::zero(); MAX_PARAMS];
        held[..params.len()].copy_from_slice(params);
        self.items[self.len] = Some(Active { effect, wheel, params: held, memory_at: self.memory });
        let blocks = if card.place == Place::Robot || wheel.is_some() { 1 } else { N };
        self.memory += blocks * card.memory;
        for seam in card.seams {
            self.at_seam[*seam as usize] |= 1 << self.len;
        }
        if card.memory > 0 {
            self.with_memory |= 1 << self.len;
        }
        self.needs_current |= card.needs_current;
        self.len += 1;
        Ok(())
    }

    /// How many numbers of memory the effects keep together.
    pub fn memory_len(&self) -> usize {
        self.memory
    }

    /// True if there is none.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// True if an effect looks at the current at the drive or winding seam, so that it has to be solved for.
    #[inline]
    pub fn needs_current(&self) -> bool {
        self.needs_current
    }

    /// True if no effect acts at this seam.
    #[inline]
    pub fn none_at(&self, seam: Seam) -> bool {
        self.at_seam[seam as usize] == 0
    }

    /// All of them, in the order in which they were added.
    pub fn iter(&self) -> impl Iterator<Item = &Active<T>> {
        self.pick((1 << self.len) - 1)
    }

    /// Those at a seam.
    #[inline]
    pub fn at(&self, seam: Seam) -> impl Iterator<Item = &Active<T>> {
        self.pick(self.at_seam[seam as usize])
    }

    /// Those that remember.
    #[inline]
    pub fn with_memory(&self) -> impl Iterator<Item = &Active<T>> {
        self.pick(self.with_memory)
    }

    #[inline]
    fn pick(&self, mut mask: u16) -> impl Iterator<Item = &Active<T>> {
        core::iter::from_fn(move || {
            while mask != 0 {
                let k = mask.trailing_zeros() as usize;
                mask &= mask - 1;
                if let Some(active) = self.items.get(k).and_then(Option::as_ref) {
                    return Some(active);
                }
            }
            None
        })
    }
}
