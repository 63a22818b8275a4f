//! The gap: errors of free runs restarted every horizon, in units of the sensors' sigma.

use model_core::plant::Plant;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;

use crate::simulate::{AlignedRun, FreeRun, HORIZON_S, MAX_CHANNELS, PerGroup, Row, RowPassed, SignalGroup, predict};

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
    let channels = AlignedRun::<N>::channels();
    let per_run: Vec<Vec<PerGroup<(f64, f64)>>> = runs
        .par_iter()
        .map(|run| {
            let prediction = predict(plant, run, horizon);
            let mut windows = vec![[(0.0, 0.0); SignalGroup::COUNT]; prediction.restarts.len()];
            let mut window = 0;
            for (row, predicted) in prediction.rows.iter().enumerate() {
                while prediction.restarts.get(window + 1).is_some_and(|next| *next <= row) {
                    window += 1;
                }
                for c in (0..channels.count()).filter(|c| run.saw(row, *c)) {
                    let group = &mut windows[window][channels.group(c) as usize];
                    let error = run.error(row, c, predicted[c]) * (run.sigma[c] / run.stated[c]);
                    *group = (group.0 + error.powi(2), group.1 + 1.0);
                }
            }
            windows
        })
        .collect();
    Measured { windows: per_run.into_iter().flatten().collect() }
}

/// Seed of the noise of simulated runs.
pub const FLOOR_SEED: u64 = 20_080_511;

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
    let replayed = |(k, run): (usize, &&AlignedRun<N>)| replay(FreeRun::new(plant, run), seed.wrapping_add(k as u64));
    runs.par_iter().enumerate().map(replayed).collect()
}

/// A run of the same input and the same holes as that which a plant is about to go along, as the plant says it.
pub(super) fn quiet<const N: usize>(mut on_the_way: FreeRun<'_, N, f64>) -> AlignedRun<N> {
    let run = on_the_way.run();
    let mut quiet = run.clone();
    let each = |row: usize, passed: &RowPassed<N, f64>| quiet.measured[row] = run.row_of(passed);
    on_the_way.drive(0..run.rows(), &[0], |row| run.input(row), each);
    quiet
}

/// The same with the sensors' noise: of its sigma, and with its memory.
///
/// ```text
/// n_k = ρ·n_{k−1} + σ·√(1 − ρ²)·e_k,  ρ = e^(−Δt/τ)
/// ```
pub fn replay<const N: usize>(on_the_way: FreeRun<'_, N, f64>, seed: u64) -> AlignedRun<N> {
    // a stream for each channel: one more of them changes nothing of the others
    let stream = |channel: usize| {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(channel as u64);
        random
    };
    let mut random: Vec<ChaCha8Rng> = (0..AlignedRun::<N>::channels().count()).map(stream).collect();
    let mut replayed = quiet(on_the_way);
    let mut noise: Option<Row> = None;
    for row in 0..replayed.rows() {
        let mut now = [0.0; MAX_CHANNELS];
        for (c, random) in random.iter_mut().enumerate() {
            let fresh: f64 = StandardNormal.sample(random);
            now[c] = match noise {
                Some(before) if replayed.correlation_time[c] > 0.0 => {
                    let ratio = (replayed.t[row] - replayed.t[row - 1]) / replayed.correlation_time[c];
                    (-ratio).exp() * before[c] + (-(-2.0 * ratio).exp_m1()).sqrt() * fresh
                }
                _ => fresh,
            };
            replayed.measured[row][c] += replayed.sigma[c] * now[c];
        }
        noise = Some(now);
    }
    replayed
}
