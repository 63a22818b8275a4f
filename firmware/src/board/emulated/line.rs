//! # Line: what several tasks share, one at a time

use core::cell::UnsafeCell;

/// Something that is only used with all interrupts masked.
pub struct Line<T>(UnsafeCell<T>);

// SAFETY: one core, and every use goes through `with`, which masks all interrupts.
unsafe impl<T> Sync for Line<T> {}

impl<T> Line<T> {
    /// To be shared.
    pub const fn new(shared: T) -> Self {
        Self(UnsafeCell::new(shared))
    }

    /// Uses it.
    pub fn with<R>(&self, f: impl FnOnce(&mut T) -> R) -> R {
        // SAFETY: interrupts are masked, so no other task runs, and `f` cannot come here again with the same line.
        cortex_m::interrupt::free(|_| f(unsafe { &mut *self.0.get() }))
    }
}
