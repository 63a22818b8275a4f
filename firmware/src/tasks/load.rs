//! # Load: how much of its time the current turn takes, and how evenly it comes
//!
//! ```text
//! load   = cycles of the turn / cycles of a period
//! jitter = |cycles from the beginning of the period to the turn − the same in the first turn|
//! ```

use firmware::board::CYCLES_PER_PERIOD;

/// The worst since the last motion turn.
#[derive(Clone, Copy, Debug)]
pub struct Load {
    spent: u32,
    jitter: u32,
    first: Option<u32>,
    motion_runs: bool,
    /// The core stood still since the last current turn
    stood: bool,
}

impl Default for Load {
    /// Nothing yet; the first turn may come at any time, as after the core stood still.
    fn default() -> Self {
        Self { spent: 0, jitter: 0, first: None, motion_runs: false, stood: true }
    }
}

impl Load {
    /// Takes note of a current turn, which was late for its period or not; true if that is a fault, or if a motion turn is
    /// due and the last one still runs.
    #[inline]
    pub fn current(&mut self, entered: u32, spent: u32, late: bool, motion_due: bool) -> bool {
        if core::mem::take(&mut self.stood) {
            // it began wherever in a period the core went on
            self.motion_runs |= motion_due;
            return false;
        }
        self.spent = self.spent.max(spent);
        let first = *self.first.get_or_insert(entered);
        // both are counted from the beginning of a period; a turn may come before the place of the first one too
        let apart = (entered + CYCLES_PER_PERIOD - first) % CYCLES_PER_PERIOD;
        self.jitter = self.jitter.max(apart.min(CYCLES_PER_PERIOD - apart));
        let overrun = late || (motion_due && self.motion_runs);
        self.motion_runs |= motion_due;
        overrun
    }

    /// The core has stood still for the flash: the next turn may come at any time.
    pub fn stand(&mut self) {
        self.stood = true;
    }

    /// The motion turn is over: (load [‰], jitter [cycles]) of the current turns since the last.
    pub fn motion(&mut self) -> (u16, u16) {
        let worst = (self.spent * 1000 / CYCLES_PER_PERIOD, self.jitter);
        *self = Self { first: self.first, stood: self.stood, ..Self::default() };
        (worst.0.min(0xffff) as u16, worst.1.min(0xffff) as u16)
    }
}
