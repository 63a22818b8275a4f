//! # Watchdog: the independent one of the chip
//!
//! It counts its own oscillator, which is 32 kHz at best guess and 17 to 47 kHz by the datasheet (DS8626, LSI
//! oscillator characteristics). At the fast end it must not fire before 10 ms, ten motion turns; at the slow end it
//! then fires after 30 ms.
//!
//! Erasing a flash sector stalls the core for seconds, so the watchdog is given a long timeout before ([`PR_LONG`]).
//! What a reset came from is kept by the clock controller until it is told to forget ([`RESTARTED`], [`FORGET`]).
//! Source: RM0090, independent watchdog; RCC clock control and status register.

/// KR: feed.
pub const FEED: u16 = 0xAAAA;
/// KR: open PR and RLR for writing.
pub const OPEN: u16 = 0x5555;
/// KR: start it; nothing but a reset stops it.
pub const START: u16 = 0xCCCC;
/// SR: PR or RLR is still on its way into the watchdog's clock domain.
pub const BUSY: u16 = 0b11;

/// RCC CSR: this watchdog has reset the chip (IWDGRSTF).
pub const RESTARTED: u32 = 1 << 29;
/// RCC CSR: forget what the reset came from (RMVF), and leave the oscillator as it is.
pub const FORGET: u32 = 1 << 24;
/// RCC CR: the clock security system watches the crystal; where it stops, a non-maskable interrupt comes (CSSON).
pub const CLOCK_SECURITY: u32 = 1 << 19;

/// PR: oscillator by 4.
pub const PR: u16 = 0;
/// RLR: 128 counts.
pub const RLR: u16 = 127;
/// PR for the time of an erase: oscillator by 128.
pub const PR_LONG: u16 = 5;
/// RLR for the time of an erase.
pub const RLR_LONG: u16 = 0xFFF;

/// After how long an unfed watchdog resets the chip [µs], for an oscillator [Hz].
pub const fn timeout_us(pr: u16, rlr: u16, oscillator: u32) -> u32 {
    ((rlr as u64 + 1) * (4 << pr) * 1_000_000 / oscillator as u64) as u32
}
