//! # Heartbeat: the watchdog is fed only if every task has been seen since it was fed last
//!
//! A watchdog that one task feeds proves that this task runs. So each task says that it is here, and the idle task
//! feeds when all have. Tasks of any priority may say so at any moment.

use core::sync::atomic::{AtomicU8, Ordering};

/// Who has to be alive.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Task {
    /// Currents, every period
    Current = 1,
    /// Motion, every 20th
    Motion = 2,
    /// Listens to the host
    Listen = 4,
    /// Sends the record
    Record = 8,
}

const ALL: u8 = Task::Current as u8 | Task::Motion as u8 | Task::Listen as u8 | Task::Record as u8;

/// Who has been seen since the watchdog was fed.
#[derive(Debug, Default)]
pub struct Heartbeats(AtomicU8);

impl Heartbeats {
    /// Nobody has been seen yet.
    pub const fn new() -> Self {
        Self(AtomicU8::new(0))
    }

    /// A task says that it is here.
    #[inline]
    pub fn beat(&self, task: Task) {
        self.0.fetch_or(task as u8, Ordering::Relaxed);
    }

    /// True if all have been seen since this was true last; then the roll begins anew.
    pub fn all_alive(&self) -> bool {
        self.0.compare_exchange(ALL, 0, Ordering::Relaxed, Ordering::Relaxed).is_ok()
    }
}
