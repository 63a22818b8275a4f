//! # Pace: how time goes by while instructions are executed
//!
//! ```text
//! constant:  t ← t + c                                     whichever the instruction
//! manual:    t ← t + cycles + refill + flash + bus         as long as the manuals say at most
//! ```
//!
//! | part | |
//! |---|---|
//! | cycles, refill | of the core: [`cycles`](super::cycles) |
//! | flash | wait states of lines that are not kept: [`flash_reads`](super::flash_reads) |
//! | bus | an access to APB takes two cycles of that bus and one to meet its clock: 3 × 4 core cycles on APB1, 3 × 2 on APB2 |
//!
//! The second is a bound: each part is the manual's largest, and none hides behind another, as stores do in the core's buffer.
//!
//! Source: RM0090, memory map and clock tree as the board sets it (42 and 84 MHz); AMBA APB, a setup and an access cycle.

use super::cycles::{REFILL, cycles, is_long};
use super::flash_reads::FlashReads;

/// How time goes by.
#[derive(Clone, Debug)]
pub enum Pace {
    /// An instruction takes so many quarter core cycles, whichever it is
    Constant(u64),
    /// As long as the manuals say at most
    Manual(FlashReads),
}

impl Pace {
    /// Six quarters: one and a half core cycles an instruction.
    pub const USUAL: Self = Self::Constant(6);

    /// As long as the manuals say at most, nothing read of the flash yet.
    pub fn manual() -> Self {
        Self::Manual(FlashReads::default())
    }

    /// Quarter core cycles of an instruction at an address, which another one than the one before it led to or not.
    /// `now` is the core cycle.
    pub(super) fn instruction(&mut self, now: u64, address: u32, [first, second]: [u16; 2], jumped: bool) -> u64 {
        match self {
            Self::Constant(quarters) => *quarters,
            Self::Manual(reads) => {
                let refill = if jumped { REFILL } else { 0 };
                let length = if is_long(first) { 4 } else { 2 };
                4 * u64::from(cycles(first, second) + refill + reads.fetch(now, address, length))
            }
        }
    }

    /// The same that a load of the flash adds.
    pub(super) fn load(&mut self, address: u32) -> u64 {
        match self {
            Self::Constant(_) => 0,
            Self::Manual(reads) => 4 * u64::from(reads.load(address)),
        }
    }

    /// The same that an access to a peripheral adds.
    pub(super) fn access(&self, address: u32) -> u64 {
        match (self, address >> 16) {
            (Self::Constant(_), _) => 0,
            (Self::Manual(_), 0x4000) => 4 * 3 * 4,
            (Self::Manual(_), 0x4001) => 4 * 3 * 2,
            (Self::Manual(_), _) => 0,
        }
    }
}
