//! # F405: an STM32F405VG with four 3-PWM gate drivers
//!
//! Which pin does what stands in [`crate::registers::pins`], what the registers are set to and when everything happens
//! in [`crate::registers`]; how to wire it in `firmware/HARDWARE.md`. Here these are put into the chip. To bring up
//! another chip or board, write a neighbour of this file with the same verbs.
//!
//! One period, counted from TIM1's top:
//!
//! | µs | what |
//! |---|---|
//! | −0.86 | TIM1 triggers the converters |
//! | 0 · 1.29 · 2.57 · 3.86 | motor 0 · 1 · 2 · 3 is at its top, and its three currents are held |
//! | 4.43 | last rank over: the converters' interrupt; [`Bridges::read`], [`Bridges::drive`] |
//! | 47.5 | the latch: TIM8's compare interrupt writes what was driven into the compare registers |
//! | 50 | next top, where every timer takes them |
//!
//! **Why a latch.** Compare registers are taken at update events, and a centre-aligned timer has two of them a period; only TIM1 and
//! TIM8 can skip one. Written at once, the counts would be taken at a motor's bottom if the turn was quick and at its
//! top if not: half a period of jitter. Written by an interrupt just before the tops they are always taken there.
//! Opening a bridge does not wait for that.
//!
//! The enables are plain outputs: a halted core does not open the bridges, so the watchdog goes on while a debugger
//! halts it, and a program that fails opens them itself before it waits for the watchdog ([`fail_safe`]).

mod bridges;
mod check;
mod fail_safe;
mod flash_store;
mod parts;
mod sensor_bus;
mod serial;
mod typed;
mod watchdog;

use cortex_m::peripheral::DWT;
use defmt_rtt as _;
use stm32f4xx_hal::pac;

use crate::registers::timing;

pub use bridges::{Bridges, resume_turns};
pub use check::{Reading, counters, pending, readings};
pub use fail_safe::fail_safe;
pub use flash_store::FlashStore;
pub use parts::{HSE_HZ, Parts, take};
pub use sensor_bus::MotionSensors;
pub use serial::SerialLink;
pub use watchdog::Watchdog;

/// What [`cycles`] counts in one period.
pub const CYCLES_PER_PERIOD: u32 = timing::PERIOD;

/// Processor cycles since the beginning of the period, which is TIM1's top.
#[inline]
pub fn cycles() -> u32 {
    // SAFETY: both registers are only read. Between the two readings the count may turn, which is an error of a few
    // cycles.
    let (cr1, count) = unsafe { ((*pac::TIM1::PTR).cr1().read(), (*pac::TIM1::PTR).cnt().read().bits()) };
    timing::since_top(count, cr1.dir().is_down())
}

/// Processor cycles, free-running: the core's own counter.
#[inline]
pub fn ticks() -> u32 {
    DWT::cycle_count()
}

/// Idle instructions that a test asked for: none on a board.
#[inline]
pub fn burn_motion() {}
