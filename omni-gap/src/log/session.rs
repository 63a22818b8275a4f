//! # A session: a robot file and its runs

use super::catalogue::Catalogue;
use super::columns::Columns;
use super::correct::Change;
use super::entries::entries;
use super::robot_file::RobotFile;
use super::run::Run;
use super::source::{is_folder_of_topics, is_log};
use super::toml_walk::read_text;
use crate::error::{Error, InputKind, Result};
use std::path::{Path, PathBuf};

/// A robot file and its runs, all read and sound.
#[derive(Debug, Clone, PartialEq)]
pub struct Session {
    /// The nominal model.
    pub robot: RobotFile,
    /// The robot file as its author wrote it.
    pub robot_text: String,
    /// Runs that may be fitted on, by name.
    pub runs: Vec<Run>,
    /// Runs that are only ever predicted; empty where the session has none.
    pub heldout: Vec<Run>,
    /// The robot file and the mapping, if they were read from files.
    pub files: Vec<PathBuf>,
    /// What was left out or taken as absent, one sentence each.
    pub notices: Vec<String>,
}

impl Session {
    /// Reads a session folder: `robot.toml`, `columns.toml` if there is one (or the mapping that is given instead),
    /// `runs/` and, if there is one, `heldout/`.
    pub fn load(folder: &Path, columns: Option<&Path>, catalogue: &Catalogue) -> Result<Session> {
        if !folder.is_dir() {
            let found = if folder.exists() { "this is a file, expected a session folder" } else { "no such folder" };
            return Err(
                Error::input(folder, found, "Give a folder with robot.toml and runs/").of_kind(InputKind::NotFound)
            );
        }
        let own = folder.join("columns.toml");
        let columns = columns.or_else(|| own.exists().then_some(&*own));
        let (mut session, columns) = Session::begun(&folder.join("robot.toml"), columns, catalogue)?;
        let runs = folder.join("runs");
        if !runs.is_dir() {
            return Err(Error::input(&runs, "there is no such folder", "Put the run logs into a folder named runs")
                .of_kind(InputKind::NotFound));
        }
        let paths = session.files_in(&runs, columns.as_ref())?;
        session.runs = session.read(&paths, columns.as_ref())?;
        let heldout = folder.join("heldout");
        if heldout.is_dir() {
            let paths = session.files_in(&heldout, columns.as_ref())?;
            session.heldout = session.read(&paths, columns.as_ref())?;
        }
        Ok(session)
    }

    /// Reads a session whose parts lie anywhere; a run path may be a file, a folder of
    /// files that make a run, or a folder of runs.
    pub fn load_from(robot: &Path, columns: Option<&Path>, runs: &[PathBuf], catalogue: &Catalogue) -> Result<Session> {
        let (mut session, columns) = Session::begun(robot, columns, catalogue)?;
        let mut paths = Vec::new();
        for path in runs {
            let is_run = is_folder_of_topics(path) || columns.as_ref().is_some_and(|columns| columns.is_run(path));
            match path.is_dir() && !is_run {
                true => paths.extend(session.files_in(path, columns.as_ref())?),
                false => paths.push(path.clone()),
            }
        }
        session.runs = session.read(&paths, columns.as_ref())?;
        Ok(session)
    }

    /// Rows a second of its runs, the median of them, to the thousandth (1/s); none where it has no runs.
    pub fn rate_hz(&self) -> Option<f64> {
        let mut rates: Vec<f64> = self.runs.iter().map(|run| 1.0 / run.median_step_s()).collect();
        rates.sort_by(f64::total_cmp);
        rates.get(rates.len() / 2).map(|rate| (1e3 * rate).round() / 1e3).filter(|rate| rate.is_finite())
    }

    /// What a robot file says of these recordings once its numbers were identified from them.
    pub fn identified(&self) -> Vec<Change> {
        let rate = |value| Change::Number { path: "identified.rate_hz".to_owned(), value };
        self.rate_hz().map(rate).into_iter().collect()
    }

    /// A session without runs, and the mapping that they are to be read through.
    fn begun(robot: &Path, mapping: Option<&Path>, catalogue: &Catalogue) -> Result<(Session, Option<Columns>)> {
        let columns = mapping.map(Columns::load).transpose()?;
        let robot_text = read_text(robot, "a robot file")?;
        let files = [robot].into_iter().chain(mapping).map(Path::to_path_buf).collect();
        let robot = RobotFile::parse(&robot_text, robot, catalogue)?;
        let session = Session { robot, robot_text, runs: Vec::new(), heldout: Vec::new(), files, notices: Vec::new() };
        Ok((session, columns))
    }

    /// The run logs in a folder, by name. Without a mapping they are the files of known suffixes; with one that
    /// has `[[file]]` tables folders are runs too.
    fn files_in(&mut self, folder: &Path, columns: Option<&Columns>) -> Result<Vec<PathBuf>> {
        let mut paths = Vec::new();
        for (name, path) in entries(folder)? {
            let fits = columns.map_or_else(|| is_log(&path), |columns| columns.takes(&name));
            let is_run = columns.is_some_and(|columns| !columns.parts.is_empty());
            match path.is_dir() && !is_folder_of_topics(&path) {
                false if fits => paths.push(path),
                true if fits && is_run => paths.push(path),
                true if !is_run => self.notices.push(format!(
                    "{}: a folder is a run only where columns.toml has [[file]] tables, left out",
                    path.display()
                )),
                _ => self.notices.push(format!("{}: not a run log, left out", path.display())),
            }
        }
        self.notices.sort();
        match paths.is_empty() {
            true => Err(Error::input(
                folder,
                "there is no run log in the folder",
                "Put run logs into it (`omni-gap explain runs` says which files and columns), or map them in columns.toml",
            )
            .of_kind(InputKind::Missing)),
            false => Ok(paths),
        }
    }

    fn read(&mut self, paths: &[PathBuf], columns: Option<&Columns>) -> Result<Vec<Run>> {
        let mut runs = Vec::with_capacity(paths.len());
        for path in paths {
            let (run, notices) = Run::open(path, &self.robot, columns)?;
            runs.push(run);
            for notice in notices {
                if !self.notices.contains(&notice) {
                    self.notices.push(notice);
                }
            }
        }
        tell_apart(&mut runs);
        Ok(runs)
    }
}

/// Gives runs of one name their folder's name too.
fn tell_apart(runs: &mut [Run]) {
    let names: Vec<String> = runs.iter().map(|run| run.name.clone()).collect();
    for run in runs {
        if names.iter().filter(|name| **name == run.name).count() > 1 {
            let folder = run.path.parent().and_then(Path::file_name).unwrap_or_default().to_string_lossy();
            let file = run.path.file_name().unwrap_or_default().to_string_lossy();
            run.name = format!("{folder}/{file}");
        }
    }
}

#[cfg(test)]
#[path = "session_tests.rs"]
mod tests;
