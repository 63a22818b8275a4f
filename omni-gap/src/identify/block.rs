//! The normal equations of one window, added up as the pass goes.
//!
//! ```text
//! H = Σ JᵀJ,  g = Σ Jᵀe          J: d predicted / d (start, parameters), one row a measured number
//! ```

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::misfit::Misfit;
use super::pass::Seen;
use super::window::{START, WindowLinear};
use crate::simulate::MAX_CHANNELS;

/// Keeps a start regular that nothing in its window measures: 1/σ² of (m, m, rad, m/s, m/s, rad/s), much looser than
/// any sensor, as damping only.
const LOOSE: [f64; START] = [1.0, 1.0, 1.0, 1.0, 1.0, 0.1];

/// Parameters of a start that are geometry: x, y, θ.
const MOVED: usize = 3;

/// Everything that a step of the fit needs of one window.
#[derive(Clone, Debug)]
pub(super) struct Block {
    /// JᵀJ, the start first.
    pub hess: DMatrix<f64>,
    /// Jᵀe
    pub grad: DVector<f64>,
    /// How far its numbers are missed.
    pub misfit: Misfit,
}

/// The sums of one window on their way; lanes are (v, vn, ω, free…).
#[derive(Clone)]
pub(super) struct Sums<const LANES: usize> {
    /// On and above the diagonal.
    lanes: [[f64; LANES]; LANES],
    grad: [f64; LANES],
    moved: [[f64; MOVED]; MOVED],
    moved_lanes: [[f64; LANES]; MOVED],
    moved_grad: [f64; MOVED],
    misfit: Misfit,
}

impl<const LANES: usize> Sums<LANES> {
    /// Of nothing yet.
    pub const NOTHING: Self = Self {
        lanes: [[0.0; LANES]; LANES],
        grad: [0.0; LANES],
        moved: [[0.0; MOVED]; MOVED],
        moved_lanes: [[0.0; LANES]; MOVED],
        moved_grad: [0.0; MOVED],
        misfit: Misfit { by_channel: [0.0; MAX_CHANNELS], numbers: 0 },
    };

    /// Adds the numbers of one row; `pose` are the channels that depend on where the start is.
    #[inline]
    pub fn add(&mut self, row: &[Seen<LANES>], pose: &Range<usize>) {
        // H += JᵀJ, a line at a time: the line stays in registers while the row's numbers pass; H is symmetric, and a
        // quarter of it is not needed
        let (upper, lower) = self.lanes.split_at_mut(LANES / 2);
        for (a, line) in upper.iter_mut().enumerate() {
            let mut sum = *line;
            for seen in row {
                let slope = seen.lanes[a];
                for (h, other) in sum.iter_mut().zip(&seen.lanes) {
                    *h += slope * other;
                }
            }
            *line = sum;
        }
        for (a, line) in lower.iter_mut().enumerate() {
            let mut sum = *line;
            for seen in row {
                let slope = seen.lanes[LANES / 2 + a];
                for (h, other) in sum[LANES / 2..].iter_mut().zip(&seen.lanes[LANES / 2..]) {
                    *h += slope * other;
                }
            }
            *line = sum;
        }
        for seen in row {
            for (g, slope) in self.grad.iter_mut().zip(&seen.lanes) {
                *g += slope * seen.error;
            }
            self.misfit.add(seen.channel, seen.error);
            if pose.contains(&seen.channel) {
                self.add_moved(seen);
            }
        }
    }

    #[inline]
    fn add_moved(&mut self, seen: &Seen<LANES>) {
        for (a, slope) in seen.moved.into_iter().enumerate() {
            for (h, other) in self.moved[a].iter_mut().zip(&seen.moved) {
                *h += slope * other;
            }
            for (h, other) in self.moved_lanes[a].iter_mut().zip(&seen.lanes) {
                *h += slope * other;
            }
            self.moved_grad[a] += slope * seen.error;
        }
    }

    /// The equations of the start and the first `lanes` lanes.
    pub fn block(&self, lanes: usize) -> Block {
        let entry = |row: usize, column: usize| match (row.checked_sub(MOVED), column.checked_sub(MOVED)) {
            (Some(a), Some(b)) => self.lanes[a.min(b)][a.max(b)],
            (Some(a), None) => self.moved_lanes[column][a],
            (None, Some(b)) => self.moved_lanes[row][b],
            (None, None) => self.moved[row][column],
        };
        let slope = |k: usize| k.checked_sub(MOVED).map_or_else(|| self.moved_grad[k], |a| self.grad[a]);
        Block {
            hess: DMatrix::from_fn(MOVED + lanes, MOVED + lanes, entry),
            grad: DVector::from_fn(MOVED + lanes, |k, _| slope(k)),
            misfit: self.misfit,
        }
    }
}

impl Block {
    /// Of a window that was kept whole.
    pub fn of(window: &WindowLinear) -> Self {
        let mut misfit = Misfit::default();
        for ((_, channel), error) in window.places.iter().zip(&window.error) {
            misfit.add(usize::from(*channel), *error);
        }
        Self { misfit, ..Self::of_equations(&window.jacobian, &window.error) }
    }

    /// The equations alone: what was measured is nobody's.
    pub fn of_equations(jacobian: &DMatrix<f64>, error: &DVector<f64>) -> Self {
        Self { hess: jacobian.tr_mul(jacobian), grad: jacobian.tr_mul(error), misfit: Misfit::default() }
    }

    /// H_zz, held loosely.
    pub fn start(&self) -> DMatrix<f64> {
        let mut hzz = self.hess.view((0, 0), (START, START)).into_owned();
        for k in 0..START {
            hzz[(k, k)] += LOOSE[k];
        }
        hzz
    }

    /// H_zz⁻¹·[H_zp, g_z], by Cholesky.
    pub fn eliminate(&self) -> (DMatrix<f64>, DVector<f64>) {
        let free = self.hess.ncols() - START;
        match self.start().cholesky() {
            Some(c) => (c.solve(&self.hess.view((0, START), (START, free))), c.solve(&self.grad.rows(0, START))),
            None => (DMatrix::zeros(START, free), DVector::zeros(START)),
        }
    }
}
