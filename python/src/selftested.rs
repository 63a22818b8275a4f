//! `selftest`.

use std::path::PathBuf;

use omni_gap::api::{self, Driven, PlannedRuns, SelftestKnobs};
use omni_gap::report::{selftest_html, selftest_json, selftest_terminal, write_selftest};
use omni_gap::simulate::{SignalGroup, usual_voltage};
use pyo3::prelude::*;

use crate::robot::{Robot, within_supply};
use crate::run::Run;
use crate::work::{mistake, work};

/// What recordings could show.
#[pyclass(frozen, module = "omni_gap._omni_gap")]
#[derive(Debug)]
pub struct Selftested(api::SelfTest);

/// Recordings that somebody means to make.
#[derive(Debug, FromPyObject)]
pub struct Plan {
    #[pyo3(item)]
    runs: usize,
    #[pyo3(item)]
    duration_s: f64,
    #[pyo3(item)]
    rate_hz: f64,
    #[pyo3(item)]
    camera_hz: Option<f64>,
    #[pyo3(item("voltage_V"))]
    voltage_v: Option<f64>,
    #[pyo3(item)]
    sensors: Option<Vec<String>>,
    #[pyo3(item)]
    verify: bool,
}

/// Says what recordings of a robot could show: those of scripts, else random ones.
#[pyfunction]
pub fn selftest(py: Python<'_>, robot: &Robot, scripts: Vec<PyRef<'_, Run>>, plan: Plan) -> PyResult<Selftested> {
    let file = &robot.file;
    let mut planned = if scripts.is_empty() {
        let Plan { runs, duration_s: duration, rate_hz: rate, voltage_v, .. } = plan;
        let voltage = voltage_v.unwrap_or_else(|| usual_voltage(file));
        within_supply(voltage, file, robot.place())?;
        PlannedRuns::usual(Driven::Random { runs, duration, rate, voltage })
    } else {
        PlannedRuns::of_scripts(scripts.iter().map(|script| script.recording().clone()).collect())
    };
    if let Some(sensors) = &plan.sensors {
        planned.logged = logged(sensors)?;
    }
    planned.camera_rate = plan.camera_hz.unwrap_or(planned.camera_rate);
    work(py, move |progress| {
        progress("looking for every cause");
        let knobs = SelftestKnobs::default();
        let mut said = api::selftest(file, &planned, &knobs)?;
        if plan.verify {
            api::verify(file, &planned, &mut said, &knobs, progress)?;
        }
        Ok::<_, omni_gap::Error>(Selftested(said))
    })
}

/// The groups of these names, in their order.
fn logged(names: &[String]) -> PyResult<Vec<SignalGroup>> {
    if let Some(other) = names.iter().find(|name| SignalGroup::ALL.iter().all(|group| group.name() != **name)) {
        let expected = "expected i (currents), w (wheel speeds), pose, gyro or vbat";
        return Err(mistake(format!("sensors: found `{other}`, {expected}. Name some of these")));
    }
    Ok(SignalGroup::ALL.into_iter().filter(|group| names.iter().any(|name| name == group.name())).collect())
}

#[pymethods]
impl Selftested {
    /// The text of `selftest.json`.
    fn json(&self) -> String {
        selftest_json(&self.0)
    }

    /// What the command says in a terminal.
    fn text(&self) -> String {
        selftest_terminal(&self.0)
    }

    /// `selftest.html`.
    fn html(&self, py: Python<'_>) -> String {
        py.detach(|| selftest_html(&self.0))
    }

    /// Writes the files of the command into a folder.
    fn write(&self, py: Python<'_>, folder: PathBuf) -> PyResult<Vec<PathBuf>> {
        Ok(work(py, |_| write_selftest(&folder, &self.0))?.to_vec())
    }
}
