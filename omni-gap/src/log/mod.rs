//! # Files → SI
//!
//! Guarantee: SI units, monotonic time, every hole has a reason. What cannot be brought into that form is refused with
//! one message that says where and how to mend it.

mod catalogue;
mod correct;
mod robot_file;
mod robot_read;
mod run;
mod toml_walk;
mod write;

pub use catalogue::{Catalogue, KnownEffect, KnownParam};
pub use correct::{Change, corrected};
pub use robot_file::*;
pub use run::{Channel, Group, Missing, Run, Sampled};
pub use write::{write_whole, write_whole_with};
