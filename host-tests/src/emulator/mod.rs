//! # The emulator: the robot's image in QEMU, in lockstep with a virtual board
//!
//! - [`program`]: what sits behind the connector of a board: the image in QEMU, or the same program on the host;
//! - [`qemu`]: an ELF in `qemu-system-arm`, talked to through two named pipes;
//! - [`host_link`]: the bytes of the serial line, as frames;
//! - [`lockstep`]: program and board, period by period.
//!
//! QEMU's clock is the exchange: the image waits for every answer, so that a run does not depend on how fast either
//! side is, and the same seed gives the same bits.

pub mod host_link;
pub mod lockstep;
pub mod program;
#[cfg(target_os = "linux")]
pub mod qemu;

pub use lockstep::Lockstep;
pub use program::{BoardProgram, RunError};
#[cfg(target_os = "linux")]
pub use qemu::Qemu;
