//! Columns of numbers that Python has in memory.

use omni_gap::log;
use pyo3::prelude::*;

use crate::arrow::{self, there};
use crate::work::mistake;

/// A recording in memory that is being put together; whoever reads it takes what is in it.
#[pyclass(module = "omni_gap._omni_gap")]
#[derive(Debug)]
pub struct Table(Option<log::Table>);

#[pymethods]
impl Table {
    /// A table without columns.
    #[new]
    fn new(name: &str) -> Self {
        Self(Some(log::Table::new(name)))
    }

    /// Adds a column of doubles, as bytes in the machine's order; NaN is a sample that is missing.
    fn add(&mut self, column: &str, doubles: &[u8]) -> PyResult<()> {
        let values = doubles.as_chunks::<8>().0.iter().map(|bytes| there(f64::from_ne_bytes(*bytes)));
        self.open()?.add(column, values).map_err(mistake)
    }

    /// Adds a column that holds no numbers but `what`.
    fn add_other(&mut self, column: &str, what: &str) -> PyResult<()> {
        self.open()?.add_other(column, what).map_err(mistake)
    }

    /// Adds the columns of anything with `__arrow_c_stream__`, read where they lie.
    fn add_arrow(&mut self, stream: &Bound<'_, PyAny>) -> PyResult<()> {
        arrow::add(self.open()?, stream)
    }
}

impl Table {
    fn open(&mut self) -> PyResult<&mut log::Table> {
        self.0.as_mut().ok_or_else(|| mistake("this table was read already: make it again"))
    }

    /// What is in it.
    pub fn take(&mut self) -> PyResult<log::Table> {
        self.0.take().ok_or_else(|| mistake("this table was read already: make it again"))
    }
}
