//! # Board: the only room that knows pins, registers and `unsafe`
//!
//! One file a board, chosen by a feature. Every board hands out the same parts with the same verbs, asleep: bridges open,
//! timers stopped.
//!
//! | part | verbs |
//! |---|---|
//! | `Bridges` | `start`, `read` the codes of this period, `drive` the next one; `spent`, `is_late` |
//! | `SerialLink` | `send` and `receive` bytes, as many as it has room for |
//! | `Watchdog` | `feed`, `restarted` |
//! | `MotionSensors` | `read` gyro and encoders, those that are fitted |
//! | `FlashStore` | `load` and `save` the parameter block |
//!
//! and a counter of processor cycles, [`cycles`], with `CYCLES_PER_PERIOD`. What a program comes to that has failed stands
//! in [`handlers`]: every board has a `fail_safe` for it.
#![allow(unsafe_code)]

#[cfg(feature = "board")]
mod handlers;

#[cfg(feature = "emulated")]
mod emulated;
#[cfg(feature = "emulated")]
pub use emulated::*;

#[cfg(feature = "f405")]
mod f405;
#[cfg(feature = "f405")]
pub use f405::*;

/// The chip's registers, as the application framework wants to know them.
pub use stm32f4xx_hal::pac;
