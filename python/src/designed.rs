//! `next`.

use std::path::{Path, PathBuf};

use omni_gap::api::{self, DesignKnobs, design_report};
use omni_gap::engine::Knobs;
use omni_gap::report::design::{self as report, DesignReport, script_csv};
use omni_gap::{Options, log};
use pyo3::prelude::*;

use crate::robot::within_supply;
use crate::session::Session;
use crate::work::work;

/// What to record or measure next.
#[pyclass(frozen, module = "omni_gap._omni_gap")]
#[derive(Debug)]
pub struct Designed {
    report: DesignReport,
    script: Option<log::Run>,
}

/// What may be played.
#[derive(Debug, FromPyObject)]
pub struct Wish {
    #[pyo3(item)]
    duration_s: f64,
    #[pyo3(item("voltage_V"))]
    voltage_v: Option<f64>,
    #[pyo3(item)]
    field_m: Option<f64>,
    #[pyo3(item)]
    without: Vec<String>,
}

/// Says what to record or measure so that what a session leaves open is settled.
#[pyfunction]
pub fn next(
    py: Python<'_>,
    session: PyRef<'_, Session>,
    also: Vec<PyRef<'_, Session>>,
    wish: Wish,
) -> PyResult<Designed> {
    let also: Vec<_> = also.iter().map(|more| more.named()).collect();
    if let Some(voltage) = wish.voltage_v {
        let place = session.session.files.first().map_or(Path::new("robot"), PathBuf::as_path);
        within_supply(voltage, &session.session.robot, place)?;
    }
    let (name, session) = (session.name.clone(), &session.session);
    work(py, move |progress| {
        let mut engine = Knobs::default();
        engine.screen.without = wish.without;
        let Wish { duration_s: duration, voltage_v: voltage, field_m: field, .. } = wish;
        let mut knobs = DesignKnobs { duration, voltage, field, ..DesignKnobs::default() };
        knobs.selftest.engine = engine.clone();
        let options = Options { session: name, also: &also, knobs: engine, progress };
        let (diagnosis, designed) = api::next(session, &options, &knobs);
        let (report, script) = design_report(diagnosis, designed);
        Ok::<_, omni_gap::Error>(Designed { report, script })
    })
}

#[pymethods]
impl Designed {
    /// The text of `next.json`.
    fn json(&self) -> String {
        self.report.to_json()
    }

    /// What the command says in a terminal.
    fn text(&self) -> String {
        report::terminal(&self.report, &[])
    }

    /// `next.html`.
    fn html(&self, py: Python<'_>) -> String {
        py.detach(|| report::html(&self.report, self.script.as_ref()))
    }

    /// `next_experiment.csv`, where there is something to play.
    #[getter]
    fn script(&self) -> Option<String> {
        self.script.as_ref().map(script_csv)
    }

    /// Writes the files of the command into a folder.
    fn write(&self, py: Python<'_>, folder: PathBuf) -> PyResult<Vec<PathBuf>> {
        work(py, |_| {
            let page = report::html(&self.report, self.script.as_ref());
            report::write(&folder, &self.report, &page, self.script.as_ref())
        })
    }
}
