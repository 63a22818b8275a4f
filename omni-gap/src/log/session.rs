//! # A session: a robot file and its runs

use super::catalogue::Catalogue;
use super::columns::Columns;
use super::correct::Change;
use super::entries::entries;
use super::robot_file::RobotFile;
use super::run::Run;
use super::source::{Table, is_folder_of_topics, is_log};
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
        session.add_files(runs, columns.as_ref())?;
        Ok(session)
    }

    /// A session without runs, of the text of a robot file; `place` is named in messages about it.
    ///
    /// # Errors
    /// Where it is not the text of a robot file.
    pub fn of_robot(robot_text: &str, place: &Path, catalogue: &Catalogue) -> Result<Session> {
        let robot = RobotFile::parse(robot_text, place, catalogue)?;
        let (robot_text, runs, heldout) = (robot_text.to_owned(), Vec::new(), Vec::new());
        Ok(Session { robot, robot_text, runs, heldout, files: Vec::new(), notices: Vec::new() })
    }

    /// Adds runs; a path may be a file, a folder of files that make a run, or a folder of runs.
    ///
    /// # Errors
    /// Where one cannot be read, or is no log of this robot.
    pub fn add_files(&mut self, runs: &[PathBuf], columns: Option<&Columns>) -> Result<()> {
        let mut paths = Vec::new();
        for path in runs {
            let is_run = is_folder_of_topics(path) || columns.is_some_and(|columns| columns.is_run(path));
            match path.is_dir() && !is_run {
                true => paths.extend(self.files_in(path, columns)?),
                false => paths.push(path.clone()),
            }
        }
        let read = self.read(&paths, columns)?;
        self.runs.extend(read);
        Ok(())
    }

    /// Adds runs that are in memory already.
    ///
    /// # Errors
    /// Where one is no log of this robot.
    pub fn add_tables(&mut self, tables: impl IntoIterator<Item = Table>, columns: Option<&Columns>) -> Result<()> {
        let wheels = self.robot.wheel.len();
        let read = self.taken(tables.into_iter().map(|table| Run::of_table(table, wheels, columns)))?;
        self.runs.extend(read);
        Ok(())
    }

    /// Adds runs that lie anywhere: those of a session folder, held-out ones too, whatever robot file it has; a run log; or a
    /// folder of them. A folder's own mapping is used where none is given.
    ///
    /// # Errors
    /// Where there is nothing, or one cannot be read, or is no log of this robot.
    pub fn add_any(&mut self, path: &Path, columns: Option<&Path>) -> Result<()> {
        if !path.exists() {
            let fix = "Give a session folder, a run log or a folder of run logs";
            return Err(Error::input(path, "no such file or folder", fix).of_kind(InputKind::NotFound));
        }
        let own = path.join("columns.toml");
        let mapping = columns.or_else(|| own.is_file().then_some(&*own));
        self.files.extend(mapping.map(Path::to_path_buf));
        let within = ["runs", "heldout"].map(|name| path.join(name));
        let mut runs: Vec<PathBuf> = within.into_iter().filter(|folder| folder.is_dir()).collect();
        if runs.is_empty() {
            runs.push(path.to_path_buf());
        }
        self.add_files(&runs, mapping.map(Columns::load).transpose()?.as_ref())
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
        Ok((Session { files, ..Session::of_robot(&robot_text, robot, catalogue)? }, columns))
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
        let robot = self.robot.clone();
        self.taken(paths.iter().map(|path| Run::open(path, &robot, columns)))
    }

    /// Takes runs, one after the other, and keeps their notices.
    fn taken(&mut self, read: impl Iterator<Item = Result<(Run, Vec<String>)>>) -> Result<Vec<Run>> {
        let mut runs = Vec::new();
        for read in read {
            let (run, notices) = read?;
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
