//! A statement of what is known before the data.

use model_core::plant::robot::Nominal;

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
    pub(super) stated: bool,
}

impl PriorRow {
    /// Σ coefficient·ln(factor) of a model.
    pub(super) fn sum<const N: usize>(&self, model: &Model<N>) -> f64 {
        self.terms.iter().map(|(p, c)| c * model.get(Slot::Nominal(*p)).ln()).sum()
    }
}
