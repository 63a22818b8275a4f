//! The screen of the nominal values: what striking out a statement of the robot file promises, without a fit.

use nalgebra::{DMatrix, DVector};

use crate::identify::{Fit, Linearised, Prior, Release};
use crate::simulate::Slot;

/// For every parameter cause, the drop of the whole cost that striking out its statement promises.
///
/// With v the violations of the statements in question and K their leverage, the drop is vᵀ(1 − K)⁻¹v.
pub fn parameter_gains<const N: usize>(
    fit: &Fit<N>,
    linear: &Linearised,
    prior: &Prior,
    causes: &[Release],
) -> Vec<(Release, f64)> {
    let reduced = fit.reduced(linear, prior);
    let Some(hess) = reduced.hess.cholesky() else { return Vec::new() };
    let violations = prior.violations(&fit.model);
    let n = fit.free.len();
    causes
        .iter()
        .map(|cause| {
            let rows = prior.rows_of(*cause);
            let mut c = DMatrix::zeros(rows.len(), n);
            for (k, row) in rows.iter().enumerate() {
                let row = &prior.rows[*row];
                for (p, weight) in &row.terms {
                    if let Some(at) = fit.free.iter().position(|f| f.slot == Slot::Nominal(*p)) {
                        c[(k, at)] = weight / (row.sigma * fit.model.get(Slot::Nominal(*p)));
                    }
                }
            }
            let v = DVector::from_iterator(rows.len(), rows.iter().map(|k| violations[*k]));
            let leverage = &c * hess.solve(&c.transpose());
            let kept = DMatrix::identity(rows.len(), rows.len()) - leverage;
            let gain = kept.lu().solve(&v).map_or(0.0, |x| v.dot(&x));
            (*cause, gain.max(0.0))
        })
        .collect()
}
