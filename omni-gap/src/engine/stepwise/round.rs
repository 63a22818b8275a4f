//! One round of the search: every cause on top of one model, screened, the best fitted, and put in order.

use rayon::prelude::*;

use super::candidate::{Cause, candidates, freed_priors};
use super::released::{ScreenedRelease, screen_releases};
use super::scored::{Data, Scored, error_scale};
use super::screen::{Screened, screen};
use crate::engine::knobs::ScreenKnobs;
use crate::identify::{Prior, Reduced};
use crate::simulate::EffectInstance;

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
    /// The equations of the model's own free numbers on what was screened, weighted down by the fit's dispersion, without what is
    /// stated; none where no effects were tried.
    pub screened_on: Option<Reduced>,
    /// Every parameter cause with its promise, best first.
    pub released: Vec<ScreenedRelease>,
    /// Error scale: the least held-out Σ error² per number, at least one.
    pub scale: f64,
}

/// The candidates, best first, whose promise is worth a fit: of one effect on all wheels and on single ones, those on
/// single wheels only if they promise nearly as much as all together.
fn worth_a_fit<'a>(screened: &'a [Screened], knobs: &ScreenKnobs) -> Vec<&'a Screened> {
    let most = screened.first().map_or(0.0, |s| s.gain);
    let together = |s: &Screened| {
        screened
            .iter()
            .find(|o| o.candidate.card.id == s.candidate.card.id && o.candidate.wheel.is_none())
            .map(|o| o.gain)
    };
    let mut worth: Vec<&Screened> = Vec::new();
    for s in screened.iter().filter(|s| s.gain > knobs.promising) {
        let single = s.candidate.wheel.is_some();
        let outdone = single && together(s).is_some_and(|all| s.gain < knobs.single_wheel_share * all);
        let again = single
            && worth.iter().filter(|w| w.candidate.card.id == s.candidate.card.id).count() >= knobs.fitted_wheels;
        if !outdone && !again && (worth.len() < knobs.always_fitted || s.gain > knobs.worth_a_fit * most) {
            worth.push(s);
        }
    }
    worth.truncate(knobs.fitted_effects);
    worth
}

/// What is tried in a round.
#[derive(Clone, Copy, Debug)]
pub struct Tried {
    /// Effects of the catalogue.
    pub effects: bool,
    /// Numbers of the robot file.
    pub numbers: bool,
}

/// Tries every cause on top of a fitted model. `prior` is without the statements already struck out.
pub fn explain<const N: usize>(data: &Data<'_, N>, base: Scored<N>, prior: &Prior, tried: Tried) -> Ranking<N> {
    let knobs = &data.knobs.screen;
    let considered = |id: &str| !knobs.without.iter().any(|without| without == id);
    let (mut screened, screened_on) = match tried.effects {
        true => {
            let (screened, equations) = screened(data, &base, prior, &considered);
            (screened, Some(equations))
        }
        false => (Vec::new(), None),
    };
    screened.sort_by(|a, b| b.gain.total_cmp(&a.gain));
    let mut releases = if tried.numbers { freed_priors() } else { Vec::new() };
    releases.retain(|release| considered(release.cause));
    let mut released = screen_releases(&base.fit, prior, &releases, &data.knobs.fit);
    released.sort_by(|a, b| b.gain.total_cmp(&a.gain));

    let effects = worth_a_fit(&screened, knobs)
        .into_iter()
        .map(|s| (Cause::Effect(s.candidate.card, s.candidate.wheel), Some(s.from.clone()), prior.clone(), s.gain));
    let parameters =
        released.iter().filter(|r| r.gain > knobs.promising_number).take(knobs.fitted_parameters).map(|r| {
            let without = prior.without(r.release, data.knobs.fit.released_sigma);
            (Cause::Parameter(r.release), None, without, r.gain)
        });
    let mut jobs: Vec<(Cause, Option<EffectInstance>, Prior, f64)> = effects.chain(parameters).collect();
    jobs.sort_by(|a, b| b.3.total_cmp(&a.3));
    let fitted = |(cause, effect, prior, _): (Cause, Option<EffectInstance>, Prior, f64)| {
        let mut model = base.fit.model.clone();
        if let Some(effect) = effect {
            model.add_effect(effect);
        }
        let scored = data.judge(model, Some(&base), &prior, base.extra + cause.freedom(data.prior));
        Ranked { cause, scored }
    };
    // where the best one leaves nothing, only what promised nearly as much can be its look-alike
    let mut jobs = jobs.into_iter();
    let first = jobs.next().map(|job| (job.3, fitted(job)));
    let least = match &first {
        Some((gain, best)) if best.scored.held() < data.knobs.search.enough * best.scored.freedom => {
            knobs.alike_share * gain
        }
        _ => 0.0,
    };
    let others: Vec<_> = jobs.filter(|job| job.3 >= least).collect();
    let mut ranked: Vec<Ranked<N>> = first.into_iter().map(|(_, best)| best).collect();
    ranked.extend(others.into_par_iter().map(fitted).collect::<Vec<_>>());
    let scale = error_scale(ranked.iter().map(|r| &r.scored).chain([&base]));
    ranked.sort_by(|a, b| a.scored.score(scale).total_cmp(&b.scored.score(scale)));
    Ranking { base, ranked, screened, screened_on, released, scale }
}

/// Every effect with its promise, and the equations of the numbers that it was seen beside.
pub(super) fn screened<const N: usize>(
    data: &Data<'_, N>,
    base: &Scored<N>,
    prior: &Prior,
    considered: &dyn Fn(&str) -> bool,
) -> (Vec<Screened>, Reduced) {
    let knobs = &data.knobs.screen;
    let shortened = data.to_fit().beginning(knobs.runs, knobs.least_s).shortened(knobs.most_s, knobs.most_rows);
    let few = shortened.shots();
    let linear = base.fit.linearised(few);
    let mut all = candidates::<N>(&base.fit.model.effects, data.fit[0].chain, knobs);
    all.retain(|candidate| considered(candidate.card.id));
    let equations = linear.reduced().with_dispersion(base.fit.dispersion);
    (screen(&base.fit, &linear, prior, few, all, knobs), equations)
}
