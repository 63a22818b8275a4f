//! The screen of the nominal values: what striking out a statement of the robot file promises, without a fit.

use model_core::plant::robot::Nominal;
use nalgebra::{DMatrix, DVector};

use crate::identify::{Fit, FitSettings, FreedPrior, Prior};
use crate::simulate::Slot;

/// A parameter cause and what the screen says of it.
#[derive(Clone, Debug)]
pub struct ScreenedRelease {
    /// The cause.
    pub release: FreedPrior,
    /// Drop of the whole cost that striking out its statement promises.
    pub gain: f64,
    /// Where one linear step without the statement leads; none where the equations cannot be solved.
    pub step: Option<OneStep>,
}

/// Nominal factors after one linear step.
#[derive(Clone, Debug)]
pub struct OneStep {
    /// The factors.
    pub factors: [f64; Nominal::COUNT],
    /// Covariance of the fit's free numbers by the linear equations
    covariance: DMatrix<f64>,
    /// The fit's free numbers
    slots: Vec<Slot>,
}

impl OneStep {
    /// Covariance of two factors; none where one was not free.
    pub fn covariance_of(&self, a: Nominal, b: Nominal) -> Option<f64> {
        let at = |p| self.slots.iter().position(|slot| *slot == Slot::Nominal(p));
        Some(self.covariance[(at(a)?, at(b)?)])
    }
}

/// Screens parameter causes at a fit.
pub fn screen_releases<const N: usize>(
    fit: &Fit<N>,
    prior: &Prior,
    causes: &[FreedPrior],
    settings: &FitSettings,
) -> Vec<ScreenedRelease> {
    let step = |release| one_step(fit, &prior.without(release, settings.released_sigma));
    let gains = gains(fit, prior, causes);
    gains.into_iter().map(|(release, gain)| ScreenedRelease { release, gain, step: step(release) }).collect()
}

/// Δp = S⁻¹·g with other statements than those of the fit, and S⁻¹.
fn one_step<const N: usize>(fit: &Fit<N>, prior: &Prior) -> Option<OneStep> {
    let reduced = fit.stated(fit.equations.clone(), prior);
    let hess = reduced.hess.cholesky()?;
    let step = hess.solve(&reduced.grad);
    let mut factors = fit.model.factor;
    for (free, step) in fit.free.iter().zip(step.iter()) {
        if let Slot::Nominal(p) = free.slot {
            factors[p as usize] += step;
        }
    }
    Some(OneStep { factors, covariance: hess.inverse(), slots: fit.free.iter().map(|f| f.slot).collect() })
}

/// For every parameter cause, the drop of the whole cost that striking out its statement promises.
///
/// With v the violations of the statements in question and K their leverage, the drop is vᵀ(1 − K)⁻¹v.
fn gains<const N: usize>(fit: &Fit<N>, prior: &Prior, causes: &[FreedPrior]) -> Vec<(FreedPrior, f64)> {
    let reduced = fit.stated(fit.equations.clone(), prior);
    let Some(hess) = reduced.hess.cholesky() else { return Vec::new() };
    let n = fit.free.len();
    causes
        .iter()
        .map(|cause| {
            let struck_out = Prior { rows: prior.struck_out_by(*cause) };
            let rows = &struck_out.rows;
            if rows.is_empty() {
                return (*cause, 0.0);
            }
            let mut c = DMatrix::zeros(rows.len(), n);
            for (k, row) in rows.iter().enumerate() {
                for (p, weight) in &row.terms {
                    if let Some(at) = fit.free.iter().position(|f| f.slot == Slot::Nominal(*p)) {
                        c[(k, at)] = weight / (row.sigma * fit.model.get(Slot::Nominal(*p)));
                    }
                }
            }
            let v = DVector::from_vec(struck_out.violations(&fit.model));
            let leverage = &c * hess.solve(&c.transpose());
            let kept = DMatrix::identity(rows.len(), rows.len()) - leverage;
            let gain = kept.lu().solve(&v).map_or(0.0, |x| v.dot(&x));
            (*cause, gain.max(0.0))
        })
        .collect()
}
