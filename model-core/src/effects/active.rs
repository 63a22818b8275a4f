//! # Active effects: those that a model carries, with their parameters and their place in the memory
//!
//! A model is a robot and a set of effects. The set has room for [`MAX_EFFECTS`], needs no allocation, and knows for
//! every seam which of its effects act there, so that a seam without effects costs nothing.

use core::ops::Range;

use crate::effects::Effect;
use crate::effects::card::{MAX_PARAMS, Scope, Seam};
use crate::number::scalar::Real;

/// The most effects that one model may carry.
pub const MAX_EFFECTS: usize = 12;

/// An effect in a model.
#[derive(Clone, Copy)]
pub struct ActiveEffect<T: Real> {
    /// Which effect.
    pub effect: &'static dyn Effect<T>,
    /// On which wheel alone; `None`: on all, or on the robot.
    pub wheel: Option<usize>,
    params: [T; MAX_PARAMS],
    count: usize,
    memory_at: usize,
    /// Numbers of memory from one wheel's block to the next; zero where there is but one
    stride: usize,
    memory_len: usize,
    /// True for an effect of the robot.
    whole: bool,
}

impl<T: Real> core::fmt::Debug for ActiveEffect<T> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Active")
            .field("id", &self.effect.card().id)
            .field("wheel", &self.wheel)
            .field("params", &self.params())
            .finish()
    }
}

impl<T: Real> ActiveEffect<T> {
    /// The parameters, in the card's order.
    #[inline]
    pub fn params(&self) -> &[T] {
        &self.params[..self.count]
    }

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

    /// Its memory for this wheel; for an effect of the robot the wheel does not matter.
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

/// The effects of a model.
#[derive(Clone, Copy, Debug)]
pub struct Effects<const N: usize, T: Real> {
    items: [Option<ActiveEffect<T>>; MAX_EFFECTS],
    len: usize,
    memory: usize,
    at_seam: [u16; Seam::ALL.len()],
    on_wheel: [u16; N],
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
            on_wheel: [0; N],
            with_memory: 0,
            needs_current: false,
        }
    }
}

impl<const N: usize, T: Real> Effects<N, T> {
    /// Adds an effect; `params` in the card's order.
    ///
    /// # Errors
    /// [`EffectError`] says why; the set is then as it was.
    pub fn add(
        &mut self,
        effect: &'static dyn Effect<T>,
        wheel: Option<usize>,
        params: &[T],
    ) -> Result<(), EffectError> {
        let card = effect.card();
        if self.len == MAX_EFFECTS {
            return Err(EffectError::Full);
        }
        if !card.scope.admits(wheel, N) {
            return Err(EffectError::Wheel);
        }
        if params.len() != card.params.len() || params.len() > MAX_PARAMS {
            return Err(EffectError::Parameters);
        }
        let mut held = [T::zero(); MAX_PARAMS];
        held[..params.len()].copy_from_slice(params);
        let one = card.scope == Scope::Robot || wheel.is_some();
        let (blocks, stride) = if one { (1, 0) } else { (N, card.memory) };
        self.items[self.len] = Some(ActiveEffect {
            effect,
            wheel,
            params: held,
            count: params.len(),
            memory_at: self.memory,
            stride,
            memory_len: card.memory,
            whole: card.scope == Scope::Robot,
        });
        self.memory += blocks * card.memory;
        for seam in card.seams {
            self.at_seam[*seam as usize] |= 1 << self.len;
        }
        for j in (0..N).filter(|j| wheel.is_none_or(|w| w == *j)) {
            self.on_wheel[j] |= 1 << self.len;
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
    pub fn iter(&self) -> impl Iterator<Item = &ActiveEffect<T>> {
        self.pick((1 << self.len) - 1)
    }

    /// Those at a seam.
    #[inline]
    pub fn at(&self, seam: Seam) -> impl Iterator<Item = &ActiveEffect<T>> {
        self.pick(self.at_seam[seam as usize])
    }

    /// Those at a seam that act on a wheel.
    #[inline]
    pub fn on(&self, seam: Seam, wheel: usize) -> impl Iterator<Item = &ActiveEffect<T>> {
        self.pick(self.at_seam[seam as usize] & self.on_wheel[wheel])
    }

    /// True if no effect acts on this wheel at any of these seams.
    #[inline]
    pub fn none_on(&self, seams: &[Seam], wheel: usize) -> bool {
        seams.iter().all(|seam| self.at_seam[*seam as usize] & self.on_wheel[wheel] == 0)
    }

    /// Those that remember.
    #[inline]
    pub fn with_memory(&self) -> impl Iterator<Item = &ActiveEffect<T>> {
        self.pick(self.with_memory)
    }

    #[inline]
    fn pick(&self, mut mask: u16) -> impl Iterator<Item = &ActiveEffect<T>> {
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
