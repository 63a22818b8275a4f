//! # Watchdog: it resets the chip when it is not fed in time, and a reset opens all bridges

use core::sync::atomic::{AtomicBool, Ordering};

use stm32f4xx_hal::pac;

use super::typed::{Get, Put};
use crate::registers::watchdog;
use crate::registers::words::Word;

/// The watchdog runs, and only a reset stops it.
static RUNNING: AtomicBool = AtomicBool::new(false);

/// The independent watchdog.
pub struct Watchdog {
    iwdg: pac::IWDG,
    restarted: bool,
}

impl Watchdog {
    /// The watchdog, not started; the clock controller says what the last reset came from, and then forgets it.
    pub(super) fn new(iwdg: pac::IWDG, rcc: &pac::rcc::RegisterBlock) -> Self {
        let restarted = rcc.csr().get().has(watchdog::IWDGRSTF);
        rcc.csr().put(rcc.csr().get() | watchdog::FORGET);
        Self { iwdg, restarted }
    }

    /// True if it was this watchdog that restarted the chip.
    pub fn restarted(&self) -> bool {
        self.restarted
    }

    /// Feeds the watchdog; the first time it is started.
    pub fn feed(&mut self) {
        if !RUNNING.load(Ordering::Relaxed) {
            self.iwdg.kr().put(watchdog::START);
            set_timeout(&self.iwdg, watchdog::PR, watchdog::RLR);
            RUNNING.store(true, Ordering::Relaxed);
        }
        self.iwdg.kr().put(watchdog::FEED);
    }
}

/// Gives a watchdog that runs the timeout of an erase, or its own again, and feeds it.
pub(super) fn extend_timeout(while_erasing: bool) {
    if !RUNNING.load(Ordering::Relaxed) {
        return;
    }
    // SAFETY: only the watchdog's settings are changed, with the keys the manual names; a feed by `Watchdog` in between
    // does no harm.
    let iwdg = unsafe { &*pac::IWDG::PTR };
    if while_erasing {
        set_timeout(iwdg, watchdog::PR_LONG, watchdog::RLR_LONG);
    } else {
        set_timeout(iwdg, watchdog::PR, watchdog::RLR);
    }
}

/// Sets after how long an unfed watchdog resets the chip, and feeds it.
fn set_timeout(iwdg: &pac::iwdg::RegisterBlock, pr: Word<watchdog::Pr>, rlr: Word<watchdog::Rlr>) {
    wait_for_update(iwdg);
    iwdg.kr().put(watchdog::OPEN);
    iwdg.pr().put(pr);
    iwdg.rlr().put(rlr);
    wait_for_update(iwdg);
    iwdg.kr().put(watchdog::FEED);
}

/// Waits until settings have arrived in the watchdog's clock domain: five of its cycles, 0.3 ms at most; and not for
/// ever.
fn wait_for_update(iwdg: &pac::iwdg::RegisterBlock) {
    for _ in 0..20_000 {
        if !iwdg.sr().get().has(watchdog::BUSY) {
            return;
        }
    }
}
