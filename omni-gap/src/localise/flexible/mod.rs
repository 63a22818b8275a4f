//! # Flexible: how much could be explained at all
//!
//! A model with a known cause closes so much of a gap. How much could any model close that is driven by the same command? A
//! flexible one says so: functions of what the model itself says (speeds, currents, accelerations, heading, place, time …), each
//! wheel's own beside those of all wheels, learned from what the model leaves of some runs and measured on others. It is told
//! nothing of physics, and names no cause: it says what a cause could still be worth.

mod basis;
mod errors;
mod features;
mod learned;
mod moments;
mod settings;
mod teacher;
#[cfg(test)]
mod tests;

pub use settings::FlexibleSettings;

use learned::Learned;
use model_core::plant::Plant;
use rayon::prelude::*;

use super::gap::{Measured, measured};
use crate::simulate::AlignedRun;

/// What a model leaves of `held` runs, less what a flexible model foretells of it that learned from `taught` runs: free runs
/// restarted every `horizon_s`.
pub fn flexible<const N: usize>(
    plant: &Plant<N, f64>,
    (taught, held): (&[&AlignedRun<N>], &[&AlignedRun<N>]),
    horizon_s: f64,
    settings: &FlexibleSettings,
) -> Measured {
    let learned = Learned::from(plant, taught, horizon_s, settings);
    let windows: Vec<_> = held
        .par_iter()
        .map(|run| {
            let (told, foretold) = learned.foretold(plant, run);
            measured(run, &told.restarts, |row, c| run.error(row, c, told.rows[row][c]) - foretold[row][c])
        })
        .collect();
    Measured { windows: windows.into_iter().flatten().collect() }
}
