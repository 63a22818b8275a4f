//! Both sides fitted with one model, and the equations that each leaves of its numbers.
//!
//! The numbers of B are those of A but for what is allowed to change:
//!
//! ```text
//! a = a₀ + x                     what A says of x:  H_A·x = g_A
//! b = a + E·δ = b₀ + (x + E·δ − d₀)                  H_B·(x + E·δ − d₀) = g_B,   d₀ = b₀ − a₀
//! ```
//!
//! with what the robot file states of a, once. An error of the file that both sides share then cancels out of δ.

use nalgebra::{DMatrix, DVector};

use super::common_number::CommonNumber;
use crate::identify::{Fit, Free, Prior, slopes_of};
use crate::simulate::Slot;

/// What one side says of the numbers of the common model, in the order of its slots; of those that it does not tell, nothing.
#[derive(Clone, Debug)]
struct Side {
    /// Where it was linearised.
    at: DVector<f64>,
    /// The data's equations there, weighted down by their dispersion.
    hess: DMatrix<f64>,
    grad: DVector<f64>,
    meat: DMatrix<f64>,
}

impl Side {
    /// Of a fit; the slots are those of the common model, none where this side's lacks it.
    fn of<const N: usize>(fit: &Fit<N>, slots: &[Option<Slot>]) -> Self {
        let data = fit.equations.clone().with_dispersion(fit.dispersion.max(fit.spread));
        let place: Vec<Option<usize>> =
            slots.iter().map(|slot| fit.free.iter().position(|free| Some(free.slot) == *slot)).collect();
        let n = slots.len();
        let spread = |matrix: &DMatrix<f64>| {
            DMatrix::from_fn(n, n, |r, c| place[r].zip(place[c]).map_or(0.0, |(r, c)| matrix[(r, c)]))
        };
        Self {
            at: DVector::from_iterator(n, slots.iter().map(|slot| slot.map_or(f64::NAN, |slot| fit.model.get(slot)))),
            hess: spread(&data.hess),
            meat: spread(&data.meat),
            grad: DVector::from_iterator(n, place.iter().map(|place| place.map_or(0.0, |place| data.grad[place]))),
        }
    }
}

/// Both sides, and what is stated of A's numbers.
#[derive(Clone, Debug)]
pub(super) struct Pair {
    a: Side,
    b: Side,
    /// JᵀJ and Jᵀ·v of what is stated, at A's fit, with a loose hold on the bounds' width.
    stated: (DMatrix<f64>, DVector<f64>),
    /// 1/width² of each slot's bounds.
    loose: DVector<f64>,
}

/// The change of a number from A to B.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Change {
    /// The slot's place in the common model.
    pub slot: usize,
    /// In A, with one standard error.
    pub a: (f64, f64),
    /// In B, with one standard error.
    pub b: (f64, f64),
    /// From A to B, with one standard error, which is less than those of both sides together where they share an error.
    pub by: (f64, f64),
}

impl Change {
    /// Standard errors by which it differs from none.
    pub fn errors(&self) -> f64 {
        if self.by.1 > 0.0 { self.by.0.abs() / self.by.1 } else { 0.0 }
    }
}

impl Pair {
    /// Of two fits of the same model, whose numbers are `common`.
    pub fn of<const N: usize>([a, b]: [&Fit<N>; 2], common: &[CommonNumber], prior: &Prior) -> Self {
        let side = |fit: &Fit<N>| {
            let slots: Vec<Option<Slot>> = common.iter().map(|number| number.slot_in(&fit.model)).collect();
            Side::of(fit, &slots)
        };
        let (mut side_a, mut side_b) = (side(a), side(b));
        // what one side's model lacks is no difference
        for (x, y) in side_a.at.iter_mut().zip(side_b.at.iter_mut()) {
            (*x, *y) = (if x.is_nan() { *y } else { *x }, if y.is_nan() { *x } else { *y });
        }
        let widths: Vec<f64> = common.iter().map(|number| number.within.1 - number.within.0).collect();
        let loose = DVector::from_iterator(widths.len(), widths.iter().map(|width| width.powi(-2)));
        let free: Vec<Free> = common.iter().filter_map(|number| number.free_in(&a.model)).collect();
        let nominal: Vec<Free> = free.into_iter().filter(|free| matches!(free.slot, Slot::Nominal(_))).collect();
        // numbers of the file stand first, and only they are stated
        let slopes = slopes_of(prior, &a.model, &nominal).resize_horizontally(widths.len(), 0.0);
        let violations = DVector::from_vec(prior.violations(&a.model));
        let stated = (slopes.tr_mul(&slopes) + DMatrix::from_diagonal(&loose), slopes.tr_mul(&violations));
        Self { a: side_a, b: side_b, stated, loose }
    }

    /// A number where it was fitted to A.
    pub fn in_a(&self, number: usize) -> f64 {
        self.a.at[number]
    }

    /// How the numbers of these slots change where no others do; none where the equations have no answer.
    pub fn changes(&self, changing: &[usize]) -> Option<Vec<Change>> {
        let (n, m) = (self.a.at.len(), changing.len());
        let apart = &self.b.at - &self.a.at;
        // from (x, δ) to what B sees
        let seen = DMatrix::from_fn(n, n + m, |r, c| {
            let same = if c < n { c == r } else { changing[c - n] == r };
            if same { 1.0 } else { 0.0 }
        });
        let mut hess = seen.tr_mul(&self.b.hess) * &seen;
        let mut grad = seen.tr_mul(&(&self.b.grad + &self.b.hess * apart));
        let mut meat = seen.tr_mul(&self.b.meat) * &seen;
        let (of_stated, pulled) = &self.stated;
        for r in 0..n {
            for c in 0..n {
                hess[(r, c)] += self.a.hess[(r, c)] + of_stated[(r, c)];
                meat[(r, c)] += self.a.meat[(r, c)] + of_stated[(r, c)];
            }
            grad[r] += self.a.grad[r] - pulled[r];
        }
        for (k, slot) in changing.iter().enumerate() {
            hess[(n + k, n + k)] += self.loose[*slot];
            meat[(n + k, n + k)] += self.loose[*slot];
        }
        let solved = hess.cholesky()?;
        let found = solved.solve(&grad);
        let inverse = solved.inverse();
        let robust = &inverse * meat * &inverse;
        // no surer than the equations alone say
        let variance = |direction: &DVector<f64>| {
            let of = |matrix: &DMatrix<f64>| direction.dot(&(matrix * direction));
            of(&robust).max(of(&inverse)).max(0.0)
        };
        let unit = |places: &[usize]| DVector::from_fn(n + m, |k, _| if places.contains(&k) { 1.0 } else { 0.0 });
        let change = |(k, slot): (usize, &usize)| {
            let std = |places: &[usize]| variance(&unit(places)).sqrt();
            let (a, by) = (self.a.at[*slot] + found[*slot], found[n + k]);
            let (of_a, of_b, of_change) = (std(&[*slot]), std(&[*slot, n + k]), std(&[n + k]));
            Change { slot: *slot, a: (a, of_a), b: (a + by, of_b), by: (by, of_change) }
        };
        Some(changing.iter().enumerate().map(change).collect())
    }
}
