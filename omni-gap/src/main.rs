//! # omni-gap: the command
//!
//! Parses and calls; every verb is one room of the library run on files, or all of them.

// A unit in brackets, [V], is not a link.
#![allow(rustdoc::broken_intra_doc_links)]

mod commands;

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(commands::Cli::asked().run())
}
