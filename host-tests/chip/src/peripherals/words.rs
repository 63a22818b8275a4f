//! # Words: what stands in the registers

use super::map::{PERIPHERALS, PERIPHERALS_LEN};

/// The words of all peripherals, by address.
#[derive(Debug)]
pub struct Words {
    held: Vec<u32>,
}

impl Words {
    /// All zero.
    pub fn zero() -> Self {
        Self { held: vec![0; (PERIPHERALS_LEN / 4) as usize] }
    }

    fn at(address: u32) -> usize {
        (address - PERIPHERALS) as usize / 4
    }

    /// The word at an address.
    pub fn get(&self, address: u32) -> u32 {
        self.held[Self::at(address)]
    }

    /// Puts a word at an address.
    pub fn set(&mut self, address: u32, word: u32) {
        self.held[Self::at(address)] = word;
    }

    /// A field of a word.
    pub fn field(&self, address: u32, shift: u32, width: u32) -> u32 {
        self.get(address) >> shift & ((1 << width) - 1)
    }

    /// True if a bit is set.
    pub fn bit(&self, address: u32, bit: u32) -> bool {
        self.field(address, bit, 1) != 0
    }

    /// Sets bits.
    pub fn raise(&mut self, address: u32, bits: u32) {
        self.set(address, self.get(address) | bits);
    }

    /// Clears bits.
    pub fn clear(&mut self, address: u32, bits: u32) {
        self.set(address, self.get(address) & !bits);
    }
}
