//! # Timer: a counter that goes up and down
//!
//! ```text
//! phase p = count on the way up, 2·ARR − count on the way down;   p goes round in 2·ARR counts
//! ```
//!
//! Source: RM0090, advanced-control and general-purpose timers: centre-aligned mode (overflow where the count reaches ARR,
//! underflow where it reaches 0), update event, preload registers, PWM mode, output compare flags in the three
//! centre-aligned modes, timer synchronisation (trigger mode). An input clock twice the bus where the bus is divided.

use super::map::{RCC, TIMERS};
use super::words::Words;

/// Offsets of registers.
pub mod at {
    /// Control
    pub const CR1: u32 = 0x00;
    /// Control, master mode
    pub const CR2: u32 = 0x04;
    /// Slave mode
    pub const SMCR: u32 = 0x08;
    /// Interrupt enable
    pub const DIER: u32 = 0x0C;
    /// Status
    pub const SR: u32 = 0x10;
    /// Event generation
    pub const EGR: u32 = 0x14;
    /// Capture/compare mode
    pub const CCMR1: u32 = 0x18;
    /// Capture/compare mode
    pub const CCMR2: u32 = 0x1C;
    /// Counter
    pub const CNT: u32 = 0x24;
    /// Auto-reload
    pub const ARR: u32 = 0x2C;
    /// Compare 1 to 4
    pub const CCR: u32 = 0x34;
    /// Break and dead time
    pub const BDTR: u32 = 0x44;
}

/// SR: update.
pub const UIF: u32 = 1;
/// SR: compare 4.
pub const CC4IF: u32 = 1 << 4;

/// Where a counter is of note.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Its count is zero
    Bottom,
    /// Going up, it is at the fourth compare count
    Fourth,
    /// Its count is ARR
    Top,
}

/// One timer.
#[derive(Clone, Copy, Debug)]
pub struct Timer {
    /// Address of its registers
    pub base: u32,
    /// It counts
    pub runs: bool,
    phase: u64,
    /// The core cycle of that phase
    since: u64,
    /// Core cycles a count
    cycles: u64,
    /// Auto-reload in force
    arr: u64,
    /// Compare counts in force
    pub compare: [u16; 4],
}

impl Timer {
    /// As the reset leaves it.
    pub fn new(motor: usize) -> Self {
        Self { base: TIMERS[motor], runs: false, phase: 0, since: 0, cycles: 1, arr: 0xFFFF, compare: [0; 4] }
    }

    /// Core cycles a count: HCLK over the timer's clock, which is twice the bus' where that is divided.
    fn cycles_a_count(&self, words: &Words) -> u64 {
        let shift = if self.base >= 0x4001_0000 { 13 } else { 10 };
        match words.field(RCC + 8, shift, 3) {
            code @ 4..=7 => 1 << (code - 4),
            _ => 1,
        }
    }

    /// Phase at a core cycle.
    fn phase_at(&self, now: u64) -> u64 {
        let gone = if self.runs { (now - self.since) / self.cycles } else { 0 };
        (self.phase + gone) % (2 * self.arr)
    }

    /// (count, counting down) at a core cycle.
    pub fn count(&self, now: u64) -> (u32, bool) {
        let phase = self.phase_at(now);
        let down = phase >= self.arr;
        ((if down { 2 * self.arr - phase } else { phase }) as u32, down)
    }

    /// The next place of note after `now`, and its core cycle.
    pub fn next(&self) -> Option<(u64, Place)> {
        if !self.runs {
            return None;
        }
        let round = 2 * self.arr;
        let fourth = u64::from(self.compare[3]);
        let places = [(0, Place::Bottom), (fourth, Place::Fourth), (self.arr, Place::Top)];
        let to = |phase: u64| (phase + round - self.phase + round - 1) % round + 1;
        places
            .into_iter()
            .filter(|(phase, place)| *place != Place::Fourth || (1..self.arr).contains(phase))
            .map(|(phase, place)| (self.since + self.cycles * to(phase), place))
            .min_by_key(|(at, _)| *at)
    }

    /// Moves the reckoning to a core cycle at which a count begins.
    pub fn settle(&mut self, now: u64) {
        self.phase = self.phase_at(now);
        self.since = now;
    }

    /// Begins to count.
    pub fn start(&mut self, now: u64, words: &Words) {
        self.cycles = self.cycles_a_count(words);
        self.since = now;
        self.runs = true;
    }

    /// Stands still.
    pub fn stop(&mut self, now: u64) {
        self.settle(now);
        self.runs = false;
    }

    /// The count is written.
    pub fn set_count(&mut self, now: u64, count: u32) {
        self.phase = u64::from(count);
        self.since = now;
    }

    /// Takes the preloaded registers into force.
    pub fn update(&mut self, words: &Words) {
        self.arr = u64::from(words.get(self.base + at::ARR)).max(1);
        self.compare = [0, 1, 2, 3].map(|channel| words.get(self.base + at::CCR + 4 * channel) as u16);
    }

    /// A register was written that may have to be taken into force at once.
    pub fn written(&mut self, words: &Words, offset: u32) {
        if offset == at::ARR && !words.bit(self.base + at::CR1, 7) {
            self.arr = u64::from(words.get(self.base + at::ARR)).max(1);
        }
        if let channel @ 0..=3 = offset.wrapping_sub(at::CCR) / 4
            && offset >= at::CCR
            && !self.preloaded(words, channel)
        {
            self.compare[channel as usize] = words.get(self.base + offset) as u16;
        }
    }

    /// True if a channel's compare register is preloaded.
    fn preloaded(&self, words: &Words, channel: u32) -> bool {
        words.bit(self.base + at::CCMR1 + 4 * (channel / 2), 3 + 8 * (channel % 2))
    }

    /// Compare counts of the three phases in force.
    pub fn phases(&self) -> [u16; 3] {
        let [a, b, c, _] = self.compare;
        [a, b, c]
    }

    /// True if compare flags rise on the way up.
    pub fn flags_up(&self, words: &Words) -> bool {
        matches!(words.field(self.base + at::CR1, 5, 2), 2 | 3)
    }

    /// True if the fourth channel's signal is the trigger output and rises where its count is reached going up.
    pub fn triggers(&self, words: &Words) -> bool {
        words.field(self.base + at::CR2, 4, 3) == 7 && words.field(self.base + at::CCMR2, 12, 3) == 7
    }

    /// True if it waits for TIM1's trigger to begin.
    pub fn waits(&self, words: &Words) -> bool {
        !self.runs && words.field(self.base + at::SMCR, 0, 3) == 6 && words.field(self.base + at::SMCR, 4, 3) == 0
    }
}
