//! # Peripherals: what stands behind the registers
//!
//! [`bus`] takes reads and writes, and plays what comes next; each peripheral that does more than hold its words has a file.

pub mod bus;
pub mod converters;
pub mod flash;
pub mod link;
pub mod map;
pub mod spi;
pub mod timer;
pub mod watchdog;
pub mod words;
