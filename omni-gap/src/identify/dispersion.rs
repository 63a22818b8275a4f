//! A fit whose dispersion suits what it finds.
//!
//! The first fit trusts what was stated and lets the data pull only gently; then the dispersion is brought, step by step, to
//! what the errors that are left say it should be.

use model_core::effects::card::Role;
use model_core::plant::robot::Nominal;

use super::fit::{Fit, FitOptions, fit_on};
use super::free::Free;
use super::linear::linearise;
use super::misfit::Misfit;
use super::prior::Prior;
use super::settings::FitSettings;
use super::shoot::Shots;
use super::starts::{profile, starts_after, starts_of};
use crate::simulate::{EffectInstance, Model, Slot};

/// A step that windows' starts spoiled is taken without these where at least this share of what it promises comes true [1]: what
/// is farther from a straight line is tried again in smaller steps.
const COMES_TRUE: f64 = 0.5;

/// All nominal factors, free within what is believable.
pub fn nominal_free(settings: &FitSettings) -> Vec<Free> {
    Nominal::ALL.iter().map(|p| Free { slot: Slot::Nominal(*p), within: settings.believable }).collect()
}

/// The free numbers of a model's effects: their sizes and shapes, within their bounds.
pub fn effect_free<const N: usize>(model: &Model<N>) -> Vec<Free> {
    let of = |(at, effect): (usize, &EffectInstance)| {
        let params = effect.card().params.iter().enumerate().filter(|(_, param)| param.role != Role::Fixed);
        params.map(move |(p, param)| Free { slot: Slot::Param(at, p), within: param.within }).collect::<Vec<_>>()
    };
    model.effects.iter().enumerate().flat_map(of).collect()
}

/// Those of the free numbers that recordings tell anything of: moved through all that is allowed, they move what is predicted
/// by more than one sigma.
pub fn told<const N: usize>(model: &Model<N>, shots: Shots<'_, N>, free: Vec<Free>) -> Vec<Free> {
    let slots: Vec<Slot> = free.iter().map(|f| f.slot).collect();
    let hess = linearise(model, shots, &starts_of(model, shots), &slots, false).reduced().hess;
    let moves = |(k, free): &(usize, Free)| free.moves(hess[(*k, *k)]);
    free.into_iter().enumerate().filter(moves).map(|(_, free)| free).collect()
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
    let options = |dispersion| FitOptions { free, prior, dispersion, rounds: settings.rounds, by_window: COMES_TRUE };
    let starts = match from {
        Some(fit) => starts_after(&model, shots, &fit.starts),
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
    let (_, windows) = profile(model, shots, None, settings);
    let all = windows.into_iter().flatten().fold(Misfit::default(), Misfit::and);
    (all.cost() / all.numbers.max(1) as f64).max(1.0)
}
