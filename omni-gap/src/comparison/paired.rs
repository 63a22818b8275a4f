//! Both sides fitted with one model, and the equations that each leaves of its numbers.
//!
//! The numbers of B are those of A but for what is allowed to change:
//!
//! ```text
//! a = a₀ + x                     what A says of x:  H_A·x = g_A
//! b = a + E·δ = b₀ + (x + E·δ − d₀)                  H_B·(x + E·δ − d₀) = g_B,   d₀ = b₀ − a₀
//! ```
//!
//! with what the robot file states of a, once. An error of the file that both sides share then cancels out of δ. Numbers of the
//! file stand as their logarithms: forces that no recording tells the scale of are then off by the same on both sides.

use nalgebra::{DMatrix, DVector};

use super::common_number::CommonNumber;
use crate::identify::{Fit, Free, Prior, slopes_of};
use crate::simulate::Slot;

/// What one side says of the numbers of the common model, in the order of its slots; of those that it does not tell, nothing.
#[derive(Clone, Debug)]
struct Side {
    /// Where it was linearised, coordinate by coordinate.
    at: DVector<f64>,
    /// The data's equations there, weighted down by their dispersion.
    hess: DMatrix<f64>,
    grad: DVector<f64>,
    meat: DMatrix<f64>,
}

impl Side {
    /// Of a fit, in the coordinates of the common model's numbers.
    fn of<const N: usize>(fit: &Fit<N>, numbers: &[CommonNumber]) -> Self {
        let slots: Vec<Option<Slot>> = numbers.iter().map(|number| number.slot_in(&fit.model)).collect();
        let slope = |k: usize| slots[k].map_or(1.0, |slot| numbers[k].slope_at(fit.model.get(slot)));
        let data = fit.equations.clone().with_dispersion(fit.dispersion.max(fit.spread));
        let place: Vec<Option<usize>> =
            slots.iter().map(|slot| fit.free.iter().position(|free| Some(free.slot) == *slot)).collect();
        let n = slots.len();
        let spread = |matrix: &DMatrix<f64>| {
            DMatrix::from_fn(n, n, |r, c| {
                place[r].zip(place[c]).map_or(0.0, |(at_r, at_c)| slope(r) * slope(c) * matrix[(at_r, at_c)])
            })
        };
        Self {
            at: DVector::from_fn(n, |k, _| {
                slots[k].map_or(f64::NAN, |slot| numbers[k].coordinate(fit.model.get(slot)))
            }),
            hess: spread(&data.hess),
            meat: spread(&data.meat),
            grad: DVector::from_fn(n, |k, _| place[k].map_or(0.0, |at| slope(k) * data.grad[at])),
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
    /// The same in the number's coordinate: of a number of the file, whose scale A may not tell, it is surer.
    pub in_coordinate: (f64, f64),
}

impl Change {
    /// Standard errors by which it differs from none.
    pub fn errors(&self) -> f64 {
        let (by, std) = self.in_coordinate;
        if std > 0.0 { by.abs() / std } else { 0.0 }
    }
}

impl Pair {
    /// Of two fits of the same model, whose numbers are `common`.
    pub fn of<const N: usize>([a, b]: [&Fit<N>; 2], common: &[CommonNumber], prior: &Prior) -> Self {
        let [mut side_a, mut side_b] = [a, b].map(|fit| Side::of(fit, common));
        // what one side's model lacks is no difference
        for (x, y) in side_a.at.iter_mut().zip(side_b.at.iter_mut()) {
            (*x, *y) = (if x.is_nan() { *y } else { *x }, if y.is_nan() { *x } else { *y });
        }
        let width = |number: &CommonNumber| number.coordinate(number.within.1) - number.coordinate(number.within.0);
        let loose = DVector::from_fn(common.len(), |k, _| width(&common[k]).powi(-2));
        let free: Vec<Free> = common.iter().filter_map(|number| number.free_in(&a.model)).collect();
        let nominal: Vec<Free> = free.into_iter().filter(|free| matches!(free.slot, Slot::Nominal(_))).collect();
        // numbers of the file stand first, and only they are stated
        let mut slopes = slopes_of(prior, &a.model, &nominal).resize_horizontally(common.len(), 0.0);
        for (mut column, (number, at)) in slopes.column_iter_mut().zip(common.iter().zip(&side_a.at)) {
            column *= number.slope_at(number.value_at(*at));
        }
        let violations = DVector::from_vec(prior.violations(&a.model));
        let stated = (slopes.tr_mul(&slopes) + DMatrix::from_diagonal(&loose), slopes.tr_mul(&violations));
        Self { a: side_a, b: side_b, stated, loose }
    }

    /// The coordinate of a number where it was fitted to A.
    pub fn in_a(&self, number: usize) -> f64 {
        self.a.at[number]
    }

    /// How the numbers of these slots change where no others do; none where the equations have no answer.
    pub fn changes(&self, changing: &[usize], common: &[CommonNumber]) -> Option<Vec<Change>> {
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
        let std = |along: &[(usize, f64)]| {
            let mut direction = DVector::zeros(n + m);
            along.iter().for_each(|(place, by)| direction[*place] = *by);
            variance(&direction).sqrt()
        };
        let change = |(k, slot): (usize, &usize)| {
            let number = &common[*slot];
            let (in_a, by) = (self.a.at[*slot] + found[*slot], found[n + k]);
            let (a, b) = (number.value_at(in_a), number.value_at(in_a + by));
            let (slope_a, slope_b) = (number.slope_at(a), number.slope_at(b));
            Change {
                slot: *slot,
                a: (a, std(&[(*slot, slope_a)])),
                b: (b, std(&[(*slot, slope_b), (n + k, slope_b)])),
                by: (b - a, std(&[(*slot, slope_b - slope_a), (n + k, slope_b)])),
                in_coordinate: (by, std(&[(n + k, 1.0)])),
            }
        };
        Some(changing.iter().enumerate().map(change).collect())
    }
}
