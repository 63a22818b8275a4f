//! # Active effects: those that a model carries, with their parameters and their place in the memory
//!
//! A model is a robot and a set of effects. The set has room for [`MAX_EFFECTS`], needs no allocation, and knows for
//! every seam which of its effects act there, so that a seam without effects costs nothing.

use core::marker::PhantomData;
use core::ops::Range;

use crate::effects::card::{Scope, Seam};
use crate::effects::{Effect, EffectKind, EffectSet};
use crate::number::scalar::Real;

/// The most effects that a robot undoes, and that its parameter block names.
pub const MOST_UNDONE: usize = 24;

/// The most effects that one model may carry: as many as a robot has, and those that a diagnosis adds.
pub const MAX_EFFECTS: usize = 28;

/// An effect in a model.
#[derive(Clone, Copy, Debug)]
pub struct ActiveEffect<E> {
    /// Which effect, with its parameters.
    pub effect: E,
    /// On which wheel alone; `None`: on all, or on the robot.
    pub wheel: Option<usize>,
    memory_at: usize,
    /// From one wheel's state to the next; zero where there is but one
    stride: usize,
    /// One where it remembers something
    memory_len: usize,
    /// True for an effect of the robot.
    whole: bool,
}

impl<E> ActiveEffect<E> {
    /// True if it sits on the robot as a whole, not on wheels.
    #[inline]
    pub fn whole(&self) -> bool {
        self.whole
    }

    /// True if it acts on this wheel.
    #[inline]
    pub fn on(&self, wheel: usize) -> bool {
        self.wheel.is_none_or(|w| w == wheel)
    }

    /// Where its state for this wheel stands in a run's memory; for an effect of the robot the wheel does not matter.
    #[inline]
    pub fn memory(&self, wheel: usize) -> Range<usize> {
        let start = self.memory_at + wheel * self.stride;
        start..start + self.memory_len
    }
}

/// Why an effect cannot join a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EffectError {
    /// There is no room for another; a model carries [`MAX_EFFECTS`] at most.
    Full,
    /// The wheel named is not there, or an effect of one wheel names none.
    Wheel,
    /// The number of parameters is not that of its card.
    Parameters,
}

/// The effects of a model: those of the catalogue, or others that somebody has written.
#[derive(Clone, Copy, Debug)]
pub struct Effects<const N: usize, T: Real, E: EffectSet<T> = Effect<T>> {
    items: [Option<ActiveEffect<E>>; MAX_EFFECTS],
    len: usize,
    memory: usize,
    at_seam: [u32; Seam::ALL.len()],
    on_wheel: [u32; N],
    with_memory: u32,
    needs_current: bool,
    number: PhantomData<T>,
}

impl<const N: usize, T: Real> Default for Effects<N, T> {
    /// No effect of the catalogue.
    fn default() -> Self {
        Self::none()
    }
}

impl<const N: usize, T: Real> Effects<N, T> {
    /// Adds an effect of the catalogue; `params` in its card's order.
    ///
    /// # Errors
    /// [`EffectError`] says why; the set is then as it was.
    pub fn add(&mut self, kind: EffectKind, wheel: Option<usize>, params: &[T]) -> Result<(), EffectError> {
        self.put(kind.with(params).ok_or(EffectError::Parameters)?, wheel)
    }
}

impl<const N: usize, T: Real, E: EffectSet<T>> Effects<N, T, E> {
    /// No effect.
    pub fn none() -> Self {
        Self {
            items: [None; MAX_EFFECTS],
            len: 0,
            memory: 0,
            at_seam: [0; Seam::ALL.len()],
            on_wheel: [0; N],
            with_memory: 0,
            needs_current: false,
            number: PhantomData,
        }
    }

    /// Adds an effect with its parameters.
    ///
    /// # Errors
    /// [`EffectError`] says why; the set is then as it was.
    pub fn put(&mut self, effect: E, wheel: Option<usize>) -> Result<(), EffectError> {
        let card = effect.card();
        if self.len == MAX_EFFECTS {
            return Err(EffectError::Full);
        }
        if !card.scope.admits(wheel, N) {
            return Err(EffectError::Wheel);
        }
        let remembers = usize::from(effect.start().is_some());
        let one = card.scope == Scope::Robot || wheel.is_some();
        let (blocks, stride) = if one { (1, 0) } else { (N, remembers) };
        self.items[self.len] = Some(ActiveEffect {
            effect,
            wheel,
            memory_at: self.memory,
            stride,
            memory_len: remembers,
            whole: card.scope == Scope::Robot,
        });
        self.memory += blocks * remembers;
        for seam in card.seams {
            self.at_seam[*seam as usize] |= 1 << self.len;
        }
        for j in (0..N).filter(|j| wheel.is_none_or(|w| w == *j)) {
            self.on_wheel[j] |= 1 << self.len;
        }
        if remembers > 0 {
            self.with_memory |= 1 << self.len;
        }
        self.needs_current |= card.needs_current;
        self.len += 1;
        Ok(())
    }

    /// How many states the effects keep together.
    pub fn memory_len(&self) -> usize {
        self.memory
    }

    /// The states that a run begins with: of every effect that remembers, one for each wheel that it sits on.
    pub fn memory(&self) -> impl Iterator<Item = E::State> {
        self.with_memory().flat_map(|active| {
            let wheels = if active.stride == 0 { 1 } else { N };
            (0..wheels).filter_map(|_| active.effect.start())
        })
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
    pub fn iter(&self) -> impl Iterator<Item = &ActiveEffect<E>> {
        self.items.iter().flatten()
    }

    /// Those at a seam.
    #[inline]
    pub fn at(&self, seam: Seam) -> impl Iterator<Item = &ActiveEffect<E>> {
        self.pick(self.at_seam[seam as usize])
    }

    /// Those at a seam, the last one first: the way back through it.
    #[inline]
    pub fn back_from(&self, seam: Seam) -> impl Iterator<Item = &ActiveEffect<E>> {
        self.take(self.at_seam[seam as usize], |mask| (u32::BITS - 1 - mask.leading_zeros()) as usize)
    }

    /// Those at a seam that act on a wheel.
    #[inline]
    pub fn on(&self, seam: Seam, wheel: usize) -> impl Iterator<Item = &ActiveEffect<E>> {
        self.pick(self.at_seam[seam as usize] & self.on_wheel[wheel])
    }

    /// True if no effect acts on this wheel at any of these seams.
    #[inline]
    pub fn none_on(&self, seams: &[Seam], wheel: usize) -> bool {
        seams.iter().all(|seam| self.at_seam[*seam as usize] & self.on_wheel[wheel] == 0)
    }

    /// Those that remember.
    #[inline]
    pub fn with_memory(&self) -> impl Iterator<Item = &ActiveEffect<E>> {
        self.pick(self.with_memory)
    }

    #[inline]
    fn pick(&self, mask: u32) -> impl Iterator<Item = &ActiveEffect<E>> {
        self.take(mask, |mask| mask.trailing_zeros() as usize)
    }

    /// Those of a mask, in the order in which `next` finds its bits.
    #[inline]
    fn take(&self, mut mask: u32, next: impl Fn(u32) -> usize) -> impl Iterator<Item = &ActiveEffect<E>> {
        core::iter::from_fn(move || {
            while mask != 0 {
                let k = next(mask);
                mask &= !(1 << k);
                if let Some(active) = self.items.get(k).and_then(Option::as_ref) {
                    return Some(active);
                }
            }
            None
        })
    }
}
