//! What is known before the data: the stated uncertainty of the robot file.
//!
//! Each row says that a product of nominal factors is one, within its relative sigma: Σ c·ln(factor) = 0 ± σ. (In the
//! logarithm, a file that is a third too high and a robot that is a third too low are the same distance apart.) The back-EMF constant and the torque
//! constant are stated each on its own, so the factor that they share and their ratio are known together only as well
//! as the file says of each.

use model_core::effects::nominal::{self, Number};
use model_core::plant::robot::Nominal;

use crate::log::RobotFile;
use crate::simulate::{Model, Slot};

/// One statement: Σ coefficient·ln(factor) = middle within sigma.
#[derive(Clone, Debug)]
pub struct PriorRow {
    /// The factors and their coefficients.
    pub terms: Vec<(Nominal, f64)>,
    /// What they come to [1]; zero of a robot file's own numbers
    pub middle: f64,
    /// One-sigma relative uncertainty
    pub sigma: f64,
    /// True if the robot file states it of one of its numbers, the last factor's own; false for what a diagnosis adds.
    stated: bool,
}

impl PriorRow {
    /// Σ coefficient·ln(factor) of a model.
    fn sum<const N: usize>(&self, model: &Model<N>) -> f64 {
        self.terms.iter().map(|(p, c)| c * model.get(Slot::Nominal(*p)).ln()).sum()
    }
}

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
    /// Of friction: the body axis (v, vn, ω: 0, 1, 2) that it is wrong on; `None`: on all.
    pub axis: Option<usize>,
}

impl FreedPrior {
    /// True if it speaks of a factor.
    pub fn speaks_of(&self, factor: Nominal) -> bool {
        factor.cause() == self.cause && (self.axis.is_none() || self.axis == factor.axis())
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

    /// The same without what it says of a parameter cause, which stays loosely held (at a relative sigma of `loose`) so
    /// that a fit cannot run away. K_t and K_v stay as equal to each other as they were when only their common factor is wrong.
    pub fn without(&self, release: FreedPrior, loose: f64) -> Self {
        let mut prior = self.clone();
        for k in self.rows_of(release) {
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
