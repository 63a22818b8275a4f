//! # In the loop: the robot's program, a robot that is not what it believes, and somebody who commands it
//!
//! [`Ride`] is one run: a brain (the image in QEMU, or the same library called here) in lockstep with a virtual board, and
//! a host that sends the parameter block, commands a hundred times a second, and keeps what comes back.
//!
//! - [`robots`]: what is believed of the paper's robots, and what is true;
//! - [`ramps`]: a speed on one axis, with the acceleration measured;
//! - [`eight`]: a figure-eight, with and without the model ahead of the feedback;
//! - [`faults`]: every fault, injected while the robot drives;
//! - [`gap`]: drive, record, diagnose, correct, drive again.

pub mod eight;
pub mod faults;
pub mod gap;
pub mod ramps;
mod ride;
pub mod robots;
mod software;
mod twin;

pub use ride::{Moment, Ride, Taken};
pub use software::Software;
pub use twin::Twin;
