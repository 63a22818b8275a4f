//! # Flash store: the parameter block in flash sectors 10 and 11, the last two
//!
//! The chip has one flash bank: while a sector is erased (up to 4 s) the core stands still at its next fetch, and
//! neither controls nor feeds. So a block is only stored while all bridges are open, and the watchdog gets a long
//! timeout first.

use embedded_storage::nor_flash::{ErrorType, ReadNorFlash};
use stm32f4xx_hal::flash::FlashExt;
use stm32f4xx_hal::pac;

use super::bridges::any_closed;
use super::watchdog;
use crate::drivers::flash_slots::{self, Slot};

/// Where the flash is in memory.
const FLASH_AT: usize = 0x0800_0000;
/// Its length [bytes].
const FLASH_LEN: usize = 1 << 20;
/// Sectors 10 and 11, 128 KiB each; the image is in front of them (`memory.x`).
const SLOTS: [Slot; 2] = [Slot { from: 0xC_0000, to: 0xE_0000 }, Slot { from: 0xE_0000, to: 0x10_0000 }];

/// Where the parameter block is stored.
pub struct FlashStore {
    flash: pac::FLASH,
}

impl FlashStore {
    pub(super) fn new(flash: pac::FLASH) -> Self {
        Self { flash }
    }

    /// The stored block; empty if there is none.
    pub fn load(&self) -> &'static [u8] {
        let block = flash_slots::find(&mut Mapped, &SLOTS)
            .and_then(|stored| Mapped::bytes().get(stored.at as usize..stored.at as usize + stored.len));
        block.unwrap_or(&[])
    }

    /// Stores a block; true if it is stored. Refused unless all bridges are open. Takes seconds, in which nothing else
    /// runs: periods are missed.
    pub fn save(&mut self, block: &[u8]) -> bool {
        if any_closed() {
            return false;
        }
        watchdog::extend_timeout(true);
        // errors that a debugger left behind would count as ours; SAFETY: ones clear the error flags, all others are
        // read-only
        unsafe { self.flash.sr().write(|w| w.bits(0xF2)) };
        let stored = flash_slots::save(&mut self.flash.unlocked(), &SLOTS, block).is_ok();
        self.forget_caches();
        watchdog::extend_timeout(false);
        stored && self.load() == block
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
        // SAFETY: the flash is mapped there, a mebibyte on the STM32F405VG, and any byte of it is a `u8`. It only
        // changes within `save`, which has `FlashStore` exclusively; a block of `load` that is still held shows the
        // slot that `save` leaves alone.
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
