//! How much work free runs were: what bounds the time that an answer takes.

use std::sync::atomic::{AtomicU64, Ordering};

static STEPS: AtomicU64 = AtomicU64::new(0);

/// Steps that plants were taken along recordings since the program began, all threads together.
///
/// What a diagnosis adds to it divided by the steps of one pass over its session is the number of its model runs.
pub fn steps_taken() -> u64 {
    STEPS.load(Ordering::Relaxed)
}

/// Adds steps; once for many rows, so that it costs nothing.
pub(super) fn note(steps: u64) {
    STEPS.fetch_add(steps, Ordering::Relaxed);
}
