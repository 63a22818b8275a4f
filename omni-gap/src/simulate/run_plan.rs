//! A run that somebody means to make: recorded by any robot, as often as one likes.

use model_core::plant::{Input, Plant};

use super::record::{SensorSetup, record};
use crate::log::Run;

/// What drives a robot, row by row, and how that is recorded.
#[derive(Clone, Debug)]
pub struct RunPlan<const N: usize> {
    /// The run's name.
    pub name: String,
    /// Time of each row [s]
    pub t: Vec<f64>,
    /// What is held from each row to the next.
    pub input: Vec<Input<N, f64>>,
    /// Its sensors.
    pub how: SensorSetup,
    /// Seed of their noise and gaps.
    pub seed: u64,
}

impl<const N: usize> RunPlan<N> {
    /// What is recorded of a robot.
    pub fn recorded_of(&self, plant: &Plant<N, f64>) -> Run {
        record(plant, &self.name, &self.t, &self.input, &self.how, self.seed)
    }
}
