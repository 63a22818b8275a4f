//! # Faults of the world around the program, and what it does then
//!
//! A disk that is full, a folder that takes no files, names that are no text, archives that are bombs, files that change while
//! they are read, a program that is killed: each is staged in a folder of its own ([`scene`]), the command runs as a process
//! ([`process`]), and what happened is judged ([`outcome`]). What is promised of all: what cannot be done ends with exit code 2 and one
//! message that names what it is about; nothing is half-written; memory stays within bounds.
//!
//! The families: [`names`], [`links`], [`disk`], [`sizes`], [`bombs`], [`paths`], [`races`], [`clocks`], and [`kills`], which are many runs.

pub mod bombs;
pub mod clocks;
pub mod disk;
pub mod fault;
pub mod kills;
pub mod links;
pub mod names;
pub mod outcome;
pub mod page;
pub mod paths;
pub mod process;
pub mod races;
pub mod recording_bytes;
pub mod scene;
pub mod sizes;
pub mod whole;

use std::io;
use std::path::{Path, PathBuf};

use fault::Fault;
use outcome::Outcome;
use scene::Scene;

/// All faults that are one run of the command each, or a few.
pub fn faults() -> impl Iterator<Item = &'static Fault> {
    [
        disk::FAULTS,
        races::FAULTS,
        clocks::FAULTS,
        links::FAULTS,
        names::FAULTS,
        sizes::FAULTS,
        bombs::FAULTS,
        paths::FAULTS,
    ]
    .into_iter()
    .flatten()
}

/// Injects a fault into a new scene.
///
/// # Errors
/// Where it cannot be staged for want of room.
pub fn injected(fault: &Fault, program: &Path) -> io::Result<Outcome> {
    (fault.inject)(&Scene::new(program)?)
}

/// The command that was built beside this program, as tests and programs of one build lie.
///
/// # Errors
/// Where there is none.
pub fn program_beside() -> io::Result<PathBuf> {
    let own = std::env::current_exe()?;
    let beside = own.ancestors().skip(1).take(2).map(|folder| folder.join("omni-gap")).find(|path| path.is_file());
    beside.ok_or_else(|| io::Error::other("there is no omni-gap beside this program: cargo build -p omni-gap makes it"))
}
