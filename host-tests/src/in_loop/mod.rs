//! # In the loop: the robot's program, a robot that is not what it believes, and somebody who commands it
//!
//! [`Ride`] is one run: a brain (the image in QEMU, or the same library called here) in lockstep with a virtual board, and
//! a host that sends the parameter block, commands a hundred times a second, and keeps what comes back.

pub mod gap;
pub mod faults;
mod ride;
mod software;
mod twin;

pub use ride::{Moment, Ride, Taken};
pub use software::Software;
pub use twin::Twin;
