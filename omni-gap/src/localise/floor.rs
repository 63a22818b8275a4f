//! The noise floor: what a perfect model would get, since starts and measurements have noise.

use model_core::plant::Plant;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;

use super::gap::{Measured, measure};
use crate::simulate::{AlignedRun, FreeRun, MAX_CHANNELS, Row, RowPassed};

/// Seed of the noise of simulated runs.
pub const FLOOR_SEED: u64 = 20_080_511;

/// How often the runs are simulated for a floor: where poses are coarse, one recording of a few runs is a tenth off by its noise.
pub(super) const FLOOR_DRAWS: u64 = 8;

/// What the protocol would measure if the model were the truth: the same runs, simulated from it with the sensors' noise, each
/// as often as it takes for a mean; window by window.
pub fn floor<const N: usize>(plant: &Plant<N, f64>, runs: &[&AlignedRun<N>], horizon: f64) -> Measured {
    let quiet: Vec<AlignedRun<N>> = runs.par_iter().map(|run| quiet(FreeRun::new(plant, run))).collect();
    let drawn = |draw: u64| {
        let seed = |run: usize| FLOOR_SEED.wrapping_add(draw * runs.len() as u64 + run as u64);
        let noisy: Vec<AlignedRun<N>> =
            quiet.par_iter().enumerate().map(|(run, quiet)| noisy(quiet.clone(), seed(run))).collect();
        measure(plant, &noisy.iter().collect::<Vec<_>>(), horizon)
    };
    (0..FLOOR_DRAWS).map(drawn).reduce(Measured::and).unwrap_or_default()
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

/// The same with the sensors' noise.
pub fn replay<const N: usize>(on_the_way: FreeRun<'_, N, f64>, seed: u64) -> AlignedRun<N> {
    noisy(quiet(on_the_way), seed)
}

/// A run with noise on it: of its sigma, and with its memory.
///
/// ```text
/// n_k = ρ·n_{k−1} + σ·√(1 − ρ²)·e_k,  ρ = e^(−Δt/τ)
/// ```
pub(super) fn noisy<const N: usize>(mut run: AlignedRun<N>, seed: u64) -> AlignedRun<N> {
    // a stream for each channel: one more of them changes nothing of the others
    let stream = |channel: usize| {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(channel as u64);
        random
    };
    let mut random: Vec<ChaCha8Rng> = (0..AlignedRun::<N>::channels().count()).map(stream).collect();
    let mut noise: Option<Row> = None;
    for row in 0..run.rows() {
        let mut now = [0.0; MAX_CHANNELS];
        for (c, random) in random.iter_mut().enumerate() {
            let fresh: f64 = StandardNormal.sample(random);
            now[c] = match noise {
                Some(before) if run.correlation_time[c] > 0.0 => {
                    let ratio = (run.t[row] - run.t[row - 1]) / run.correlation_time[c];
                    (-ratio).exp() * before[c] + (-(-2.0 * ratio).exp_m1()).sqrt() * fresh
                }
                _ => fresh,
            };
            run.measured[row][c] += run.sigma[c] * now[c];
        }
        noise = Some(now);
    }
    run
}
