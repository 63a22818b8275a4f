//! A recording as the product reads it: through the files that a user has.

use std::path::Path;

use ground_truth::recording::Session as Recorded;
use omni_gap::error::{Error, Result};
use omni_gap::log::Session;
use omni_gap::report::Report;
use omni_gap::{Options, diagnose, known_effects};

/// What is read of a recording whose folder nobody keeps.
///
/// # Errors
/// Where no folder can be written, or what was recorded cannot be read.
pub fn read(recorded: &Recorded) -> Result<Session> {
    let folder = tempfile::tempdir().map_err(|why| not_written(&std::env::temp_dir(), &why))?;
    read_in(recorded, folder.path())
}

/// The same of a folder that is kept.
///
/// # Errors
/// As of [`read`].
pub fn read_in(recorded: &Recorded, folder: &Path) -> Result<Session> {
    recorded.write(folder).map_err(|why| not_written(folder, &why))?;
    Session::load(folder, None, &known_effects())
}

/// What is answered to it; an answer that contradicts itself is an error.
///
/// # Errors
/// As of [`read`], or where the report breaks its contract.
pub fn answered(recorded: &Recorded) -> Result<Report> {
    let report = diagnose(&read(recorded)?, &Options::default());
    match report.violations().as_slice() {
        [] => Ok(report),
        against => Err(Error::input(Path::new("report.json"), against.join("; "), "Mend the report")),
    }
}

fn not_written(path: &Path, why: &std::io::Error) -> Error {
    Error::Output {
        path: path.to_owned(),
        reason: why.to_string(),
        fix: "Make room, or choose another folder".to_owned(),
    }
}
