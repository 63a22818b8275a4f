//! A recording, and what a model says of it: `predict` and `simulate`.

use std::path::PathBuf;

use omni_gap::api::{self, with_blank_columns, with_columns_of_its_header};
use omni_gap::log::{self, Missing, write_run};
use pyo3::prelude::*;
use pyo3::types::PyByteArray;

use crate::robot::Robot;
use crate::session::Mapping;
use crate::table::Table;
use crate::work::work;

/// A recording.
#[pyclass(frozen, module = "omni_gap._omni_gap")]
#[derive(Debug)]
pub struct Run {
    run: log::Run,
    /// What was left out, or taken as absent, when it was read.
    notices: Vec<String>,
    /// Columns of its table that are there and blank.
    named: Vec<&'static str>,
    /// Whether it was read through a mapping.
    mapped: bool,
}

/// Columns by which a group is asked for though all of it is blank.
const ASKED_BY: [&str; 3] = ["i0_A", "w0_rad_s", "x_m"];

#[pymethods]
impl Run {
    /// Reads a run of a robot.
    #[staticmethod]
    fn open(py: Python<'_>, path: PathBuf, robot: &Robot, columns: Option<Mapping>) -> PyResult<Self> {
        let mapped = columns.is_some();
        let (run, notices) = work(py, move |_| {
            let columns = columns.as_ref().map(Mapping::read).transpose()?;
            log::Run::open(&path, &robot.file, columns.as_ref()).map_err(|why| why.to_string())
        })?;
        Ok(Self { run, notices, named: Vec::new(), mapped })
    }

    /// Makes a run of a recording in memory, and empties its table.
    #[staticmethod]
    fn of_table(py: Python<'_>, table: &Bound<'_, Table>, robot: &Robot, columns: Option<Mapping>) -> PyResult<Self> {
        let table = table.borrow_mut().take()?;
        let named = ASKED_BY.into_iter().filter(|column| table.has(column)).collect();
        let (mapped, wheels) = (columns.is_some(), robot.file.wheel.len());
        let (run, notices) = work(py, move |_| {
            let columns = columns.as_ref().map(Mapping::read).transpose()?;
            log::Run::of_table(table, wheels, columns.as_ref()).map_err(|why| why.to_string())
        })?;
        Ok(Self { run, notices, named, mapped })
    }

    /// Its name.
    #[getter]
    fn name(&self) -> &str {
        &self.run.name
    }

    /// What was left out, or taken as absent, when it was read.
    #[getter]
    fn notices(&self) -> Vec<String> {
        self.notices.clone()
    }

    /// Its columns in the order of a run log: name and doubles, as bytes in the machine's order; NaN is a sample that is missing.
    fn columns<'py>(&self, py: Python<'py>) -> Vec<(String, Bound<'py, PyByteArray>)> {
        let bytes = |values: &mut dyn Iterator<Item = f64>| {
            let all: Vec<u8> = values.flat_map(f64::to_ne_bytes).collect();
            PyByteArray::new(py, &all)
        };
        let value = |sample: Result<f64, Missing>| sample.unwrap_or(f64::NAN);
        let clock = ("t_s".to_owned(), bytes(&mut self.run.t_s.iter().copied()));
        let signals = self.run.signals();
        let others = signals.into_iter().map(|(name, channel)| (name, bytes(&mut channel.iter().map(value))));
        std::iter::once(clock).chain(others).collect()
    }

    /// Writes it as the commands do, in the format that the file's name says.
    fn write(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        work(py, |_| write_run(&path, &self.run))
    }
}

impl Run {
    /// The recording.
    pub fn recording(&self) -> &log::Run {
        &self.run
    }

    fn made(run: log::Run) -> Self {
        Self { run, notices: Vec::new(), named: Vec::new(), mapped: false }
    }
}

/// Predicts the measured columns of a run.
#[pyfunction]
pub fn predict(py: Python<'_>, robot: &Robot, run: &Run, horizon_s: f64) -> PyResult<Run> {
    work(py, |_| {
        let (mut asked, wheels) = (run.run.clone(), robot.file.wheel.len());
        if !run.mapped {
            with_blank_columns(&mut asked, wheels, &|column| run.named.contains(&column));
            with_columns_of_its_header(&mut asked, wheels);
        }
        api::predict(&robot.file, &asked, horizon_s)
    })
    .map(Run::made)
}

/// Records what a robot does with a run's inputs.
#[pyfunction]
pub fn simulate(py: Python<'_>, robot: &Robot, run: &Run, noise_seed: Option<u64>) -> PyResult<Run> {
    work(py, |_| api::simulate(&robot.file, &run.run, noise_seed)).map(Run::made)
}
