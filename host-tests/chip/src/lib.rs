//! # Chip: the board's image, executed
//!
//! The very ELF that is flashed runs on an emulated Cortex-M4F ([`core`]), and what it finds at the peripherals' addresses
//! is modelled register by register ([`peripherals`]), as far as this image uses them. Behaviour is that of the reference
//! manual RM0090; each file names its sections.
//!
//! **Time** is the count of core cycles at 168 MHz. How many an instruction takes is the [pace](core::pace): one and a half, whichever it is, or what the manuals say at most;
//! when an instruction comes is known as well as that is. What the peripherals do among themselves does not hang on it.
//!
//! In reading order: what happened ([`events`]), the registers ([`peripherals`]), the core ([`core`]), an ELF and its lines
//! ([`image`]), fields by the register access crate ([`pac`]), the chip in a virtual board ([`board`]), the order within a
//! period ([`order`]), the runs ([`scenarios`]) and what they came to ([`page`]).
//!
//! Neglects: wait states, bus arbitration, the few cycles by which a trigger is resynchronised between clock domains,
//! sub-word writes other than merged into the word, and whatever this image does not use.

pub mod board;
pub mod core;
pub mod events;
pub mod image;
pub mod order;
pub mod pac;
pub mod page;
pub mod peripherals;
pub mod scenarios;
