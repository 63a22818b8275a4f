//! # Watchdog: it resets the chip when it is not fed in time, and a reset opens all bridges

use core::sync::atomic::{AtomicBool, Ordering};

use stm32f4xx_hal::pac;

use crate::registers::watchdog;

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
        let restarted = rcc.csr().read().bits() & watchdog::RESTARTED != 0;
        // SAFETY: the bit that forgets, added to what stands there.
        rcc.csr().modify(|r, w| unsafe { w.bits(r.bits() | watchdog::FORGET) });
        Self { iwdg, restarted }
    }

    /// True if it was this watchdog that restarted the chip.
    pub fn restarted(&self) -> bool {
        self.restarted
    }

    /// Feeds the watchdog; the first time it is started.
    pub fn feed(&mut self) {
        if !RUNNING.load(Ordering::Relaxed) {
            write_key(&self.iwdg, watchdog::START);
            set_timeout(&self.iwdg, watchdog::PR, watchdog::RLR);
            RUNNING.store(true, Ordering::Relaxed);
        }
        write_key(&self.iwdg, watchdog::FEED);
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

fn write_key(iwdg: &pac::iwdg::RegisterBlock, key: u16) {
    // SAFETY: the keys are those that the manual names.
    unsafe { iwdg.kr().write(|w| w.bits(key)) };
}

/// Sets after how long an unfed watchdog resets the chip, and feeds it.
fn set_timeout(iwdg: &pac::iwdg::RegisterBlock, pr: u16, rlr: u16) {
    wait_for_update(iwdg);
    write_key(iwdg, watchdog::OPEN);
    // SAFETY: both fit their fields, and they are open for writing.
    unsafe {
        iwdg.pr().write(|w| w.bits(pr));
        iwdg.rlr().write(|w| w.bits(rlr));
    }
    wait_for_update(iwdg);
    write_key(iwdg, watchdog::FEED);
}

/// Waits until settings have arrived in the watchdog's clock domain: five of its cycles, 0.3 ms at most; and not for
/// ever.
fn wait_for_update(iwdg: &pac::iwdg::RegisterBlock) {
    for _ in 0..20_000 {
        if iwdg.sr().read().bits() & watchdog::BUSY == 0 {
            return;
        }
    }
}
