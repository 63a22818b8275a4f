//! # Lines: errands that are a command or two

use std::ffi::OsString;

use crate::line::Line;
use crate::python::Environment;
use crate::{mjcf, notebooks, real, steps, tool, wheel};

/// What the comparison with MuJoCo runs on.
pub const MUJOCO: Environment =
    Environment { folder: "target/mujoco-venv", requirements: "host-tests/mujoco/requirements.txt" };

/// What the benchmark's peers run on.
pub const PEERS: Environment =
    Environment { folder: "target/peers-venv", requirements: "host-tests/peers/requirements.txt" };

pub fn test(_: &[OsString]) -> Result<(), String> {
    tool::ensure(tool::TOOLS)?;
    let outcome = steps::run(steps::STEPS, Line::succeeds);
    if outcome.failed.is_some() {
        return Err(outcome.summary());
    }
    println!("{}", outcome.summary());
    Ok(())
}

pub fn bless(_: &[OsString]) -> Result<(), String> {
    tool::ensure(tool::TOOLS)?;
    Line::of("cargo test --workspace").env("BLESS", "1").announced()?;
    println!("golden pages rewritten where they differed; read the difference before you commit it: git diff");
    Ok(())
}

pub fn bench(words: &[OsString]) -> Result<(), String> {
    if words.is_empty() {
        return Line::of("cargo bench -p host-tests").announced();
    }
    let line = match std::env::var_os(notebooks::BENCH) {
        Some(built) => Line::of("").word(built),
        None => Line::of("cargo run --release -p host-tests --bin bench --"),
    };
    words.iter().fold(line, Line::word).announced()
}

/// Runs the program that makes a page.
pub fn page_of(program: &str) -> Result<(), String> {
    Line::of("cargo run --release -p host-tests --bin").word(program).announced()
}

pub fn fleet(asked: &[OsString]) -> Result<(), String> {
    asked.iter().fold(Line::of("cargo run --release -p host-tests --bin fleet --"), Line::word).announced()
}

/// In the build of the tests: what overflows ends a program there.
pub fn fault_injection(_: &[OsString]) -> Result<(), String> {
    wheel::dev_program("omni-gap")?;
    Line::of("").word(wheel::dev_program("fault_injection")?).announced()
}

pub fn mujoco(_: &[OsString]) -> Result<(), String> {
    let python = MUJOCO.ensure()?;
    Line::of("cargo run --release -p host-tests --bin mujoco --").word(python).announced()
}

pub fn in_mujoco(_: &[OsString]) -> Result<(), String> {
    mjcf::perform(&MUJOCO.ensure()?)
}

pub fn peers(_: &[OsString]) -> Result<(), String> {
    let python = PEERS.ensure()?;
    Line::of("cargo build --release -p omni-gap").announced()?;
    let tests = "-m pytest host-tests/peers".split(' ');
    tests.fold(Line::of("").word(python), Line::word).env("PYTHONPATH", "host-tests").announced()
}

pub fn fuzz(words: &[OsString]) -> Result<(), String> {
    tool::ensure(tool::FUZZERS)?;
    words.iter().fold(Line::of("cargo run --release -p host-tests --bin fuzz --"), Line::word).announced()
}

pub fn on_recordings(given: &[OsString]) -> Result<(), String> {
    let folder = real::folder(given.first().cloned(), std::env::var_os(real::VARIABLE))?;
    Line::of("cargo run --release -p host-tests --bin real --").word(folder).announced()
}

pub fn frozen(given: &[OsString]) -> Result<(), String> {
    let line = Line::of("cargo run --release -p host-tests --bin frozen --");
    let variable = std::env::var_os(real::VARIABLE);
    let line = match !given.is_empty() || variable.is_some() {
        true => line.word(real::folder(given.first().cloned(), variable)?),
        false => line,
    };
    line.announced()
}

/// The frozen reports are those of the test command's build.
pub fn same_answer(_: &[OsString]) -> Result<(), String> {
    tool::ensure(tool::OTHER_LIBRARY)?;
    Line::of("cargo run --release -p host-tests --bin frozen").announced()?;
    Line::of("cargo run --release -p host-tests --bin elsewhere --target x86_64-unknown-linux-musl").announced()
}

pub fn book(_: &[OsString]) -> Result<(), String> {
    Line::of("cargo test --release -p omni-gap --test book").env("OMNI_GAP_BOOK", "all").announced()?;
    Line::of("cargo install mdbook --locked --version ^0.5 --root target/mdbook").announced()?;
    Line::of("target/mdbook/bin/mdbook build book --dest-dir target/book").announced()
}
