//! # Fail-safe: all bridges open, whatever the program has come to
//!
//! The enables are plain outputs and the timers run without the core, so a program that just stops leaves the bridges
//! driven at their last duties until the watchdog resets the chip: at 24 V into 0.6 Ω some 33 A for 10 to 30 ms. So before
//! it waits:
//!
//! 1. no interrupt comes any more: a task could close a bridge again;
//! 2. the four enables go low, two ports, one write each;
//! 3. TIM1's and TIM8's outputs go off, which the other two timers have no bit for;
//! 4. the watchdog is started, if it was not: the chip starts anew.
//!
//! Constants and writes alone, nothing that was in memory: it does not matter what the fault has spoilt.

use cortex_m::{asm, interrupt};
use stm32f4xx_hal::pac;

use super::typed::Put;
use crate::registers::{pins, timers, watchdog};

/// The enables on port A go low.
const A_LOW: u32 = pins::enables_low('A');
/// The enables on port B go low.
const B_LOW: u32 = pins::enables_low('B');

/// Opens all bridges and waits for the watchdog's reset.
pub extern "C" fn fail_safe() -> ! {
    interrupt::disable();
    // SAFETY: nothing else runs any more. The writes are atomic for the ports, whole registers for the timers, and a key
    // that the manual names; all are harmless before the board was taken too, where a peripheral without clock takes none.
    unsafe {
        (*pac::GPIOA::PTR).bsrr().write(|w| w.bits(A_LOW));
        (*pac::GPIOB::PTR).bsrr().write(|w| w.bits(B_LOW));
        (*pac::TIM1::PTR).bdtr().put(timers::BDTR_ASLEEP);
        (*pac::TIM8::PTR).bdtr().put(timers::BDTR_ASLEEP);
        (*pac::IWDG::PTR).kr().put(watchdog::START);
    }
    loop {
        asm::nop();
    }
}
