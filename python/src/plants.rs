//! Robots that are stepped side by side.

use omni_gap::api::{self, Reset};
use pyo3::prelude::*;
use pyo3::types::PyByteArray;

use crate::robot::Robot;
use crate::work::mistake;

/// Robots that are stepped side by side.
#[pyclass(module = "omni_gap._omni_gap")]
#[derive(Debug)]
pub struct Plants {
    plants: api::Plants,
    // kept from call to call
    volts: Vec<f64>,
    bytes: Vec<u8>,
}

#[pymethods]
impl Plants {
    /// One plant for each robot; `supply` [V] is assumed where a file states none.
    #[new]
    fn new(robots: Vec<PyRef<'_, Robot>>, copies: usize, supply: Option<f64>) -> PyResult<Self> {
        let each = robots.iter().flat_map(|robot| std::iter::repeat_n(&robot.file, copies));
        let plants = api::Plants::new(&each.collect::<Vec<_>>(), supply).map_err(mistake)?;
        Ok(Self { plants, volts: Vec::new(), bytes: Vec::new() })
    }

    /// How many robots there are, and how many wheels each has.
    #[getter]
    fn shape(&self) -> (usize, usize) {
        (self.plants.count(), self.plants.wheels())
    }

    /// Puts the robots where they are to begin: six doubles each, as bytes in the machine's order; none: at rest in the origin.
    fn reset(&mut self, states: Option<&[u8]>, seed: u64) -> PyResult<()> {
        let numbers: Vec<f64> = doubles(states.unwrap_or_default()).collect();
        let states = numbers.as_chunks::<6>().0;
        if !states.is_empty() && states.len() != self.plants.count() {
            return Err(mistake("one state of six numbers for each robot was expected"));
        }
        if let Some(robot) = states.iter().position(|state| state.iter().any(|x| !x.is_finite())) {
            return Err(mistake(format!(
                "state: robot {robot}: found a number that is not finite. Correct the number"
            )));
        }
        self.plants.reset(&Reset { states, seed });
        Ok(())
    }

    /// Holds voltages [V], doubles as bytes in the machine's order, for `dt_s` [s], in so many steps; the states after it, as bytes.
    fn step<'py>(
        &mut self,
        py: Python<'py>,
        volts: &[u8],
        dt_s: f64,
        steps: usize,
    ) -> PyResult<Bound<'py, PyByteArray>> {
        let Self { plants, volts: held, bytes } = self;
        held.clear();
        held.extend(doubles(volts));
        if held.len() != plants.count() * plants.wheels() {
            return Err(mistake("one voltage for each wheel of each robot was expected"));
        }
        if let Some(at) = held.iter().position(|volts| !volts.is_finite()) {
            let (robot, wheel, found) = (at / plants.wheels(), at % plants.wheels(), held[at]);
            return Err(mistake(format!(
                "voltages: robot {robot}, wheel {wheel}: found {found}, expected a finite number. Correct the number"
            )));
        }
        py.detach(|| {
            plants.step(held, dt_s, steps);
            bytes.clear();
            plants.state_bytes(bytes);
        });
        Ok(PyByteArray::new(py, bytes))
    }

    /// Where the robots are, as bytes.
    fn state<'py>(&mut self, py: Python<'py>) -> Bound<'py, PyByteArray> {
        self.bytes.clear();
        self.plants.state_bytes(&mut self.bytes);
        PyByteArray::new(py, &self.bytes)
    }

    /// The names of a state's numbers.
    #[classattr]
    #[pyo3(name = "STATE")]
    fn state_columns() -> [&'static str; 6] {
        api::Plants::STATE
    }

    /// What the sensors said at the beginning of the last step, as bytes.
    fn reading<'py>(&self, py: Python<'py>) -> Bound<'py, PyByteArray> {
        let bytes: Vec<u8> = self.plants.reading().into_iter().flat_map(f64::to_ne_bytes).collect();
        PyByteArray::new(py, &bytes)
    }

    /// The names of a reading's numbers.
    fn reading_columns(&self) -> Vec<String> {
        self.plants.reading_columns()
    }
}

fn doubles(bytes: &[u8]) -> impl Iterator<Item = f64> {
    bytes.as_chunks::<8>().0.iter().map(|bytes| f64::from_ne_bytes(*bytes))
}
