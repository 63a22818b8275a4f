//! What signatures have in common beyond what the windows' starts can imitate.
//!
//! ```text
//! SᵀS − SᵀJ_z·H_zz⁻¹·J_zᵀS, …      S: a column for each cause, in sigma, whitened; J_z: d predicted / d start
//! ```

use nalgebra::{DMatrix, DVector};

use super::block::Block;
use super::fit::{Free, with_prior};
use super::linear::Reduced;
use super::prior::Prior;
use super::window::{START, WindowLinear};
use crate::simulate::Model;

/// Sums of products over all windows, the starts eliminated.
#[derive(Clone, Debug)]
pub struct Overlap {
    /// Signatures with signatures [σ²]
    pub signatures: DMatrix<f64>,
    /// The parameters' derivatives with signatures, one row a parameter.
    pub shared: DMatrix<f64>,
    /// The parameters' derivatives with each other.
    pub parameters: DMatrix<f64>,
    /// How many numbers were summed over.
    pub numbers: usize,
}

impl Overlap {
    /// Of so many signatures and parameters, over no window yet.
    pub fn nothing(signatures: usize, parameters: usize) -> Self {
        Self {
            signatures: DMatrix::zeros(signatures, signatures),
            shared: DMatrix::zeros(parameters, signatures),
            parameters: DMatrix::zeros(parameters, parameters),
            numbers: 0,
        }
    }

    /// Adds a window, by the channels of a bit mask alone. `signatures` has a row for each of its numbers.
    pub fn add(&mut self, window: &WindowLinear, signatures: &DMatrix<f64>, channels: u16) {
        let kept: Vec<usize> = (0..window.places.len()).filter(|k| channels >> window.places[*k].1 & 1 == 1).collect();
        let jacobian = window.jacobian.select_rows(&kept);
        let s = signatures.select_rows(&kept);
        let with = jacobian.tr_mul(&s);
        let block = Block::of(&WindowLinear { places: Vec::new(), error: DVector::zeros(kept.len()), jacobian });
        let (n, of_starts) = (self.parameters.ncols(), with.rows(0, START));
        let (x, _) = block.eliminate();
        let own = block.start().cholesky().map_or_else(|| DMatrix::zeros(START, s.ncols()), |c| c.solve(&of_starts));
        self.signatures += s.tr_mul(&s) - of_starts.tr_mul(&own);
        self.shared += with.rows(START, n) - x.tr_mul(&of_starts);
        self.parameters += block.hess.view((START, START), (n, n)) - block.hess.view((START, 0), (n, START)) * &x;
        self.numbers += kept.len();
    }

    /// Of the windows of both.
    #[must_use]
    pub fn and(mut self, other: Self) -> Self {
        self.signatures += other.signatures;
        self.shared += other.shared;
        self.parameters += other.parameters;
        self.numbers += other.numbers;
        self
    }

    /// The part of the signatures' products that the free numbers of a model take, held by what was stated of them [σ²].
    pub fn taken_by_parameters<const N: usize>(&self, model: &Model<N>, free: &[Free], prior: &Prior) -> DMatrix<f64> {
        let n = self.parameters.ncols();
        let data = Reduced {
            hess: self.parameters.clone(),
            grad: DVector::zeros(n),
            meat: DMatrix::zeros(n, n),
            by_starts: 0.0,
        };
        let held = with_prior(data, model, free, prior).hess;
        held.cholesky().map_or_else(
            || DMatrix::zeros(self.signatures.nrows(), self.signatures.ncols()),
            |c| self.shared.tr_mul(&c.solve(&self.shared)),
        )
    }
}
