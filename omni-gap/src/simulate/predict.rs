//! Free-run prediction with restarts: the protocol by which the gap is measured.
//!
//! Every horizon H the run restarts from the smoothed measurement; in between it is driven by the recorded input alone.

use std::ops::Range;

use model_core::plant::Plant;

use super::aligned_run::AlignedRun;
use super::channels::{PerGroup, Row, SignalGroup};
use super::free_run::free_run;

/// Time between restarts of the free runs by which a gap is measured [s]
pub const HORIZON_S: f64 = 0.5;

/// What a model predicts for every row of a run.
#[derive(Clone, Debug)]
pub struct Prediction {
    /// One row of channels a row of the run.
    pub rows: Vec<Row>,
    /// Bus voltage of every row [V]
    pub bus: Vec<f64>,
    /// The rows at which the free run restarted.
    pub restarts: Vec<usize>,
}

/// Lets the plant run freely along a recording, restarted every `horizon` [s].
pub fn predict<const N: usize>(plant: &Plant<N, f64>, run: &AlignedRun<N>, horizon: f64) -> Prediction {
    let restarts = run.restart_rows(horizon);
    let mut rows = Vec::with_capacity(run.rows());
    let mut bus = Vec::with_capacity(run.rows());
    free_run(
        plant,
        run,
        &restarts,
        |row| run.input(row),
        |_, passed| {
            rows.push(run.row_of(passed));
            bus.push(passed.bus);
        },
    );
    Prediction { rows, bus, restarts }
}

impl Prediction {
    /// The rows of each free run, from its restart to the next.
    pub(crate) fn windows(&self) -> impl Iterator<Item = Range<usize>> {
        let ends = self.restarts.iter().copied().skip(1).chain(std::iter::once(self.rows.len()));
        self.restarts.iter().copied().zip(ends).map(|(first, end)| first..end)
    }

    /// Sum of squared errors [σ²] and their number, of each group.
    pub fn squares<const N: usize>(&self, run: &AlignedRun<N>) -> PerGroup<(f64, f64)> {
        let channels = AlignedRun::<N>::channels();
        let mut sums = [(0.0, 0.0); SignalGroup::COUNT];
        for (row, predicted) in self.rows.iter().enumerate() {
            for c in (0..channels.count()).filter(|c| run.saw(row, *c)) {
                let e = run.error(row, c, predicted[c]);
                let group = &mut sums[channels.group(c) as usize];
                *group = (group.0 + e * e, group.1 + 1.0);
            }
        }
        sums
    }
}
