//! # Laboratory: every cause, recorded by a simulator that shares no line with the one that judges
//!
//! [`cases`] lets `ground-truth` record the paper's robot with one cause at its typical size, through files as a user has
//! them; [`page`] writes down what the diagnosis answers. `cargo xtask laboratory` does it for all and keeps
//! `host-tests/golden/laboratory.md`.

pub mod cases;
pub mod page;
pub mod through_files;
