//! # Files → SI
//!
//! Guarantee: SI units, monotonic time, every hole has a reason. What cannot be brought into that form is refused with
//! one message that says where and how to mend it.
//!
//! Reading order: [`Session`] (a folder of files), [`RobotFile`] (the nominal model), [`Run`] (one recording) with its
//! [`Channel`]s, and [`columns`] (logs in another layout).

mod catalogue;
pub mod columns;
pub mod controller;
mod correct;
mod csv;
mod edges;
mod effects_read;
mod plausible;
mod read;
mod robot_file;
mod robot_read;
mod run;
mod session;
mod target;
mod toml_walk;
mod write;

pub use catalogue::{Catalogue, KnownEffect, KnownParam, nearest};
pub use columns::Columns;
pub use controller::ControllerFile;
pub use correct::{Change, corrected};
pub(crate) use edges::{EdgeInterval, retimed, speeds_on_rows};
pub use robot_file::*;
pub use run::{Channel, Group, Missing, Run, Sampled};
pub use session::Session;
pub use write::{write_whole, write_whole_with};
