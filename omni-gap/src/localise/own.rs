//! The recording that a model makes of itself: what starts of free runs are wrong by.

use model_core::plant::Plant;

use super::floor::quiet;
use crate::simulate::{AlignedRun, FreeRun, Prediction, predict};

/// A run as a model makes it without noise, and what the model says of that.
///
/// A free run starts from a straight line through samples, which is wrong where the motion bends. Here it is wrong by nothing else.
pub(super) struct OwnRun<'a, const N: usize> {
    pub plant: &'a Plant<N, f64>,
    /// Between restarts of free runs [s]
    pub horizon_s: f64,
    pub run: AlignedRun<N>,
    pub told: Prediction,
}

impl<'a, const N: usize> OwnRun<'a, N> {
    /// Of the input and the holes of another.
    pub fn of(plant: &'a Plant<N, f64>, run: &AlignedRun<N>, horizon_s: f64) -> Self {
        let run = quiet(FreeRun::new(plant, run));
        let told = predict(plant, &run, horizon_s);
        Self { plant, horizon_s, run, told }
    }

    /// The error that the start of its window makes on a row [σ].
    pub fn error(&self, row: usize, channel: usize) -> f64 {
        self.run.error(row, channel, self.told.rows[row][channel])
    }

    /// What the model says of a recording of the same rows.
    pub fn predict(&self, run: &AlignedRun<N>) -> Prediction {
        predict(self.plant, run, self.horizon_s)
    }

    /// The error of that on a row, less what the start of its window makes of it [σ].
    pub fn less(&self, run: &AlignedRun<N>, told: &Prediction, (row, channel): (usize, usize)) -> f64 {
        run.error(row, channel, told.rows[row][channel]) - self.error(row, channel)
    }
}
