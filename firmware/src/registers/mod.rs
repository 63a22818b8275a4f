//! # Registers: the values that a board writes, worked out where a host can test them
//!
//! Nothing here touches hardware: pure functions and constants, made of named fields ([`words`]). A board copies them into its
//! peripherals, and a test reads them back field by field (`firmware/golden/registers.md`). Bit positions are those of the reference
//! manual RM0090 for the STM32F405.
//!
//! In reading order: which pin does what ([`pins`]), when everything happens ([`timing`]), the converters ([`adc`]),
//! the PWM timers ([`timers`]), the link and its DMA ([`link`]), the bus of gyro and
//! encoders ([`spi`]), the watchdog ([`watchdog`]).

pub mod adc;
pub mod link;
pub mod pins;
pub mod spi;
pub mod timers;
pub mod timing;
pub mod watchdog;
pub mod words;
