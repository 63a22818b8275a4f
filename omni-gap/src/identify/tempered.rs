//! A fit whose temper suits what it finds.
//!
//! The first fit trusts what was stated and lets the data pull only gently; then the temper is brought, step by step, to
//! what the errors that are left say it should be.

use model_core::plant::robot::Nominal;

use super::fit::{Fit, Free, fit, profile};
use super::prior::Prior;
use super::shoot::Shots;
use crate::simulate::{Model, Slot};

/// Rounds of a fit at one temper.
const ROUNDS: usize = 6;
/// Times that the temper is brought to what the fit sees, at the most.
const TEMPERINGS: usize = 8;
/// A first fit starts from what was stated: its temper is this many times what the errors alone suggest.
const CAUTION: f64 = 300.0;
/// The temper stays when its logarithm would move by less than this.
const SETTLED: f64 = 0.2;
/// A nominal value is not believed to be off by more than these factors.
const BELIEVABLE: (f64, f64) = (0.1, 4.0);

/// All nominal factors, free within what is believable.
pub fn nominal_free() -> Vec<Free> {
    Nominal::ALL.iter().map(|p| Free { slot: Slot::Nominal(*p), within: BELIEVABLE }).collect()
}

/// Fits a model within what was stated; `from` is a fit of a model like it, to start from.
pub fn fit_tempered<const N: usize>(
    model: Model<N>,
    shots: Shots<'_, N>,
    from: Option<&Fit<N>>,
    free: &[Free],
    prior: &Prior,
) -> Fit<N> {
    let mut temper = from.map_or_else(|| CAUTION * misfit(&model, shots), |f| f.spread);
    let starts = from.map(|f| f.starts.clone());
    let mut fitted = fit(model, shots, starts, free, prior, temper, ROUNDS);
    for _ in 0..TEMPERINGS {
        if (fitted.spread / temper).ln().abs() < SETTLED {
            break;
        }
        temper = fitted.spread;
        let Fit { model, starts, .. } = fitted;
        fitted = fit(model, shots, Some(starts), free, prior, temper, ROUNDS);
    }
    fitted
}

/// Σ error² per number of a model as it is, its starts free; at least one.
fn misfit<const N: usize>(model: &Model<N>, shots: Shots<'_, N>) -> f64 {
    let (_, windows) = profile(model, shots);
    let (cost, n) = windows.iter().flatten().fold((0.0, 0), |(c, n), w| (c + w.0, n + w.1));
    (cost / n.max(1) as f64).max(1.0)
}
