//! The developer's errands: `cargo xtask help` lists them.
//!
//! Exit code: 0 done, 1 failed, 2 asked for in the wrong way.

mod api;
mod browser;
mod clean_copy;
mod cluster;
mod dist;
mod errands;
mod folder;
mod images;
mod install;
mod invented;
mod line;
mod mjcf;
mod notebooks;
mod python;
mod real;
mod soundness;
mod steps;
mod supply_chain;
mod tool;
mod wheel;

use std::process::ExitCode;

use errands::ErrandError;

fn main() -> ExitCode {
    let (said, code) = match errands::perform(std::env::args_os().skip(1)) {
        Ok(()) => return ExitCode::SUCCESS,
        Err(ErrandError::Failed(said)) => (said, 1),
        Err(ErrandError::Usage(said)) => (said, 2),
    };
    eprintln!("{said}");
    ExitCode::from(code)
}
