//! # Real: what the diagnosis says of recordings of real robots
//!
//! [`sessions`] says which files of a folder make which session, and what a person thinks of the answer; [`known`] what was
//! known of it before, by which an answer is [`score`]d; [`page`] writes all that side by side. `cargo xtask real FOLDER` does it and rewrites `host-tests/golden/real.md`. Robot
//! files and mappings are those in `examples/`; nothing here knows more of the recordings than that.

pub mod known;
pub mod page;
pub mod score;
pub mod sessions;
