//! `compare`.

use std::path::{Path, PathBuf};

use omni_gap::api::{self, ComparedSession, SessionsCompared};
use omni_gap::comparison::Options;
use omni_gap::report::comparison::{self as report, Against};
use pyo3::prelude::*;

use crate::session::Session;
use crate::signals;
use crate::work::{mistake, work};

/// Two sessions that were compared.
#[pyclass(frozen, module = "omni_gap._omni_gap")]
#[derive(Debug)]
pub struct Compared(SessionsCompared);

/// Compares two sessions; the first may be a simulator's log.
#[pyfunction]
pub fn compare(
    py: Python<'_>,
    a: PyRef<'_, Session>,
    b: PyRef<'_, Session>,
    simulator: bool,
    without: Vec<String>,
) -> PyResult<Compared> {
    let against = if simulator { Against::Simulator } else { Against::Recordings };
    let names = [&a, &b].map(|side| side.name.clone().unwrap_or_else(|| "session".to_owned()));
    let sessions = [&a.session, &b.session];
    work(py, move |progress| {
        let robot = |k: usize| sessions[k].files.first().map_or(Path::new("robot"), PathBuf::as_path);
        let side = |k: usize| ComparedSession { session: sessions[k], name: &names[k], robot_file: robot(k) };
        let mut options = Options { progress, ..Options::default() };
        options.engine.screen.without = without;
        api::compare([side(0), side(1)], against, &options)
    })
    .map(Compared)
}

#[pymethods]
impl Compared {
    /// The text of `compare.json`.
    fn json(&self) -> PyResult<String> {
        serde_json::to_string(&self.0.report).map_err(mistake)
    }

    /// What the command says in a terminal.
    fn text(&self) -> String {
        report::terminal(&self.0.report, None)
    }

    /// `compare.html`.
    fn html(&self, py: Python<'_>) -> String {
        py.detach(|| report::html(&self.0.report, &self.0.pictures))
    }

    /// What the charts are drawn of, as JSON.
    fn signals(&self) -> String {
        signals::as_json(&self.0.pictures)
    }

    /// Writes the files of the command into a folder.
    fn write(&self, py: Python<'_>, folder: PathBuf) -> PyResult<()> {
        work(py, |_| report::write(&folder, &self.0.report, &report::html(&self.0.report, &self.0.pictures)))?;
        Ok(())
    }
}
