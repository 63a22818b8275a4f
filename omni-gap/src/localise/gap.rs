//! The gap: errors of free runs restarted every horizon, in units of the sensors' sigma.

use model_core::plant::Plant;
use rayon::prelude::*;

use crate::simulate::{AlignedRun, HORIZON_S, PerGroup, SignalGroup, predict};

/// Lengths between restarts of the horizon curves [s]
pub const HORIZONS_S: [f64; 5] = [0.1, 0.25, HORIZON_S, 1.0, 2.0];

/// Errors of a model on runs.
#[derive(Clone, Debug, Default)]
pub struct Measured {
    /// Per window (of all runs): Σ error² [σ²] and count, per group.
    pub windows: Vec<PerGroup<(f64, f64)>>,
}

/// RMS of each group, and the RMS over those that count in totals, of sums of squares.
fn rms(sums: &PerGroup<(f64, f64)>) -> (PerGroup<Option<f64>>, f64) {
    let groups = sums.map(|(sum, n)| (n > 0.0).then(|| (sum / n).sqrt()));
    let counted = SignalGroup::ALL.into_iter().filter(|group| group.in_totals());
    let there: Vec<f64> = counted.filter_map(|group| groups[group as usize]).collect();
    let total = (there.iter().map(|x| x * x).sum::<f64>() / there.len().max(1) as f64).sqrt();
    (groups, total)
}

impl Measured {
    /// Both together, window by window, of recordings of the same windows.
    pub(super) fn and(mut self, other: Self) -> Self {
        for (sum, part) in self.windows.iter_mut().flatten().zip(other.windows.iter().flatten()) {
            *sum = (sum.0 + part.0, sum.1 + part.1);
        }
        self
    }

    fn sums(&self, pick: impl Iterator<Item = usize>) -> PerGroup<(f64, f64)> {
        let mut sums = [(0.0, 0.0); SignalGroup::COUNT];
        for k in pick {
            for (sum, part) in sums.iter_mut().zip(self.windows[k]) {
                *sum = (sum.0 + part.0, sum.1 + part.1);
            }
        }
        sums
    }

    /// RMS error of each group [σ]; `None` where it was not measured.
    pub fn groups(&self) -> PerGroup<Option<f64>> {
        rms(&self.sums(0..self.windows.len())).0
    }

    /// RMS over the groups that count in totals [σ].
    pub fn total(&self) -> f64 {
        rms(&self.sums(0..self.windows.len())).1
    }

    /// The total of a resampling of the windows [σ].
    pub fn total_of(&self, windows: &[usize]) -> f64 {
        rms(&self.sums(windows.iter().copied())).1
    }
}

/// Measures a model on runs: free runs restarted every `horizon` [s].
pub fn measure<const N: usize>(plant: &Plant<N, f64>, runs: &[&AlignedRun<N>], horizon: f64) -> Measured {
    let per_run: Vec<Vec<PerGroup<(f64, f64)>>> = runs
        .par_iter()
        .map(|run| {
            let prediction = predict(plant, run, horizon);
            measured(run, &prediction.restarts, |row, c| run.error(row, c, prediction.rows[row][c]))
        })
        .collect();
    Measured { windows: per_run.into_iter().flatten().collect() }
}

/// Sums of the squares of a run's errors [σ as models are weighed by], in stated units, window by window.
pub(super) fn measured<const N: usize>(
    run: &AlignedRun<N>,
    restarts: &[usize],
    error: impl Fn(usize, usize) -> f64,
) -> Vec<PerGroup<(f64, f64)>> {
    let channels = AlignedRun::<N>::channels();
    let mut windows = vec![[(0.0, 0.0); SignalGroup::COUNT]; restarts.len()];
    let mut window = 0;
    for row in 0..run.rows() {
        while restarts.get(window + 1).is_some_and(|next| *next <= row) {
            window += 1;
        }
        for c in (0..channels.count()).filter(|c| run.saw(row, *c)) {
            let group = &mut windows[window][channels.group(c) as usize];
            let error = error(row, c) * (run.sigma[c] / run.stated[c]);
            *group = (group.0 + error.powi(2), group.1 + 1.0);
        }
    }
    windows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn recordings_of_the_same_windows_have_the_mean_of_their_squares() {
        let of = |errors: [f64; 2]| {
            let window = |error: f64| {
                let mut sums = [(0.0, 0.0); SignalGroup::COUNT];
                sums[SignalGroup::Pose as usize] = (4.0 * error * error, 4.0);
                sums
            };
            Measured { windows: errors.map(window).to_vec() }
        };
        let both = of([1.0, 2.0]).and(of([3.0, 2.0]));
        assert!((both.total() - (18.0_f64 / 4.0).sqrt()).abs() < 1e-12);
        assert!((both.total_of(&[0]) - 5.0_f64.sqrt()).abs() < 1e-12);
    }
}
