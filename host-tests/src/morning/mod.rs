//! # Morning: the commands of a page, run against a robot without a board
//!
//! `firmware/HARDWARE.md` tells a person with a board what to type, from the first power-up to a drive with what was found put
//! right. Here the same lines are typed, at a robot that is the image in QEMU behind a serial device.
//!
//! - [`script`]: the commands of the page, and what it says that they print;
//! - [`bench`]: the robot on its bench, and a shell beside it.

pub mod bench;
pub mod script;
