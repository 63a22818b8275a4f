//! # Load: how much of its time the current turn takes, and how evenly it comes
//!
//! ```text
//! load   = cycles of the turn / cycles of a period
//! jitter = |cycles from the beginning of the period to the turn − the same in the first turn|
//! ```

use firmware::board::CYCLES_PER_PERIOD;

/// The worst since the last motion turn.
#[derive(Clone, Copy, Debug, Default)]
pub struct Load {
    spent: u32,
    jitter: u32,
    first: Option<u32>,
    motion_runs: bool,
}

impl Load {
    /// Takes note of a current turn; true if a motion turn is due and the last one still runs.
    #[inline]
    pub fn current(&mut self, entered: u32, spent: u32, motion_due: bool) -> bool {
        self.spent = self.spent.max(spent);
        let first = *self.first.get_or_insert(entered);
        // both are counted from the beginning of a period; a turn may come before the place of the first one too
        let apart = (entered + CYCLES_PER_PERIOD - first) % CYCLES_PER_PERIOD;
        self.jitter = self.jitter.max(apart.min(CYCLES_PER_PERIOD - apart));
        let overrun = motion_due && self.motion_runs;
        self.motion_runs |= motion_due;
        overrun
    }

    /// The motion turn is over: (load [‰], jitter [cycles]) of the current turns since the last.
    pub fn motion(&mut self) -> (u16, u16) {
        let worst = (self.spent * 1000 / CYCLES_PER_PERIOD, self.jitter);
        *self = Self { first: self.first, ..Self::default() };
        (worst.0.min(0xffff) as u16, worst.1.min(0xffff) as u16)
    }
}
