//! What it costs to drive a model by a measured signal instead of the command.
//!
//! A command is known exactly. A measured current has noise, which goes into the motion and not into a reading, and it
//! is known at one instant of a row, not what it was in between. Neither shows in what a fit leaves over. Both are put in
//! on purpose, and it is seen how far the numbers move:
//!
//! ```text
//! Δp = S⁻¹·(g(changed input) − g(input))        S, g: the normal equations, starts eliminated
//! ```
//!
//! The noise is drawn a few times, by its own sigma; the time at which the input acts counts as known to a row.

use nalgebra::{DMatrix, DVector};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::linear::linearise;
use super::shoot::{Shots, Starts};
use crate::simulate::{AlignedRun, Chain, Model, Slot};

/// Draws of the noise: the spread is known to a third, which is enough for an uncertainty.
const DRAWS: u64 = 6;

/// Relative one-sigma that each number of `slots` has from an input that was measured; zero where all was commanded.
///
/// `inverse` is the inverse of the information per relative change of the numbers `seen`.
pub(super) fn by_input<const N: usize>(
    model: &Model<N>,
    shots: Shots<'_, N>,
    starts: &[Starts],
    slots: &[Slot],
    inverse: &DMatrix<f64>,
    seen: &[usize],
) -> Vec<f64> {
    let mut square = vec![0.0; seen.len()];
    if shots.runs.iter().all(|run| run.chain == Chain::Voltage) {
        return square;
    }
    let pull = |runs: &[AlignedRun<N>]| -> DVector<f64> {
        let runs: Vec<&AlignedRun<N>> = runs.iter().collect();
        let grad = linearise(model, Shots { runs: &runs, windows: shots.windows }, starts, slots, false).reduced().grad;
        DVector::from_iterator(seen.len(), seen.iter().map(|k| grad[*k] * model.get(slots[*k])))
    };
    let changed = |change: &mut dyn FnMut(&mut AlignedRun<N>)| -> Vec<AlignedRun<N>> {
        let mut runs: Vec<AlignedRun<N>> = shots.runs.iter().map(|run| (*run).clone()).collect();
        runs.iter_mut().filter(|run| run.chain != Chain::Voltage).for_each(change);
        runs
    };
    let here = pull(&changed(&mut |_| {}));
    let mut add = |runs: &[AlignedRun<N>], weight: f64| {
        let moved = inverse * (pull(runs) - &here);
        for (sum, moved) in square.iter_mut().zip(moved.iter()) {
            *sum += weight * moved * moved;
        }
    };
    for draw in 0..DRAWS {
        let mut random = ChaCha8Rng::seed_from_u64(draw);
        let mut noise = || -> f64 { StandardNormal.sample(&mut random) };
        let noisy = changed(&mut |run| {
            let first = if run.chain == Chain::Current { 0 } else { N };
            for input in &mut run.input {
                for (j, x) in input.iter_mut().enumerate() {
                    *x += run.sigma[first + j] * noise();
                }
            }
        });
        add(&noisy, 1.0 / DRAWS as f64);
    }
    let earlier = changed(&mut |run| {
        let rows = run.input.len();
        run.input.copy_within(1.min(rows).., 0);
    });
    add(&earlier, 1.0);
    square.into_iter().map(f64::sqrt).collect()
}
