//! # In the loop: the robot's program, a robot that is not what it believes, and somebody who commands it
//!
//! [`Ride`] is one run: a brain (the image in QEMU, or the same library called here) in lockstep with a virtual board, and
//! a host that sends the parameter block, commands a hundred times a second, and keeps what comes back.
//!
//! - [`robots`]: what is believed of the paper's robots, and what is true;
//! - [`ramps`]: a speed on one axis, with the acceleration measured;
//! - [`eight`]: a path with curves to both sides;
//! - [`saturation`]: a diagonal acceleration for which the bus has not enough;
//! - [`silence`]: commands that end;
//! - [`study`]: all of these, on many seeds, and one of them in the emulator too;
//! - [`page`]: what came of it, and what is promised;
//! - [`faults`]: every fault, injected while the robot drives;
//! - [`gap`] and [`gap_page`]: drive, record, diagnose, correct, drive again.

pub mod eight;
pub mod faults;
pub mod gap;
pub mod gap_page;
pub mod page;
pub mod ramps;
mod ride;
pub mod robots;
pub mod saturation;
pub mod silence;
mod software;
pub mod study;
mod twin;

pub use ride::{Moment, Ride, Taken};
pub use software::Software;
pub use twin::Twin;
