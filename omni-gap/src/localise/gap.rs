//! The gap: errors of free runs restarted every horizon, in units of the sensors' sigma.

use model_core::plant::Plant;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;

use crate::simulate::{AlignedRun, HORIZON_S, MAX_CHANNELS, free_run, predict};

/// The signal groups, in the order of their channels.
pub const GROUPS: [&str; 3] = ["i", "w", "pose"];

/// Lengths between restarts of the horizon curves [s]
pub const HORIZONS_S: [f64; 5] = [0.1, 0.25, HORIZON_S, 1.0, 2.0];

/// Errors of a model on runs.
#[derive(Clone, Debug, Default)]
pub struct Measured {
    /// Per window (of all runs): Σ error² [σ²] and count, per group.
    pub windows: Vec<[(f64, f64); 3]>,
}

/// RMS of one group, and the RMS over the groups, of sums of squares.
fn rms(sums: &[(f64, f64); 3]) -> ([Option<f64>; 3], f64) {
    let groups = sums.map(|(sum, n)| (n > 0.0).then(|| (sum / n).sqrt()));
    let there: Vec<f64> = groups.iter().flatten().copied().collect();
    let total = (there.iter().map(|x| x * x).sum::<f64>() / there.len().max(1) as f64).sqrt();
    (groups, total)
}

impl Measured {
    fn sums(&self, pick: impl Iterator<Item = usize>) -> [(f64, f64); 3] {
        let mut sums = [(0.0, 0.0); 3];
        for k in pick {
            for (sum, part) in sums.iter_mut().zip(self.windows[k]) {
                *sum = (sum.0 + part.0, sum.1 + part.1);
            }
        }
        sums
    }

    /// RMS error of each group [σ]; `None` where it was not measured.
    pub fn groups(&self) -> [Option<f64>; 3] {
        rms(&self.sums(0..self.windows.len())).0
    }

    /// RMS over the groups [σ].
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
    let per_run: Vec<Vec<[(f64, f64); 3]>> = runs
        .par_iter()
        .map(|run| {
            let prediction = predict(plant, run, horizon);
            let mut windows = vec![[(0.0, 0.0); 3]; prediction.restarts.len()];
            let mut window = 0;
            for (row, predicted) in prediction.rows.iter().enumerate() {
                while prediction.restarts.get(window + 1).is_some_and(|next| *next <= row) {
                    window += 1;
                }
                for c in (0..MAX_CHANNELS.min(2 * N + 3)).filter(|c| run.saw(row, *c)) {
                    let group = &mut windows[window][(c / N).min(2)];
                    *group = (group.0 + run.error(row, c, predicted[c]).powi(2), group.1 + 1.0);
                }
            }
            windows
        })
        .collect();
    Measured { windows: per_run.into_iter().flatten().collect() }
}

/// Seed of the noise of simulated runs.
pub(super) const FLOOR_SEED: u64 = 20_080_511;

/// What the protocol would measure if the model were the truth: the same runs, simulated from it with the sensors' noise.
pub fn floor<const N: usize>(plant: &Plant<N, f64>, runs: &[&AlignedRun<N>], horizon: f64) -> Measured {
    measure(plant, &replayed(plant, runs, FLOOR_SEED).iter().collect::<Vec<_>>(), horizon)
}

/// The runs, simulated from a model with the sensors' noise.
pub(super) fn replayed<const N: usize>(
    plant: &Plant<N, f64>,
    runs: &[&AlignedRun<N>],
    seed: u64,
) -> Vec<AlignedRun<N>> {
    runs.par_iter().enumerate().map(|(k, run)| replay(plant, run, seed.wrapping_add(k as u64))).collect()
}

/// A run of the same input and the same holes, simulated from the model with white noise of the sensors' sigma.
fn replay<const N: usize>(plant: &Plant<N, f64>, run: &AlignedRun<N>, seed: u64) -> AlignedRun<N> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut replayed = run.clone();
    free_run(
        plant,
        run,
        &[0],
        |row| run.input(row),
        |row, passed| {
            let mut says = run.row_of(&passed.reading);
            for (c, x) in says.iter_mut().enumerate() {
                let noise: f64 = StandardNormal.sample(&mut random);
                *x += run.sigma[c] * noise;
            }
            replayed.measured[row] = says;
            if let Some(gyro) = &mut replayed.gyro[row] {
                *gyro = passed.reading.gyro;
            }
        },
    );
    replayed
}
