//! # Notebooks: run, and what they print compared with what is kept in them
//!
//! They use the extension and the benchmark of a dev build.

use std::ffi::OsString;

use crate::line::{Line, top};
use crate::python::Environment;
use crate::wheel::{PACKAGE, dev_package, dev_program};

/// What runs them, and what they use.
pub const ENVIRONMENT: Environment =
    Environment { folder: "target/python/notebooks", requirements: "python/requirements/notebooks.txt" };

/// Names the benchmark's program to `cargo xtask bench` where it is built already.
pub const BENCH: &str = "OMNI_GAP_BENCH";

/// All of them.
const NOTEBOOKS: [&str; 3] = ["csv_to_answer", "design_an_experiment", "enter_the_benchmark"];

/// Runs those that are named, or all. `BLESS=1` keeps what they print.
///
/// # Errors
/// What to tell the person.
pub fn perform(words: &[OsString]) -> Result<(), String> {
    let asked = asked(words)?;
    let python = ENVIRONMENT.ensure()?;
    dev_package()?;
    let bench = top().join(dev_program("bench")?).to_string_lossy().into_owned();
    let script = Line::of("").word(python).word("python/tests/notebooks.py");
    let script = asked.iter().fold(script, |line, name| line.word(format!("python/notebooks/{name}.ipynb")));
    let package = top().join(PACKAGE).to_string_lossy().into_owned();
    let script = script.env("PYTHONPATH", &package).env("OMNI_GAP_REPOSITORY", &top().to_string_lossy());
    script.env(BENCH, &bench).announced()
}

fn asked(words: &[OsString]) -> Result<Vec<&'static str>, String> {
    if words.is_empty() {
        return Ok(NOTEBOOKS.to_vec());
    }
    let named = |word: &OsString| {
        let found = NOTEBOOKS.iter().find(|name| word == **name);
        found.copied().ok_or_else(|| format!("notebooks: no {}; there are {}", word.display(), NOTEBOOKS.join(", ")))
    };
    words.iter().map(named).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_notebook_is_run() {
        let folder = std::fs::read_dir(top().join("python/notebooks")).unwrap();
        let mut found: Vec<String> =
            folder.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
        found.sort();
        assert_eq!(found, NOTEBOOKS.map(|name| format!("{name}.ipynb")));
    }

    #[test]
    fn an_unknown_one_is_told_with_those_that_there_are() {
        let said = asked(&[OsString::from("benchmark")]).unwrap_err();
        assert_eq!(said, "notebooks: no benchmark; there are csv_to_answer, design_an_experiment, enter_the_benchmark");
    }
}
