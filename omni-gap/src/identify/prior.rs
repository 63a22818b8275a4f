//! What is known before the data: the stated uncertainty of the robot file.
//!
//! Each row says that a product of nominal factors is one, within its relative sigma: Σ c·ln(factor) = 0 ± σ. (In the
//! logarithm, a file that is a third too high and a robot that is a third too low are the same distance apart.) The back-EMF constant and the torque
//! constant are stated each on its own, so the factor that they share and their ratio are known together only as well
//! as the file says of each.

use model_core::effects::nominal::{self, Number};
use model_core::plant::robot::Nominal;

use super::common_factor::turned_to_common_factor;
use super::prior_row::PriorRow;
use crate::log::RobotFile;
use crate::simulate::Model;

/// Everything stated.
#[derive(Clone, Debug)]
pub struct Prior {
    /// The statements.
    pub rows: Vec<PriorRow>,
}

/// A nominal value that a diagnosis takes as plainly wrong: its statement is struck out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FreedPrior {
    /// The parameter cause.
    pub cause: &'static str,
    /// Which of the cause's numbers are wrong, and how they are.
    pub extent: Extent,
}

/// Which numbers of a parameter cause are wrong. Friction alone has one for each axis, and knows more than `Each`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// All of them, each by itself.
    Each,
    /// All of them by one factor, beside which each is as well known as stated: friction of another floor, or of other rollers.
    CommonFactor,
    /// That of a body axis (v, vn, ω: 0, 1, 2) alone.
    Axis(usize),
}

impl FreedPrior {
    /// True if it speaks of a factor.
    pub fn speaks_of(&self, factor: Nominal) -> bool {
        factor.cause() == self.cause && self.axis().is_none_or(|axis| factor.axis() == Some(axis))
    }

    /// The body axis (v, vn, ω: 0, 1, 2) that it speaks of alone.
    pub fn axis(&self) -> Option<usize> {
        match self.extent {
            Extent::Axis(axis) => Some(axis),
            Extent::Each | Extent::CommonFactor => None,
        }
    }
}

impl Prior {
    /// What a robot file states of its own uncertainty.
    pub fn stated(robot: &RobotFile) -> Self {
        let row = |number: &Number| PriorRow {
            terms: number.factors.iter().map(|p| (*p, 1.0)).collect(),
            middle: 0.0,
            sigma: robot.relative_uncertainty(number.key).unwrap_or(number.relative_uncertainty),
            stated: true,
        };
        Self { rows: nominal::numbers().map(row).collect() }
    }

    /// The statements that speak of a parameter cause.
    pub fn rows_of(&self, release: FreedPrior) -> Vec<usize> {
        let speaks = |row: &PriorRow| row.stated && row.terms.iter().any(|(p, _)| release.speaks_of(*p));
        (0..self.rows.len()).filter(|k| speaks(&self.rows[*k])).collect()
    }

    /// What a parameter cause says is wrong: the statements that speak of it, or the one that they come to of a common factor.
    pub fn struck_out_by(&self, release: FreedPrior) -> Vec<PriorRow> {
        let mut rows = self.statements_of(release);
        if release.extent == Extent::CommonFactor {
            rows = turned_to_common_factor(&rows, 0.0);
            rows.truncate(1);
        }
        rows
    }

    fn statements_of(&self, release: FreedPrior) -> Vec<PriorRow> {
        self.rows_of(release).into_iter().map(|k| self.rows[k].clone()).collect()
    }

    /// The same without what it says of a parameter cause, which stays loosely held (at a relative sigma of `loose`) so
    /// that a fit cannot run away. K_t and K_v stay as equal to each other as they were when only their common factor is wrong.
    pub fn without(&self, release: FreedPrior, loose: f64) -> Self {
        let mut prior = self.clone();
        let freed = self.rows_of(release);
        if release.extent == Extent::CommonFactor {
            for (k, row) in freed.into_iter().zip(turned_to_common_factor(&self.statements_of(release), loose)) {
                prior.rows[k] = row;
            }
            return prior;
        }
        for k in freed {
            prior.rows[k].sigma = loose;
        }
        if release.cause == "torque_constant" {
            let each: f64 = self.rows_of(release).iter().map(|k| self.rows[*k].sigma.powi(2)).sum();
            let terms = vec![(Nominal::KtOverKv, 1.0)];
            prior.rows.push(PriorRow { terms, middle: 0.0, sigma: each.sqrt(), stated: false });
        }
        prior
    }

    /// The same statements, no wider, of a robot that is this model.
    pub fn around<const N: usize>(&self, model: &Model<N>) -> Self {
        let rows = self.rows.iter().map(|row| PriorRow { middle: row.sum(model), ..row.clone() });
        Self { rows: rows.collect() }
    }

    /// How far each statement is violated by a model, in sigma.
    pub fn violations<const N: usize>(&self, model: &Model<N>) -> Vec<f64> {
        self.rows.iter().map(|row| (row.sum(model) - row.middle) / row.sigma).collect()
    }

    /// Σ violation²: what a model costs by what was stated.
    pub fn cost<const N: usize>(&self, model: &Model<N>) -> f64 {
        self.violations(model).iter().map(|v| v * v).sum()
    }
}
