//! What the tests on a board share.

use cortex_m::peripheral::NVIC;
use defmt::{assert, unwrap};
use firmware::board::{self, Parts, pac, pac::Interrupt};
use firmware::codes::Codes;
use firmware::registers::timing;

/// The board, everything asleep.
pub fn parts() -> Parts {
    let core = unwrap!(cortex_m::Peripherals::take());
    let device = unwrap!(pac::Peripherals::take());
    board::take(core, device)
}

/// Waits for the end of the converters' group, and says how many cycles into the period it was seen.
pub fn group(parts: &mut Parts) -> (Codes, u32) {
    let began = board::ticks();
    while !NVIC::is_pending(Interrupt::ADC) {
        assert!(board::ticks().wrapping_sub(began) < 2 * timing::PERIOD, "no end of a group within two periods");
    }
    let seen = board::cycles();
    let codes = parts.bridges.read();
    cortex_m::asm::dsb();
    NVIC::unpend(Interrupt::ADC);
    (codes, seen)
}

/// Lets time pass.
pub fn wait(microseconds: u32) {
    cortex_m::asm::delay(timing::CORE_HZ / 1_000_000 * microseconds);
}
