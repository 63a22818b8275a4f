//! # Watchdog: the independent one
//!
//! ```text
//! fed:      n = RLR + 1
//! running:  n falls by one in 4·2^PR / f_LSI, and at zero the chip is reset
//! ```
//!
//! Another prescaler counts on from where the count is; another reload counts from the next feed on.
//!
//! Source: RM0090, independent watchdog (keys, prescaler, reload, status flags for five cycles of its oscillator); DS8626,
//! LSI oscillator characteristics (32 kHz at best guess).

use super::map::IWDG;
use super::words::Words;
use crate::events::{Event, Log};

/// Core cycles of a cycle of the watchdog's oscillator, 32 kHz.
pub const LSI_CYCLE: u64 = 5_250;

/// Core cycles of one count.
fn count_cycles(words: &Words) -> u64 {
    (4 << words.field(IWDG + 4, 0, 3).min(6)) * LSI_CYCLE
}

/// The independent watchdog.
#[derive(Debug, Default)]
pub struct Watchdog {
    /// It runs
    pub runs: bool,
    open: bool,
    /// Its count n, and the core cycle in which it was that
    count: u64,
    since: u64,
    busy_until: u64,
}

impl Watchdog {
    /// The core cycle in which it resets the chip.
    pub fn next(&self, words: &Words) -> Option<u64> {
        self.runs.then(|| self.since + self.count * count_cycles(words))
    }

    fn feed(&mut self, now: u64, words: &Words) {
        (self.count, self.since) = (u64::from(words.get(IWDG + 8) & 0xFFF) + 1, now);
    }

    /// The key register is written.
    pub fn key(&mut self, now: u64, words: &Words, log: &mut Log, key: u32) {
        match key {
            0x5555 => self.open = true,
            0xAAAA => {
                self.open = false;
                self.feed(now, words);
                log.note(now, Event::Fed);
            }
            0xCCCC => {
                if !self.runs {
                    self.feed(now, words);
                }
                (self.runs, self.open) = (true, false);
            }
            _ => log.forbid(format!("the watchdog knows no key {key:#06x}")),
        }
    }

    /// Prescaler or reload is written; true if it takes it.
    pub fn setting(&mut self, now: u64, words: &Words, log: &mut Log) -> bool {
        if !self.open {
            log.forbid("the watchdog's settings are written while they are locked".into());
            return false;
        }
        self.count = self.count.saturating_sub((now - self.since) / count_cycles(words));
        self.since = now;
        self.busy_until = now + 5 * LSI_CYCLE;
        true
    }

    /// Its status register.
    pub fn status(&self, now: u64) -> u32 {
        if now < self.busy_until { 0b11 } else { 0 }
    }
}
