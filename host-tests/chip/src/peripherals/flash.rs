//! # Flash: the interface that erases and programs, and the sectors behind the image
//!
//! Programming only clears bits. While the flash works, a core that fetches from it stands still: the time goes by, and no
//! instruction is executed.
//!
//! Sources: RM0090, embedded flash (keys, erase and program sequence, registers, sectors of 16, 64 and 128 KiB); DS8626,
//! flash memory characteristics: at most 4 s for a sector of 128 KiB by bytes, 100 µs for a byte or word.

use super::map::FLASH;
use super::words::Words;
use crate::events::{Event, Log};

/// Bytes of the flash.
pub const LEN: usize = 1 << 20;
/// Bytes of a large sector.
pub const SECTOR: usize = 0x2_0000;

const SR: u32 = FLASH + 0x0C;
const CR: u32 = FLASH + 0x10;
const LOCK: u32 = 1 << 31;
const STRT: u32 = 1 << 16;
const EOP: u32 = 1;
/// Longest time of an erase by bytes [core cycles], 4 s.
pub const LONGEST_ERASE: u64 = 4 * 168_000_000;
/// Longest time to program once [core cycles], 100 µs.
const PROGRAM: u64 = 16_800;

/// Sector of 128 KiB: offset of its first byte.
fn sector(number: u32) -> Option<usize> {
    (5..12).contains(&number).then(|| (number as usize - 4) * SECTOR)
}

/// The flash.
#[derive(Debug)]
pub struct Flash {
    /// What it holds
    pub bytes: Vec<u8>,
    /// Bytes at its beginning that hold the image, and are not written
    pub image: usize,
    keys: u8,
    /// How long an erase takes [core cycles]
    pub erase: u64,
    /// Core cycles for which the core is to stand still
    pub stalls: u64,
}

impl Flash {
    /// Erased.
    pub fn erased() -> Self {
        Self { bytes: vec![0xFF; LEN], image: 0, keys: 0, erase: LONGEST_ERASE, stalls: 0 }
    }

    /// A key is written.
    pub fn key(&mut self, words: &mut Words, key: u32) {
        self.keys = match (self.keys, key) {
            (0, 0x4567_0123) => 1,
            (1, 0xCDEF_89AB) => {
                words.clear(CR, LOCK);
                0
            }
            _ => 2,
        };
    }

    /// The control register is written.
    pub fn control(&mut self, now: u64, words: &mut Words, log: &mut Log, was: u32, word: u32) {
        if was & LOCK != 0 {
            return log.forbid("the flash is told to work while it is locked".into());
        }
        words.set(CR, word & !STRT);
        if word & STRT == 0 || word & 2 == 0 {
            return;
        }
        let number = word >> 3 & 0xF;
        match sector(number).filter(|from| *from >= self.image) {
            Some(from) => self.bytes[from..from + SECTOR].fill(0xFF),
            None => log.forbid(format!("sector {number} holds the image and is erased")),
        }
        self.stalls += self.erase;
        words.raise(SR, EOP);
        log.note(now, Event::Erased { sector: number as u8 });
    }

    /// Bytes of the flash are written.
    pub fn program(&mut self, words: &mut Words, log: &mut Log, offset: usize, size: usize, value: u64) {
        let wide = 1 << words.field(CR, 8, 2);
        if !words.bit(CR, 0) || words.bit(CR, 31) || wide != size || offset < self.image {
            return log.forbid(format!("{size} bytes of the flash are written, not as its control register says"));
        }
        for (byte, new) in self.bytes[offset..offset + size].iter_mut().zip(value.to_le_bytes()) {
            *byte &= new;
        }
        self.stalls += PROGRAM;
        words.raise(SR, EOP);
    }

    /// What stands there.
    pub fn read(&self, offset: usize, size: usize) -> u64 {
        self.bytes[offset..offset + size].iter().rev().fold(0, |word, byte| word << 8 | u64::from(*byte))
    }
}
