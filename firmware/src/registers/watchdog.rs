//! # Watchdog: the independent one of the chip
//!
//! It counts its own oscillator, which is 32 kHz at best guess and 17 to 47 kHz by the datasheet (DS8626, LSI
//! oscillator characteristics). At the fast end it must not fire before 10 ms, ten motion turns; at the slow end it
//! then fires after 30 ms.
//!
//! Erasing a flash sector stalls the core for seconds, so the watchdog is given a long timeout before ([`PR_LONG`]).
//! What a reset came from is kept by the clock controller until it is told to forget ([`IWDGRSTF`], [`FORGET`]).
//! Source: RM0090, independent watchdog; RCC clock control and status register.

use super::words::{Field, Word};

/// Key register
pub enum Kr {}
/// Prescaler register
pub enum Pr {}
/// Reload register
pub enum Rlr {}
/// Status register
pub enum Sr {}
/// Clock control register of the clock controller
pub enum RccCr {}
/// Clock control and status register of the clock controller
pub enum RccCsr {}

const KEY: Field<Kr> = Field::at(0, 16);
/// KR: feed.
pub const FEED: Word<Kr> = Word::ZERO.with(KEY, 0xAAAA);
/// KR: open PR and RLR for writing.
pub const OPEN: Word<Kr> = Word::ZERO.with(KEY, 0x5555);
/// KR: start it; nothing but a reset stops it.
pub const START: Word<Kr> = Word::ZERO.with(KEY, 0xCCCC);

/// SR, PVU and RVU: PR or RLR is still on its way into the watchdog's clock domain.
pub const BUSY: Field<Sr> = Field::at(0, 2);

/// RCC CSR: this watchdog has reset the chip.
pub const IWDGRSTF: Field<RccCsr> = Field::at(29, 1);
const RMVF: Field<RccCsr> = Field::at(24, 1);
/// RCC CSR, added: forget what the reset came from, and leave the oscillator as it is.
pub const FORGET: Word<RccCsr> = Word::ZERO.with(RMVF, 1);

/// RCC CR: the clock security system watches the crystal.
pub const CSSON: Field<RccCr> = Field::at(19, 1);
/// RCC CR, added: where the crystal stops, a non-maskable interrupt comes.
pub const CLOCK_SECURITY: Word<RccCr> = Word::ZERO.with(CSSON, 1);

const DIVIDER: Field<Pr> = Field::at(0, 3);
const RELOAD: Field<Rlr> = Field::at(0, 12);
/// PR: oscillator by 4.
pub const PR: Word<Pr> = Word::ZERO.with(DIVIDER, 0);
/// RLR: 128 counts.
pub const RLR: Word<Rlr> = Word::ZERO.with(RELOAD, 127);
/// PR for the time of an erase: oscillator by 128.
pub const PR_LONG: Word<Pr> = Word::ZERO.with(DIVIDER, 5);
/// RLR for the time of an erase.
pub const RLR_LONG: Word<Rlr> = Word::ZERO.with(RELOAD, 0xFFF);

/// After how long an unfed watchdog resets the chip [µs], for an oscillator [Hz].
pub const fn timeout_us(pr: Word<Pr>, rlr: Word<Rlr>, oscillator: u32) -> u32 {
    ((rlr.bits() as u64 + 1) * (4 << pr.bits()) * 1_000_000 / oscillator as u64) as u32
}
