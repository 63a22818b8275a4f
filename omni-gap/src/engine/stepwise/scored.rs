//! A model judged: fitted on some runs, and scored by how well it predicts those that no fit has seen.

use model_core::effects::card::Role;

use crate::engine::knobs::Knobs;
use crate::identify::{Fit, Free, Prior, Shots, Windows, fit_with_dispersion, nominal_free, profile};
use crate::simulate::{AlignedRun, Model, Slot};

/// The runs to fit on and the runs to judge by, with their windows.
#[derive(Debug)]
pub struct Data<'a, const N: usize> {
    /// Runs to fit on.
    pub fit: Vec<&'a AlignedRun<N>>,
    /// Their windows.
    pub fit_windows: Vec<Windows>,
    /// Runs that are only predicted.
    pub held: Vec<&'a AlignedRun<N>>,
    /// Their windows.
    pub held_windows: Vec<Windows>,
    /// What the robot file states of its uncertainty.
    pub prior: &'a Prior,
    /// Thresholds.
    pub knobs: &'a Knobs,
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
    /// What each of these costs.
    pub price: f64,
}

impl<const N: usize> Scored<N> {
    /// Σ error² on held-out runs [σ²].
    pub fn held(&self) -> f64 {
        self.windows.iter().sum()
    }

    /// Lower is better: held-out error in units of `scale`, what was stated, and the price of freedom.
    pub fn score(&self, scale: f64) -> f64 {
        self.held() / scale + self.stated + self.price * self.extra as f64
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
        let settings = &self.knobs.fit;
        let free: Vec<Free> = nominal_free(settings).into_iter().chain(effect_free(&model)).collect();
        let fitted = fit_with_dispersion(model, self.to_fit(), from, &free, prior, settings);
        let (_, windows) = profile(&fitted.model, self.to_judge(), settings);
        let per_window: Vec<(f64, usize)> = windows.into_iter().flatten().collect();
        let samples: usize = per_window.iter().map(|(_, n)| *n).sum();
        Scored {
            freedom: (samples as f64 - 6.0 * per_window.len() as f64).max(1.0),
            windows: per_window.into_iter().map(|(cost, _)| cost).collect(),
            stated: fitted.prior_cost,
            fit: fitted,
            extra,
            price: self.knobs.search.price_of_freedom,
        }
    }
}
