//! # Keep: the watchdog, and the parameter block in flash sectors 5 and 6
//!
//! The chip has one flash bank: while a sector is erased (up to 4 s) the core stands still at its next fetch, and
//! neither controls nor feeds. So a block is only kept while all bridges are open, and the dog gets a long meal first.

use core::sync::atomic::{AtomicBool, Ordering};

use embedded_storage::nor_flash::{ErrorType, ReadNorFlash};
use stm32f4xx_hal::flash::FlashExt;
use stm32f4xx_hal::pac;

use super::bridges::any_closed;
use crate::drivers::store::{self, Slot};
use crate::registers::dog;

/// Where the flash is in memory.
const FLASH_AT: usize = 0x0800_0000;
/// Its length [bytes].
const FLASH_LEN: usize = 1 << 20;
/// Sectors 5 and 6, 128 KiB each; the image is in front of them (`memory.x`).
const SLOTS: [Slot; 2] = [Slot { from: 0x2_0000, to: 0x4_0000 }, Slot { from: 0x4_0000, to: 0x6_0000 }];

/// The dog is out, and only a reset calls it back.
static OUT: AtomicBool = AtomicBool::new(false);

/// The watchdog: it bites by a reset, which opens all bridges.
pub struct Dog {
    iwdg: pac::IWDG,
}

impl Dog {
    pub(super) fn new(iwdg: pac::IWDG) -> Self {
        Self { iwdg }
    }

    /// Feeds the dog; the first time it is let out.
    pub fn feed(&mut self) {
        if !OUT.load(Ordering::Relaxed) {
            key(&self.iwdg, dog::START);
            meal(&self.iwdg, dog::PR, dog::RLR);
            OUT.store(true, Ordering::Relaxed);
        }
        key(&self.iwdg, dog::FEED);
    }
}

fn key(iwdg: &pac::iwdg::RegisterBlock, key: u16) {
    // SAFETY: the keys are those that the manual names.
    unsafe { iwdg.kr().write(|w| w.bits(key)) };
}

/// Sets how long a meal lasts, and feeds.
fn meal(iwdg: &pac::iwdg::RegisterBlock, pr: u16, rlr: u16) {
    arrived(iwdg);
    key(iwdg, dog::OPEN);
    // SAFETY: both fit their fields, and they are open for writing.
    unsafe {
        iwdg.pr().write(|w| w.bits(pr));
        iwdg.rlr().write(|w| w.bits(rlr));
    }
    arrived(iwdg);
    key(iwdg, dog::FEED);
}

/// Waits until settings have arrived in the dog's clock domain: five of its cycles, 0.3 ms at most; and not for ever.
fn arrived(iwdg: &pac::iwdg::RegisterBlock) {
    for _ in 0..20_000 {
        if iwdg.sr().read().bits() & dog::BUSY == 0 {
            return;
        }
    }
}

/// Where the parameter block is kept.
pub struct Store {
    flash: pac::FLASH,
}

impl Store {
    pub(super) fn new(flash: pac::FLASH) -> Self {
        Self { flash }
    }

    /// The block that was kept; empty if there is none.
    pub fn load(&self) -> &'static [u8] {
        let block = store::find(&mut Mapped, &SLOTS)
            .and_then(|kept| Mapped::bytes().get(kept.at as usize..kept.at as usize + kept.len));
        block.unwrap_or(&[])
    }

    /// Keeps a block; true if it is kept. Refused unless all bridges are open. Takes seconds, in which nothing else
    /// runs: periods are missed.
    pub fn save(&mut self, block: &[u8]) -> bool {
        if any_closed() {
            return false;
        }
        // SAFETY: only the dog's settings are changed, with the keys the manual names; a feed by `Dog` in between does
        // no harm.
        let iwdg = unsafe { &*pac::IWDG::PTR };
        let out = OUT.load(Ordering::Relaxed);
        if out {
            meal(iwdg, dog::PR_LONG, dog::RLR_LONG);
        }
        // errors that a debugger left behind would count as ours; SAFETY: ones clear the error flags, all others are
        // read-only
        unsafe { self.flash.sr().write(|w| w.bits(0xF2)) };
        let kept = store::keep(&mut self.flash.unlocked(), &SLOTS, block).is_ok();
        self.forget_caches();
        if out {
            meal(iwdg, dog::PR, dog::RLR);
        }
        kept && self.load() == block
    }

    /// Empties the caches of the flash, which do not see what was erased and written.
    fn forget_caches(&mut self) {
        self.flash.acr().modify(|_, w| w.icen().clear_bit().dcen().clear_bit());
        self.flash.acr().modify(|_, w| w.icrst().set_bit().dcrst().set_bit());
        self.flash.acr().modify(|_, w| w.icrst().clear_bit().dcrst().clear_bit());
        self.flash.acr().modify(|_, w| w.icen().set_bit().dcen().set_bit());
    }
}

/// The flash as it appears in memory.
struct Mapped;

impl Mapped {
    fn bytes() -> &'static [u8] {
        // SAFETY: the flash is mapped there, a mebibyte on the STM32F405RG, and any byte of it is a `u8`. It only
        // changes within `save`, which has `Store` exclusively; a block of `load` that is still held shows the slot
        // that `save` leaves alone.
        unsafe { core::slice::from_raw_parts(FLASH_AT as *const u8, FLASH_LEN) }
    }
}

impl ErrorType for Mapped {
    type Error = embedded_storage::nor_flash::NorFlashErrorKind;
}

impl ReadNorFlash for Mapped {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Self::Error> {
        let from = offset as usize;
        let part = Self::bytes().get(from..from + bytes.len());
        bytes.copy_from_slice(part.ok_or(embedded_storage::nor_flash::NorFlashErrorKind::OutOfBounds)?);
        Ok(())
    }

    fn capacity(&self) -> usize {
        FLASH_LEN
    }
}
