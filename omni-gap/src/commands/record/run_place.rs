//! A run that a session gets: where it goes, and what a person should know of it.

use std::path::{Path, PathBuf};

use model_core::link::hello::Hello;
use omni_gap::api::{Error, Recorded, export};
use omni_gap::error::Result;
use omni_gap::log::records::run::notices;
use omni_gap::log::{RobotFile, write_whole};

use super::vision::RECORDS;
use crate::commands::output_path;

/// Where a run goes, and what the session has beside it.
#[derive(Debug)]
pub struct RunPlace {
    folder: PathBuf,
    /// The file of its records.
    pub records: PathBuf,
    /// Files of the session, and what they say.
    beside: Vec<(PathBuf, String)>,
}

impl RunPlace {
    /// Of a run in a session, a new one or one that has runs; a folder of its own where it has more files than its records.
    /// `beside` are files of the session, by name, and what they say.
    ///
    /// # Errors
    /// Where a run of this name is there, or a file of the session says something else.
    pub fn new(session: &Path, name: &str, is_folder: bool, beside: Vec<(&str, String)>) -> Result<Self> {
        output_path::folder(session, &["robot.toml"])?;
        let runs = session.join("runs");
        let (folder, file) = (runs.join(name), runs.join(format!("{name}.rec")));
        if let Some(taken) = [&file, &folder].into_iter().find(|path| path.exists()) {
            return Err(Error::output(taken, "a run of this name is there", "Name another with --name"));
        }
        let beside: Vec<(PathBuf, String)> =
            beside.into_iter().map(|(name, text)| (session.join(name), text)).collect();
        let says_other = |(path, text): &&(PathBuf, String)| {
            path.exists() && std::fs::read_to_string(path).ok().as_ref() != Some(text)
        };
        if let Some((path, _)) = beside.iter().find(says_other) {
            let reason = "the session holds another file of this name";
            return Err(Error::output(path, reason, "Record into a new session with --out"));
        }
        let records = folder.join(RECORDS);
        let (folder, records) = if is_folder { (folder, records) } else { (runs, file) };
        Ok(Self { folder, records, beside })
    }

    /// Writes the run, and what of the session is not there yet; `more` writes what else the run's folder gets. What was recorded,
    /// in words.
    pub fn write(&self, recorded: &Recorded, more: impl FnOnce(&Path) -> Result<()>) -> Result<String> {
        let made = output_path::NewFolder::make_with_files(&self.folder)?;
        for (path, text) in self.beside.iter().filter(|(path, _)| !path.exists()) {
            write_whole(path, text.as_bytes())?;
        }
        write_whole(&self.records, &recorded.frames)?;
        more(&self.folder)?;
        made.keep();
        let (rows, seconds) = (recorded.run.rows(), recorded.run.duration_s());
        Ok(format!("{rows} rows, {seconds:.3} s, written to {}", self.records.display()))
    }
}

/// The text of a robot file.
pub fn text_of(robot: &Path) -> Result<String> {
    std::fs::read_to_string(robot).map_err(|why| Error::input(robot, why.to_string(), "Check the file\'s permissions"))
}

/// What a person should know of a recording.
pub fn remarks(recorded: &Recorded, robot: &RobotFile, path: &Path) -> Vec<String> {
    let mut remarks = notices(&recorded.capture);
    let other = |hello: &Hello| export(robot, path).is_ok_and(|block| block.checksum != hello.block_check);
    if recorded.capture.hellos.iter().any(|(_, hello)| other(hello)) {
        let path = path.display();
        remarks.push(format!("the robot runs with other parameters than `omni-gap export {path}` writes"));
    }
    remarks
}

/// A name that can be a file's.
pub fn name(text: &str) -> std::result::Result<String, String> {
    let fit = |c: char| c.is_alphanumeric() || "-_.".contains(c);
    if !text.is_empty() && !text.starts_with('.') && text.chars().all(fit) {
        Ok(text.to_owned())
    } else {
        Err("expected letters, digits, - and _, such as square_2".to_owned())
    }
}
