//! A fit whose dispersion suits what it finds.
//!
//! The first fit trusts what was stated and lets the data pull only gently; then the dispersion is brought, step by step, to
//! what the errors that are left say it should be.

use model_core::plant::robot::Nominal;

use super::fit::{Fit, FitOptions, Free, fit_on};
use super::linear::linearise;
use super::prior::Prior;
use super::settings::FitSettings;
use super::shoot::Shots;
use super::starts::{profile, starts_of};
use crate::simulate::{Model, Slot};

/// All nominal factors, free within what is believable.
pub fn nominal_free(settings: &FitSettings) -> Vec<Free> {
    Nominal::ALL.iter().map(|p| Free { slot: Slot::Nominal(*p), within: settings.believable }).collect()
}

/// Fits a model within what was stated; `from` is a fit of a model like it, to start from.
pub fn fit_with_dispersion<const N: usize>(
    model: Model<N>,
    shots: Shots<'_, N>,
    from: Option<&Fit<N>>,
    free: &[Free],
    prior: &Prior,
    settings: &FitSettings,
) -> Fit<N> {
    let mut dispersion = from.map_or_else(|| settings.caution * misfit(&model, shots, settings), |f| f.spread);
    let options = |dispersion| FitOptions { free, prior, dispersion, rounds: settings.rounds, by_window: false };
    let starts = match from {
        Some(fit) => fit.starts.clone(),
        None => starts_of(&model, shots),
    };
    let slots: Vec<Slot> = free.iter().map(|f| f.slot).collect();
    let linear = linearise(&model, shots, &starts, &slots, false);
    let (mut fitted, mut linear) = fit_on((model, starts, linear), shots, options(dispersion));
    for _ in 0..settings.temperings {
        if (fitted.spread / dispersion).ln().abs() < settings.settled {
            break;
        }
        dispersion = fitted.spread;
        let Fit { model, starts, .. } = fitted;
        (fitted, linear) = fit_on((model, starts, linear), shots, options(dispersion));
    }
    fitted
}

/// Σ error² per number of a model as it is, its starts free; at least one.
fn misfit<const N: usize>(model: &Model<N>, shots: Shots<'_, N>, settings: &FitSettings) -> f64 {
    let (_, windows) = profile(model, shots, settings);
    let (cost, n) = windows.iter().flatten().fold((0.0, 0), |(c, n), w| (c + w.0, n + w.1));
    (cost / n.max(1) as f64).max(1.0)
}
