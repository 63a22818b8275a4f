//! A step of a fit within the bounds of its numbers.

use nalgebra::{DMatrix, DVector};

use super::free::Free;
use super::linear::Reduced;
use crate::simulate::Model;

/// The step that solves the reduced equations, and the model after it: what would go beyond a bound stops there, and the
/// others are solved for beside it. None where the equations cannot be solved.
pub(super) fn step_within<const N: usize>(
    model: &Model<N>,
    free: &[Free],
    reduced: &Reduced,
    damping: f64,
) -> Option<(Model<N>, DVector<f64>)> {
    let mut damped = reduced.hess.clone();
    for k in 0..damped.ncols() {
        damped[(k, k)] *= 1.0 + damping;
    }
    let mut going: Vec<usize> = (0..free.len()).collect();
    let mut step = DVector::zeros(free.len());
    loop {
        solve(&damped, &reduced.grad, &going, &mut step)?;
        let (trial, taken) = stepped(model, free, &step);
        let count = going.len();
        going.retain(|k| {
            let (to, within) = (trial.get(free[*k].slot), free[*k].within);
            within.0 < to && to < within.1
        });
        if going.len() == count || going.is_empty() {
            return Some((trial, taken));
        }
        step = taken;
    }
}

/// Solves for the steps of those numbers that are `going`, beside the steps of the others as they are.
fn solve(hess: &DMatrix<f64>, grad: &DVector<f64>, going: &[usize], step: &mut DVector<f64>) -> Option<()> {
    if going.is_empty() {
        return Some(());
    }
    let mut others = step.clone();
    going.iter().for_each(|k| others[*k] = 0.0);
    let left = grad - hess * others;
    let own = hess.select_rows(going).select_columns(going);
    let solved = own.cholesky()?.solve(&left.select_rows(going));
    going.iter().zip(solved.iter()).for_each(|(k, x)| step[*k] = *x);
    Some(())
}

/// A model whose free numbers are moved by a step, each within its bounds; and the step that was taken, as a straight line from
/// where they are leads to it.
pub(crate) fn stepped<const N: usize>(
    model: &Model<N>,
    free: &[Free],
    step: &DVector<f64>,
) -> (Model<N>, DVector<f64>) {
    let mut trial = model.clone();
    let mut taken = step.clone();
    for (k, f) in free.iter().enumerate() {
        let from = model.get(f.slot);
        let course = if model.is_limit(f.slot) && from > 0.0 { limit_moved } else { moved };
        let (to, by) = course(from, step[k], f.within);
        taken[k] = by;
        trial.set(f.slot, to);
    }
    (trial, taken)
}

/// A number moved by a step within its bounds, and the step that was taken.
fn moved(from: f64, step: f64, within: (f64, f64)) -> (f64, f64) {
    let to = (from + step).clamp(within.0, within.1);
    (to, to - from)
}

/// The same of a limit, which goes straight in its inverse: none stands there for no limit, and what is ever farther above all
/// that a robot reaches differs ever less from none.
///
/// ```text
/// 1/x' = 1/x − Δ/x²
/// ```
fn limit_moved(from: f64, step: f64, within: (f64, f64)) -> (f64, f64) {
    let more = 1.0 - step / from;
    let to = if more > 0.0 { from / more } else { f64::INFINITY }.clamp(within.0, within.1);
    (to, from * (1.0 - from / to))
}

#[cfg(test)]
mod tests {
    use model_core::effects::EffectKind;

    use super::super::staged::robot;
    use super::*;
    use crate::simulate::{EffectInstance, Slot};

    const SIZES: [Slot; 2] = [Slot::Param(0, 0), Slot::Param(0, 1)];

    /// A model with an effect of two sizes, both free within bounds.
    fn free(within: [(f64, f64); 2]) -> (Model<4>, [Free; 2]) {
        let mut model = Model::<4>::nominal(&robot(), 12.0);
        model.add_effect(EffectInstance::typical(EffectKind::CogOffset.card(), None));
        SIZES.iter().for_each(|slot| model.set(*slot, 0.0));
        (model, [0, 1].map(|k| Free { slot: SIZES[k], within: within[k] }))
    }

    /// Equations of two numbers that the data hardly tell apart, by which both would go far.
    fn equations() -> Reduced {
        let hess = DMatrix::from_row_slice(2, 2, &[1.0, 0.9, 0.9, 1.0]);
        let grad = &hess * DVector::from_column_slice(&[3.0, -2.0]);
        Reduced { hess, grad, meat: DMatrix::zeros(2, 2), by_starts: 0.0 }
    }

    #[test]
    fn a_step_that_stays_within_bounds_solves_the_equations() {
        let (model, free) = free([(-4.0, 4.0); 2]);
        let (after, step) = step_within(&model, &free, &equations(), 0.0).unwrap();
        assert!((step[0] - 3.0).abs() < 1e-12 && (step[1] + 2.0).abs() < 1e-12, "{step}");
        assert_eq!(SIZES.map(|slot| after.get(slot)), [step[0], step[1]]);
    }

    #[test]
    fn beside_a_number_that_stops_at_its_bound_the_other_is_solved_for() {
        let (model, free) = free([(-4.0, 1.0), (-4.0, 4.0)]);
        let (after, step) = step_within(&model, &free, &equations(), 0.0).unwrap();
        // 0.9·1 + x = 0.9·3 − 2
        assert_eq!(after.get(SIZES[0]), 1.0);
        assert!((step[1] + 0.2).abs() < 1e-12, "{step}");
    }

    #[test]
    fn a_limit_comes_to_its_highest_value_and_never_to_none_by_way_of_zero() {
        let within = (0.0, 1.5);
        // as far as one can see it is a straight line
        for step in [1e-6, -1e-6] {
            let (to, by) = limit_moved(0.5, step, within);
            assert!((to - 0.5 - step).abs() < 1e-11 && (by - step).abs() < 1e-15, "{to} {by}");
        }
        // a step beyond what any number does in the inverse: the limit is not reached, at the bound
        for step in [0.6, 0.5, 0.4] {
            assert_eq!(limit_moved(0.5, step, within).0, 1.5);
        }
        // 1/x' = 2 + 10/0.25
        let (to, by) = limit_moved(0.5, -10.0, within);
        assert!((to - 1.0 / 42.0).abs() < 1e-15 && (by + 10.0).abs() < 1e-12, "{to} {by}");
    }
}
