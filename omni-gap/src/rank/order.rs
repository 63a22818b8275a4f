//! From candidates to an order: fit the best, judge them on runs that no fit has seen.

use model_core::effects::card::Role;
use rayon::prelude::*;

use super::candidate::{Cause, candidates, releases};
use super::screen::{Screened, parameter_gains, screen};
use crate::identify::{Fit, Free, Prior, Shots, Windows, fit_tempered, nominal_free, profile};
use crate::simulate::{Carried, Model, Recorded, Slot};

/// Effects that are fitted after the screen, at the most.
const FITTED_EFFECTS: usize = 6;
/// Parameter causes that are fitted, at the most.
const FITTED_PARAMETERS: usize = 3;
/// A promise below this is not worth a fit [σ²].
const PROMISING: f64 = 9.0;
/// Beyond the best two, a promise below this share of the best is not worth a fit.
const WORTH_A_FIT: f64 = 0.25;
/// Σ error² per number below which nothing relevant can be left.
pub(super) const ENOUGH: f64 = 1.03;
/// What a look-alike of a cause that leaves nothing has to promise of what that cause did.
const ALIKE: f64 = 0.5;
/// What a single wheel has to promise of what all wheels together do.
const NEARLY: f64 = 0.6;
/// Runs that the screen looks at, at the most.
const SCREENED_RUNS: usize = 4;
/// What each free number of a cause costs in the score.
const PRICE_OF_FREEDOM: f64 = 2.0;
/// The runs to fit on and the runs to judge by, with their windows.
#[derive(Debug)]
pub struct Data<'a, const N: usize> {
    /// Runs to fit on.
    pub fit: Vec<&'a Recorded<N>>,
    /// Their windows.
    pub fit_windows: Vec<Windows>,
    /// Runs that are only predicted.
    pub held: Vec<&'a Recorded<N>>,
    /// Their windows.
    pub held_windows: Vec<Windows>,
    /// What the robot file states of its uncertainty.
    pub prior: Prior,
}

/// A model and how well it does on held-out runs.
#[derive(Clone, Debug)]
pub struct Scored<const N: usize> {
    /// The fit on the other runs.
    pub fit: Fit<N>,
    /// Σ error² [σ²] of each held-out window, its start free.
    pub windows: Vec<f64>,
    /// Numbers compared on held-out runs, less those that the starts take up.
    pub freedom: f64,
    /// What the model costs by what was stated.
    pub stated: f64,
    /// Free numbers that the causes add.
    pub extra: usize,
}

impl<const N: usize> Scored<N> {
    /// Σ error² on held-out runs [σ²].
    pub fn held(&self) -> f64 {
        self.windows.iter().sum()
    }

    /// Lower is better: held-out error in units of `scale`, what was stated, and the price of freedom.
    pub fn score(&self, scale: f64) -> f64 {
        self.held() / scale + self.stated + PRICE_OF_FREEDOM * self.extra as f64
    }

    /// How much better (positive) this is than another, and the standard error of that, over windows.
    pub fn better_than(&self, other: &Self, scale: f64) -> (f64, f64) {
        let differences: Vec<f64> = other.windows.iter().zip(&self.windows).map(|(o, s)| (o - s) / scale).collect();
        let n = differences.len() as f64;
        let mean = differences.iter().sum::<f64>() / n;
        let variance = differences.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / (n - 1.0).max(1.0);
        (other.score(scale) - self.score(scale), (n * variance).sqrt())
    }
}

/// A cause that was fitted.
#[derive(Clone, Debug)]
pub struct Ranked<const N: usize> {
    /// The cause.
    pub cause: Cause,
    /// The model with it, and how it does.
    pub scored: Scored<N>,
}

/// All that was tried on top of one model, best first.
#[derive(Clone, Debug)]
pub struct Ranking<const N: usize> {
    /// The model that the causes were added to, its parameters re-fitted within what was stated.
    pub base: Scored<N>,
    /// The causes that were fitted, best first.
    pub ranked: Vec<Ranked<N>>,
    /// Every effect with its promise by the screen, best first; kept for the causes that were not fitted.
    pub screened: Vec<Screened>,
    /// Error scale: the least held-out Σ error² per number, at least one.
    pub scale: f64,
}

/// The free numbers of a model's effects from place `first` of the list given.
fn effect_free<const N: usize>(model: &Model<N>) -> Vec<Free> {
    let mut free = Vec::new();
    for (at, effect) in model.effects.iter().enumerate() {
        for (p, param) in effect.card().params.iter().enumerate() {
            if param.role != Role::Fixed {
                free.push(Free { slot: Slot::Param(at, p), within: param.within });
            }
        }
    }
    free
}

impl<const N: usize> Data<'_, N> {
    /// What models are fitted to.
    pub fn to_fit(&self) -> Shots<'_, N> {
        Shots { runs: &self.fit, windows: &self.fit_windows }
    }

    /// What models are judged by.
    pub fn to_judge(&self) -> Shots<'_, N> {
        Shots { runs: &self.held, windows: &self.held_windows }
    }

    /// Fits a model (all nominal values within what `prior` states, all sizes and shapes of its effects) and judges it.
    pub fn judge(&self, model: Model<N>, from: Option<&Fit<N>>, prior: &Prior, extra: usize) -> Scored<N> {
        let free: Vec<Free> = nominal_free().into_iter().chain(effect_free(&model)).collect();
        let fitted = fit_tempered(model, self.to_fit(), from, &free, prior);
        let (_, windows) = profile(&fitted.model, self.to_judge());
        let per_window: Vec<(f64, usize)> = windows.into_iter().flatten().collect();
        let samples: usize = per_window.iter().map(|(_, n)| *n).sum();
        Scored {
            freedom: (samples as f64 - 6.0 * per_window.len() as f64).max(1.0),
            windows: per_window.into_iter().map(|(cost, _)| cost).collect(),
            stated: fitted.prior_cost,
            fit: fitted,
            extra,
        }
    }
}

/// The candidates, best first, whose promise is worth a fit: of one effect on all wheels and on single ones, those on
/// single wheels only if they promise nearly as much as all together.
fn worth_a_fit(screened: &[Screened]) -> Vec<&Screened> {
    let most = screened.first().map_or(0.0, |s| s.gain);
    let together = |s: &Screened| {
        screened
            .iter()
            .find(|o| o.candidate.card.id == s.candidate.card.id && o.candidate.wheel.is_none())
            .map(|o| o.gain)
    };
    let mut worth: Vec<&Screened> = Vec::new();
    for s in screened.iter().filter(|s| s.gain > PROMISING) {
        let single = s.candidate.wheel.is_some();
        let outdone = single && together(s).is_some_and(|all| s.gain < NEARLY * all);
        let again = single && worth.iter().filter(|w| w.candidate.card.id == s.candidate.card.id).count() >= 2;
        if !outdone && !again && (worth.len() < 2 || s.gain > WORTH_A_FIT * most) {
            worth.push(s);
        }
    }
    worth.truncate(FITTED_EFFECTS);
    worth
}

/// Tries every cause on top of a fitted model. `released` are the statements already struck out.
pub fn explain<const N: usize>(data: &Data<'_, N>, base: Scored<N>, prior: &Prior) -> Ranking<N> {
    let few = data.to_fit().first(SCREENED_RUNS);
    let linear = base.fit.linearised(few);
    let all = candidates::<N>(&base.fit.model.effects);
    let mut screened = screen(&base.fit, &linear, prior, few, all);
    screened.sort_by(|a, b| b.gain.total_cmp(&a.gain));
    drop(linear);
    let whole = base.fit.linearised(data.to_fit());
    let mut parameters = parameter_gains(&base.fit, &whole, prior, &releases());
    parameters.sort_by(|a, b| b.1.total_cmp(&a.1));
    drop(whole);

    let effects = worth_a_fit(&screened)
        .into_iter()
        .map(|s| (Cause::Effect(s.candidate.card, s.candidate.wheel), Some(s.from.clone()), prior.clone(), s.gain));
    let released = parameters
        .iter()
        .filter(|(_, gain)| *gain > PROMISING)
        .take(FITTED_PARAMETERS)
        .map(|(release, gain)| (Cause::Parameter(*release), None, prior.without(*release), *gain));
    let mut jobs: Vec<(Cause, Option<Carried>, Prior, f64)> = effects.chain(released).collect();
    jobs.sort_by(|a, b| b.3.total_cmp(&a.3));
    let fitted = |(cause, effect, prior, _): (Cause, Option<Carried>, Prior, f64)| {
        let mut model = base.fit.model.clone();
        if let Some(effect) = effect {
            model.carry(effect);
        }
        let scored = data.judge(model, Some(&base.fit), &prior, base.extra + cause.freedom(&data.prior));
        Ranked { cause, scored }
    };
    // where the best one leaves nothing, only what promised nearly as much can be its look-alike
    let mut jobs = jobs.into_iter();
    let first = jobs.next().map(|job| (job.3, fitted(job)));
    let least = match &first {
        Some((gain, best)) if best.scored.held() < ENOUGH * best.scored.freedom => ALIKE * gain,
        _ => 0.0,
    };
    let others: Vec<_> = jobs.filter(|job| job.3 >= least).collect();
    let mut ranked: Vec<Ranked<N>> = first.into_iter().map(|(_, best)| best).collect();
    ranked.extend(others.into_par_iter().map(fitted).collect::<Vec<_>>());
    let scale = ranked
        .iter()
        .map(|r| &r.scored)
        .chain([&base])
        .map(|s| s.held() / s.freedom)
        .fold(f64::INFINITY, f64::min)
        .max(1.0);
    ranked.sort_by(|a, b| a.scored.score(scale).total_cmp(&b.scored.score(scale)));
    Ranking { base, ranked, screened, scale }
}
