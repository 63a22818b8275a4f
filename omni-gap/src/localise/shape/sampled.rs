//! One window as a sample: a quantity's residual at a feature.

use super::bins::Sample;
use super::circumstances::Circumstances;
use super::model::Quantity;
use super::residual::Residuals;
use super::window::{MODELS, Window};

/// A quantity's residual at a feature, if both are known.
pub(super) fn sample(window: &Window, at: Option<f64>, (quantity, wheel): (Quantity, usize)) -> Option<Sample> {
    let residual = window.residuals.map(|of| value(&of, &window.when, quantity, wheel));
    let whole = residual.iter().all(Option::is_some);
    let residual: [f64; MODELS] = residual.map(Option::unwrap_or_default);
    at.filter(|at| whole && at.is_finite()).map(|at| Sample { at, cluster: window.cluster, residual })
}

fn value(of: &Residuals, when: &Circumstances, quantity: Quantity, wheel: usize) -> Option<f64> {
    if quantity != Quantity::Drag {
        return of.get(quantity, wheel);
    }
    let [v, vn, _] = when.twist;
    let speed = v.hypot(vn);
    let ahead = of.get(Quantity::NeededForceAhead, 0)?;
    let left = of.get(Quantity::NeededForceLeft, 0)?;
    (speed > f64::MIN_POSITIVE).then(|| (ahead * v + left * vn) / speed)
}
