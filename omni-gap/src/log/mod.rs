//! # Files → SI
//!
//! Guarantee: SI units, monotonic time, every hole has a reason. What cannot be brought into that form is refused with
//! one message that says where and how to mend it.
//!
//! Reading order: [`Session`] (a folder of files), [`RobotFile`] (the nominal model), [`Run`] (one recording) with its
//! [`Channel`]s, and [`columns`] (logs in another layout). A recording comes in through `source` (a file of any format →
//! columns of samples) → `bind` and `read` (a `mapping` makes SI units of them, on the file's own clock) → `folder` and `align`
//! (files with a clock each → one run; `clock_offset` compares clocks by the `motion` that each file tells).

mod align;
mod bind;
mod body_from_wheels;
mod catalogue;
mod channel;
mod clock_offset;
pub mod columns;
pub mod commissioned;
mod controller;
mod correct;
mod driving;
mod edges;
mod effects_read;
mod entries;
mod file_table;
mod folder;
mod formats;
mod formula;
mod from;
mod held_folder;
mod mapping;
mod median_step;
mod motion;
mod pattern;
mod permutations;
mod plausible;
mod read;
pub mod records;
mod robot_file;
mod robot_read;
mod run;
mod session;
mod sink;
pub(crate) mod source;
#[cfg(test)]
mod table_tests;
pub(crate) mod target;
mod toml_number;
mod toml_walk;
mod unchanged;
mod write;

pub(crate) use body_from_wheels::{BodyFromWheels, MOST_CHANNELS, row_of};
pub use catalogue::{Catalogue, KnownEffect, KnownParam, nearest};
pub use channel::{Channel, Missing};
pub use columns::Columns;
pub use commissioned::{CommissionedFile, with_commissioned};
pub use controller::ControllerFile;
pub use correct::{Change, corrected};
pub use driving::Chain;
pub(crate) use edges::retimed;
pub(crate) use entries::entries;
pub use formats::{FORMATS, FormatPage};
pub(crate) use held_folder::{HeldFolder, UNFINISHED, locked_within};
pub(crate) use mapping::unit_factor;
pub(crate) use median_step::median_step;
pub(crate) use permutations::permutations;
pub use robot_file::*;
pub use run::{Group, Run, RunFile, Sampled};
pub use session::Session;
pub use sink::{holds_several, write_run, write_runs, write_session};
pub use source::Table;
pub use toml_number::toml_number;
pub(crate) use toml_walk::{Section, Source as TomlSource, read_text};
pub use write::{is_device, write_whole, write_whole_with};
