//! The fit: Levenberg–Marquardt on the reduced equations, within bounds.
//!
//! What is minimised is Σ error²/φ + what was stated. The dispersion φ says how much less the data know than their number
//! suggests: as long as the model lacks something, its errors go on through whole windows and must not outvote all that
//! was stated of the robot. It is the spread of the windows' gradients over what white noise would give them (Takeuchi),
//! one for a model that is right.

use nalgebra::{DMatrix, DVector};

use super::begun::Begun;
use super::bounded_step::step_within;
use super::chance;
use super::free::Free;
use super::linear::{Linearised, Reduced, linearise};
use super::misfit::Misfit;
use super::prior::Prior;
use super::prior_row::PriorRow;
use super::shoot::{Shots, Starts};
use super::starts::starts_of;
use crate::simulate::{Model, Slot};
use model_core::plant::robot::Nominal;

/// A fitted model.
#[derive(Clone, Debug)]
pub struct Fit<const N: usize> {
    /// The model.
    pub model: Model<N>,
    /// What was free.
    pub free: Vec<Free>,
    /// The start of every window, run by run.
    pub starts: Vec<Starts>,
    /// Σ error² [σ²] over what was measured
    pub cost: f64,
    /// How many numbers were compared.
    pub samples: usize,
    /// How far each window is missed, run by run
    pub windows: Vec<Misfit>,
    /// Σ violation² of what was stated
    pub prior_cost: f64,
    /// What the data were weighted down by.
    pub dispersion: f64,
    /// What they should be weighted down by, as this fit sees it; one for a model that is right.
    pub spread: f64,
    /// Covariance of the free numbers, robust against errors that go on through a window; with what chance adds.
    pub covariance: DMatrix<f64>,
    /// The reduced equations of what was measured, at this fit and for errors as they are.
    pub equations: Reduced,
}

impl<const N: usize> Fit<N> {
    /// One-sigma uncertainty of a free number; `None` where it was not free.
    pub fn std(&self, slot: Slot) -> Option<f64> {
        let at = self.free.iter().position(|f| f.slot == slot)?;
        Some(self.covariance[(at, at)].max(0.0).sqrt())
    }

    /// The same while other free numbers are held where they are.
    pub fn std_beside(&self, slot: Slot, held: &[Slot], prior: &Prior) -> Option<f64> {
        let moving: Vec<usize> = (0..self.free.len()).filter(|k| !held.contains(&self.free[*k].slot)).collect();
        let at = moving.iter().position(|k| self.free[*k].slot == slot)?;
        let data = self.equations.clone().with_dispersion(self.dispersion).of(&moving);
        let stated = self.stated(self.equations.clone(), prior).of(&moving);
        Some(covariance(&stated, data, moving.len())[(at, at)].max(0.0).sqrt())
    }

    /// True if the number ended at one of its bounds.
    pub fn at_bound(&self, free: &Free) -> bool {
        let x = self.model.get(free.slot);
        let margin = 1e-6 * (free.within.1 - free.within.0);
        x <= free.within.0 + margin || x >= free.within.1 - margin
    }
}

/// A step that promises less than this of the cost is not taken [σ²]: no number would move by a thirtieth of its sigma.
const ARRIVED: f64 = 1e-3;

/// Dampings that a step is tried with, each thirty times the one before [1]: from one that shortens only what the data hardly
/// determine, along a valley that bends, to one that shortens all of it.
const TRIES: usize = 7;

/// A step that made things worse is damped by this at least [1].
const FELT: f64 = 1e-5;

/// Starts creep if they promise more than this share of what they promised in the round before [1].
const STILL_PROMISED: f64 = 0.2;

/// What a fit may change, and how it goes.
#[derive(Clone, Copy, Debug)]
pub struct FitOptions<'a> {
    /// What is free.
    pub free: &'a [Free],
    /// What was stated.
    pub prior: &'a Prior,
    /// Σ error² counts this much less.
    pub dispersion: f64,
    /// Rounds, at the most.
    pub rounds: usize,
    /// A step that makes things worse is tried once more with each window's better start, and taken where more than this
    /// share of what it promised comes true [1]: starts that friction bends keep a fit from moving numbers at all, or along a line on
    /// which the data hardly tell them apart.
    pub by_window: f64,
}

/// Fits the free numbers of `model` to the runs; `starts` are where to begin, if known from a fit before.
pub fn fit<const N: usize>(
    model: Model<N>,
    shots: Shots<'_, N>,
    starts: Option<Vec<Starts>>,
    options: FitOptions<'_>,
) -> Fit<N> {
    let starts = starts.unwrap_or_else(|| starts_of(&model, shots));
    let slots: Vec<Slot> = options.free.iter().map(|f| f.slot).collect();
    let linear = linearise(&model, shots, &starts, &slots, false);
    fit_on((model, starts, linear), shots, options).0
}

/// The same from a model, its starts, and what they are linearised to; and what the fitted model is linearised to.
pub(super) fn fit_on<const N: usize>(
    (mut model, mut starts, mut linear): (Model<N>, Vec<Starts>, Linearised),
    shots: Shots<'_, N>,
    options: FitOptions<'_>,
) -> (Fit<N>, Linearised) {
    let FitOptions { free, prior, dispersion, rounds, by_window } = options;
    let slots: Vec<Slot> = free.iter().map(|f| f.slot).collect();
    let mut damping = 1e-7;
    let mut total = linear.misfit().cost() / dispersion + prior.cost(&model);
    let mut by_starts_before = f64::INFINITY;
    'rounds: for _ in 0..rounds {
        let reduced = with_prior(linear.reduced().with_dispersion(dispersion), &model, free, prior);
        // what starts promise is all but nothing after a step that went all the way
        let still_promised = reduced.by_starts > STILL_PROMISED * by_starts_before;
        by_starts_before = reduced.by_starts;
        let mut better = None;
        for _ in 0..TRIES {
            let Some((trial, taken)) = step_within(&model, free, &reduced, damping) else {
                damping *= 10.0;
                continue;
            };
            // Δpᵀ·g + Σ g_zᵀ·H_zz⁻¹·g_z: what a step that is linear all the way would gain
            let by_numbers = taken.dot(&reduced.grad);
            if by_numbers + reduced.by_starts < ARRIVED {
                break 'rounds;
            }
            let mut begun = Begun::of(&trial, shots, linear.starts_after(&starts, &taken));
            let cost = |begun: &Begun| begun.cost() / dispersion + prior.cost(&trial);
            if cost(&begun).is_nan() || cost(&begun) >= total {
                let with_some = begun.clone().or(Begun::of(&trial, shots, starts.clone()));
                if total - cost(&with_some) > by_window * by_numbers {
                    begun = with_some;
                }
            }
            if cost(&begun) < total {
                damping = (damping * 0.1).max(1e-10);
                if still_promised && reduced.by_starts > by_numbers {
                    begun = begun.taken_farther(&trial, shots, &starts);
                }
                let cost = cost(&begun);
                better = Some((trial, begun.starts, cost));
                break;
            }
            damping = (damping * 30.0).max(FELT);
        }
        let Some((trial, moved, cost)) = better else { break };
        let gained = total - cost;
        (model, starts, total) = (trial, moved, cost);
        linear = linearise(&model, shots, &starts, &slots, false);
        if gained < 0.1 + 1e-6 * total {
            break;
        }
    }
    let equations = linear.reduced();
    let data = equations.clone().with_dispersion(dispersion);
    let reduced = with_prior(data.clone(), &model, free, prior);
    let misfit = linear.misfit();
    let (cost, samples) = (misfit.cost(), misfit.numbers);
    let spread = spread(&reduced, &equations).max(cost / samples.max(1) as f64).max(1.0);
    let mut covariance = covariance(&reduced, data, free.len());
    for (k, slot) in slots.iter().enumerate() {
        covariance[(k, k)] += chance::variance(&model, shots, *slot);
    }
    let fitted = Fit {
        spread,
        covariance,
        equations,
        dispersion,
        prior_cost: prior.cost(&model),
        model,
        free: free.to_vec(),
        starts,
        cost,
        samples,
        windows: linear.misfits().into_iter().flatten().collect(),
    };
    (fitted, linear)
}

/// Adds what was stated; and holds each number loosely to its bounds' width, so that the equations stay regular.
pub(crate) fn with_prior<const N: usize>(
    mut reduced: Reduced,
    model: &Model<N>,
    free: &[Free],
    prior: &Prior,
) -> Reduced {
    let slopes = slopes_of(prior, model, free);
    reduced.grad -= slopes.tr_mul(&DVector::from_vec(prior.violations(model)));
    reduced.hess += slopes.tr_mul(&slopes);
    for (k, f) in free.iter().enumerate() {
        let width = f.within.1 - f.within.0;
        reduced.hess[(k, k)] += 1.0 / (width * width);
    }
    reduced
}

/// Products of derivatives by the free numbers, held by what was stated of these: what their equations are solved with.
pub(crate) fn held_by<const N: usize>(
    products: DMatrix<f64>,
    model: &Model<N>,
    free: &[Free],
    prior: &Prior,
) -> DMatrix<f64> {
    let none = || DMatrix::zeros(free.len(), free.len());
    let data = Reduced { hess: products, grad: DVector::zeros(free.len()), meat: none(), by_starts: 0.0 };
    with_prior(data, model, free, prior).hess
}

/// d violation / d free number: a row for each statement.
pub(crate) fn slopes_of<const N: usize>(prior: &Prior, model: &Model<N>, free: &[Free]) -> DMatrix<f64> {
    DMatrix::from_fn(prior.rows.len(), free.len(), |row, k| {
        let PriorRow { terms, sigma, .. } = &prior.rows[row];
        let of = |(p, c): &(Nominal, f64)| {
            let slot = Slot::Nominal(*p);
            // d ln(factor)/d factor = 1/factor
            if slot == free[k].slot { c / (sigma * model.get(slot)) } else { 0.0 }
        };
        terms.iter().map(of).sum()
    })
}

/// tr(S⁻¹·Σ g·gᵀ)/tr(S⁻¹·H): the windows' gradients against white noise of one sigma, in the directions that count.
fn spread(reduced: &Reduced, data: &Reduced) -> f64 {
    match reduced.hess.clone().cholesky() {
        Some(c) if data.hess.ncols() > 0 => {
            let white = c.solve(&data.hess).trace();
            if white > 1e-12 { c.solve(&data.meat).trace() / white } else { 1.0 }
        }
        _ => 1.0,
    }
}

/// S⁻¹·(Σ g·gᵀ + prior)·S⁻¹, no smaller than S⁻¹ on its diagonal.
fn covariance(reduced: &Reduced, data: Reduced, n: usize) -> DMatrix<f64> {
    if n == 0 {
        return DMatrix::zeros(0, 0);
    }
    let Some(inverse) = reduced.hess.clone().cholesky().map(|c| c.inverse()) else {
        return DMatrix::from_diagonal_element(n, n, f64::INFINITY);
    };
    let meat = data.meat + (&reduced.hess - data.hess);
    let mut robust = &inverse * meat * &inverse;
    for k in 0..n {
        robust[(k, k)] = robust[(k, k)].max(inverse[(k, k)]);
    }
    robust
}

/// The windows linearised at a fit, kept whole for a screening.
impl<const N: usize> Fit<N> {
    /// The errors and derivatives of every window at this fit.
    pub fn linearised(&self, shots: Shots<'_, N>) -> Linearised {
        let slots: Vec<Slot> = self.free.iter().map(|f| f.slot).collect();
        linearise(&self.model, shots, &self.starts, &slots, true)
    }

    /// Reduced equations at this fit, such as its own, weighted down as its errors are and with what was stated.
    pub fn stated(&self, equations: Reduced, prior: &Prior) -> Reduced {
        with_prior(equations.with_dispersion(self.dispersion), &self.model, &self.free, prior)
    }
}

#[cfg(test)]
#[path = "fit_tests.rs"]
mod tests;
