//! What recordings say of small changes of the model that a search came to, as equations that add up over sessions.
//!
//! Of a fit's own step Δ from where it stands, the equations are H·Δ = g; with ln f = ln f₀ + Δ/f₀ and F = diag(f₀):
//!
//! ```text
//! A = F·H·F        b = F·g + A·ln f₀
//! ```
//!
//! What the model carries of effects, p, is eliminated, loosely held to its bounds' width w, but for the one that is asked of:
//!
//! ```text
//! A − A_np·(A_pp + 1/w²)⁻¹·A_pn        b − A_np·(A_pp + 1/w²)⁻¹·b_p
//! ```

use model_core::effects::card::Role;
use model_core::plant::robot::Nominal;
use nalgebra::{DMatrix, DVector};

use super::candidate::{Candidate, trials};
use super::found::Found;
use super::round::screened;
use super::scored::Data;
use super::screen::{Projection, Screened};
use super::search::Search;
use crate::engine::findings::{Direction, SessionEquations};
use crate::engine::knobs::ScreenKnobs;
use crate::identify::{Fit, Prior, Reduced};
use crate::simulate::{EffectInstance, Slot};

/// Those of the model with all causes found, whether they explain the gap or not; none where they have no solution.
pub(super) fn equations<const N: usize>(data: &Data<'_, N>, search: &Search<N>) -> Option<SessionEquations> {
    let first = search.rounds.first().filter(|_| search.found.is_empty());
    let (again, seen_again);
    let (effects, seen): (&[Screened], &Reduced) =
        match first.and_then(|round| Some((round, round.screened_on.as_ref()?))) {
            Some((round, seen)) => (&round.screened, seen),
            None => {
                (again, seen_again) = screened(data, &search.corrected, data.prior, &|_| true);
                (&again, &seen_again)
            }
        };
    let fit = &search.corrected.fit;
    let numbers = Eliminated::of(fit, seen, None)?;
    let of_effect = |screened: &Screened| {
        let Candidate { trials, wheel, .. } = screened.candidate.clone();
        let seen = screened.projections.clone();
        let directions = trials.into_iter().zip(seen).map(|(trial, seen)| numbers.direction(&trial, wheel, &seen));
        directions.collect::<Vec<_>>()
    };
    let carried = search.found.iter().flat_map(|found| of_carried(found, fit, seen, &data.knobs.screen));
    let all = SessionEquations {
        numbers: rows(&numbers.numbers),
        toward: numbers.toward.iter().copied().collect(),
        stated: rows(&stated(data.prior)),
        directions: effects.iter().flat_map(of_effect).chain(carried).collect(),
    };
    // errors of many sessions are added up: they must not be smaller than the windows of each scatter
    Some(all.weighted(fit.dispersion / fit.dispersion.max(fit.spread)))
}

/// CᵀC of the statements Σ c·ln f = 0 ± σ, with c/σ in C.
fn stated(prior: &Prior) -> DMatrix<f64> {
    let mut slopes = DMatrix::zeros(prior.rows.len(), Nominal::COUNT);
    for (k, row) in prior.rows.iter().enumerate() {
        for (number, coefficient) in &row.terms {
            slopes[(k, *number as usize)] += coefficient / row.sigma;
        }
    }
    slopes.tr_mul(&slopes)
}

/// Each way in which an effect that the model carries departs from absent: a number of the fit, moved in place of a trial.
fn of_carried<const N: usize>(found: &Found, fit: &Fit<N>, seen: &Reduced, knobs: &ScreenKnobs) -> Vec<Direction> {
    let cause = &found.cause;
    let own = |effect: &EffectInstance| effect.id == cause.id() && effect.wheel == cause.wheel();
    let Some(at) = fit.model.effects.iter().position(own) else { return Vec::new() };
    let effect = &fit.model.effects[at];
    let of_trial = |trial: EffectInstance| {
        let k = departing(&trial)?;
        let absent = effect.card().params[k].absent;
        let place = fit.free.iter().position(|free| free.slot == Slot::Param(at, k))?;
        let numbers = Eliminated::of(fit, seen, Some(place))?;
        let away = trial.params[k] - absent;
        let projection = Projection {
            overlap: away * seen.grad[place],
            size: away * away * seen.hess[(place, place)],
            shared: away * seen.hess.column(place),
        };
        let direction = numbers.direction(&trial, effect.wheel, &projection);
        let there = (effect.params[k] - absent) / away;
        Some(Direction { carried: true, toward: direction.toward + direction.size * there, ..direction })
    };
    trials(effect.card(), effect.wheel, knobs).into_iter().filter_map(of_trial).collect()
}

/// The number by which a trial departs from absent: one of its sizes, or a shape that is an effect of its own.
fn departing(trial: &EffectInstance) -> Option<usize> {
    let card = trial.card();
    let departs = |k: &usize| trial.params[*k] != card.params[*k].absent;
    let places = || (0..card.params.len()).filter(departs);
    places().find(|k| card.params[*k].role == Role::Size).or_else(|| places().next())
}

/// The equations of the numbers, in the logarithms of their factors, without what the model carries.
struct Eliminated {
    numbers: DMatrix<f64>,
    toward: DVector<f64>,
    /// ln f₀
    at: DVector<f64>,
    /// From the fit's free numbers to the logarithms of factors: f₀ where it is one.
    scale: DMatrix<f64>,
    /// (A_pp + 1/w²)⁻¹ among the fit's free numbers; zero elsewhere.
    carried: DMatrix<f64>,
    /// g of the fit's free numbers
    grad: DVector<f64>,
    /// A_pn, F scaled: how the carried depend on the numbers
    mixed: DMatrix<f64>,
}

impl Eliminated {
    /// Without what the model carries, but for one of its numbers; none where that has no solution.
    fn of<const N: usize>(fit: &Fit<N>, seen: &Reduced, but_for: Option<usize>) -> Option<Self> {
        let free = fit.free.len();
        let mut scale = DMatrix::zeros(free, Nominal::COUNT);
        let mut carried: Vec<usize> = Vec::new();
        for (k, number) in fit.free.iter().enumerate() {
            match number.slot {
                Slot::Nominal(p) => scale[(k, p as usize)] = fit.model.get(number.slot),
                Slot::Param(..) if Some(k) == but_for => {}
                Slot::Param(..) => carried.push(k),
            }
        }
        let mut held = seen.hess.select_rows(&carried).select_columns(&carried);
        for (k, number) in carried.iter().map(|k| &fit.free[*k]).enumerate() {
            held[(k, k)] += (number.within.1 - number.within.0).powi(-2);
        }
        let small = if carried.is_empty() { held } else { held.cholesky()?.inverse() };
        let mut inverse = DMatrix::zeros(free, free);
        for (r, row) in carried.iter().enumerate() {
            for (c, column) in carried.iter().enumerate() {
                inverse[(*row, *column)] = small[(r, c)];
            }
        }
        let mixed = &seen.hess * &scale;
        let numbers = scale.tr_mul(&mixed) - mixed.tr_mul(&inverse) * &mixed;
        let at = DVector::from_iterator(Nominal::COUNT, fit.model.factor.iter().map(|f| f.ln()));
        let toward = scale.tr_mul(&seen.grad) - mixed.tr_mul(&inverse) * &seen.grad + &numbers * &at;
        Some(Self { numbers, toward, at, scale, carried: inverse, grad: seen.grad.clone(), mixed })
    }

    fn direction(&self, trial: &EffectInstance, wheel: Option<usize>, seen: &Projection) -> Direction {
        let taken = &self.carried * &seen.shared;
        let with_numbers = self.scale.tr_mul(&seen.shared) - self.mixed.tr_mul(&taken);
        let card = trial.card();
        let number = departing(trial).map(|k| (&card.params[k], trial.params[k]));
        Direction {
            id: card.id.to_owned(),
            wheel,
            key: number.map_or_else(String::new, |(p, _)| p.key.to_owned()),
            unit: number.map_or("1", |(p, _)| p.unit).to_owned(),
            absent: number.map_or(0.0, |(p, _)| p.absent),
            typical: number.map_or(1.0, |(_, typical)| typical),
            either_way: number.is_some_and(|(p, _)| p.within.0 < p.absent && p.absent < p.within.1),
            carried: false,
            size: seen.size - seen.shared.dot(&taken),
            toward: seen.overlap - taken.dot(&self.grad) + with_numbers.dot(&self.at),
            with_numbers: with_numbers.iter().copied().collect(),
        }
    }
}

fn rows(matrix: &DMatrix<f64>) -> Vec<Vec<f64>> {
    matrix.row_iter().map(|row| row.iter().copied().collect()).collect()
}
