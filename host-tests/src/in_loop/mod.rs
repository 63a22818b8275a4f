//! # In the loop: the robot's program, a robot that is not what it believes, and somebody who commands it
//!
//! [`ClosedLoopRun`] is one run: a program (the image in QEMU, or the same library called here) in lockstep with a
//! virtual board, and a host that sends the parameter block, commands a hundred times a second, and keeps what comes
//! back.
//!
//! - [`robots`]: what is believed of the paper's robots, and what is true;
//! - [`ramps`]: a speed on one axis, with the acceleration measured;
//! - [`figure_eight`]: a path with curves to both sides;
//! - [`heading`]: what a lap leaves of the direction that a robot faces, with a gyro and without;
//! - [`saturation`]: a diagonal acceleration for which the bus has not enough;
//! - [`command_timeout`]: commands that end;
//! - [`margin`]: all of it on a processor that is slow;
//! - `push`: a robot that is held, `regeneration`: a hard stop on a supply that takes nothing back, `storing`: a power cut;
//! - [`study`]: all of these, on many seeds, and one of them in the emulator too;
//! - [`page`]: what came of it, and what is promised;
//! - [`faults`]: every fault, injected while the robot drives;
//! - [`commissioned`] and [`commissioned_page`]: boards that are wired wrong, found out and then driven;
//! - [`served`]: one that listens at a network address;
//! - [`supply_plug`]: what a person may pull at it;
//! - [`modern`]: a robot of today with all that robots have, on many seeds, beside a [`wheel_pi`] controller;
//! - [`gap`] and [`gap_page`]: drive, record, diagnose, correct, drive again.

mod closed_loop_run;
pub mod command_timeout;
pub mod commissioned;
pub mod commissioned_page;
pub mod faults;
pub mod figure_eight;
pub mod gap;
pub mod gap_page;
pub mod heading;
mod host_program;
mod link_jitter;
pub mod margin;
pub mod modern;
pub mod page;
#[cfg(test)]
mod push;
pub mod ramps;
#[cfg(test)]
mod regeneration;
pub mod robots;
pub mod saturation;
pub mod served;
mod shadow;
#[cfg(test)]
mod storing;
pub mod study;
pub mod supply_plug;
pub mod wheel_pi;

pub use closed_loop_run::{ClosedLoopRun, RunLog, TruthSample};
pub use host_program::HostProgram;
pub use shadow::ShadowedProgram;
