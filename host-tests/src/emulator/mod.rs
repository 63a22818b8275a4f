//! # The emulator: the robot's image in QEMU, in lockstep with a virtual board
//!
//! - [`brain`]: what sits behind the connector of a board: the image in QEMU, or the same program on the host;
//! - [`qemu`]: an ELF in `qemu-system-arm`, talked to through two named pipes;
//! - [`link`]: the bytes of the serial line, as frames;
//! - [`lockstep`]: brain and board, period by period.
//!
//! QEMU's clock is the exchange: the image waits for every answer, so that a run does not depend on how fast either
//! side is, and the same seed gives the same bits.

pub mod brain;
pub mod link;
pub mod lockstep;
#[cfg(target_os = "linux")]
pub mod qemu;

pub use brain::{Brain, Trouble};
pub use lockstep::Lockstep;
#[cfg(target_os = "linux")]
pub use qemu::Qemu;
