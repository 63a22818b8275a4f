//! `diagnose`.

use std::path::{Path, PathBuf};

use omni_gap::api::inputs;
use omni_gap::engine::Knobs;
use omni_gap::report::design::script_csv;
use omni_gap::report::{self, Beside};
use omni_gap::{Diagnosis, Options};
use pyo3::prelude::*;

use crate::session::Session;
use crate::signals;
use crate::work::{mistake, work};

/// A diagnosis.
#[pyclass(frozen, module = "omni_gap._omni_gap")]
#[derive(Debug)]
pub struct Diagnosed(Diagnosis);

/// How to diagnose.
#[derive(Debug, FromPyObject)]
pub struct How {
    #[pyo3(item)]
    horizon_s: f64,
    #[pyo3(item)]
    without: Vec<String>,
    #[pyo3(item)]
    max_rows: Option<usize>,
}

impl How {
    /// The thresholds.
    pub fn knobs(&self) -> Knobs {
        let mut knobs = Knobs::default();
        knobs.measure.horizon_s = self.horizon_s;
        knobs.screen.without.clone_from(&self.without);
        knobs.layout.excerpt.most_rows = self.max_rows.unwrap_or(knobs.layout.excerpt.most_rows);
        knobs
    }
}

/// Diagnoses a session, together with others beside it.
#[pyfunction]
pub fn diagnose(
    py: Python<'_>,
    session: PyRef<'_, Session>,
    also: Vec<PyRef<'_, Session>>,
    how: How,
) -> PyResult<Diagnosed> {
    let also: Vec<_> = also.iter().map(|more| more.named()).collect();
    let (name, session) = (session.name.clone(), &session.session);
    work(py, move |progress| {
        let of = inputs([session].into_iter().chain(also.iter().map(|more| &more.session)))?;
        let options = Options { session: name, also: &also, knobs: how.knobs(), progress };
        let mut diagnosis = Diagnosis::of(session, &options);
        diagnosis.report.inputs = of;
        Ok::<_, omni_gap::Error>(Diagnosed(diagnosis))
    })
}

#[pymethods]
impl Diagnosed {
    /// The text of `report.json`.
    fn json(&self) -> PyResult<String> {
        self.0.report.to_json().map_err(mistake)
    }

    /// What the command says in a terminal.
    fn text(&self) -> String {
        report::terminal(&self.0.report, None)
    }

    /// `report.html`.
    fn html(&self, py: Python<'_>) -> String {
        py.detach(|| report::html(&self.0.report, &self.0.pictures))
    }

    /// What the charts are drawn of, as JSON.
    fn signals(&self) -> String {
        signals::as_json(&self.0.pictures)
    }

    /// `refitted_robot.toml`, where a model was fitted.
    #[getter]
    fn refitted_robot(&self) -> Option<&str> {
        self.0.refitted_robot.as_deref()
    }

    /// `corrected_robot.toml`, where a cause was named.
    #[getter]
    fn corrected_robot(&self) -> Option<&str> {
        self.0.corrected_robot.as_deref()
    }

    /// `next_experiment.csv`, where a script would settle what is open.
    #[getter]
    fn next_experiment(&self) -> Option<String> {
        self.0.next_run.as_ref().map(script_csv)
    }

    /// Writes the files of the command into a folder.
    fn write(&self, py: Python<'_>, folder: PathBuf) -> PyResult<Vec<PathBuf>> {
        work(py, |_| self.written(&folder))
    }
}

impl Diagnosed {
    fn written(&self, folder: &Path) -> omni_gap::error::Result<Vec<PathBuf>> {
        let script = self.0.next_run.as_ref().map(script_csv);
        let beside = Beside {
            refitted: self.0.refitted_robot.as_deref(),
            corrected: self.0.corrected_robot.as_deref(),
            script: script.as_deref(),
        };
        let page = report::html(&self.0.report, &self.0.pictures);
        let report::Written { json, html, refitted, corrected, script } =
            report::write(folder, &self.0.report, &page, beside)?;
        Ok([Some(json), Some(html), refitted, corrected, script].into_iter().flatten().collect())
    }
}
