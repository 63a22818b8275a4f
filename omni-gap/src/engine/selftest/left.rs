//! What is left of signatures once starts and nominal numbers have taken their share.

use nalgebra::{DMatrix, DVector};

use super::suspects::Suspect;
use crate::identify::Overlap;

/// The products of what is left.
pub(super) struct Left {
    sum: Overlap,
    /// The numbers' share of the products [σ²]
    taken: DMatrix<f64>,
}

impl Left {
    pub fn new(taken: DMatrix<f64>, sum: Overlap) -> Self {
        Self { sum, taken }
    }

    fn at(&self, a: usize, b: usize) -> f64 {
        self.sum.signatures[(a, b)] - self.taken[(a, b)]
    }

    /// How many numbers were measured.
    pub fn numbers(&self) -> usize {
        self.sum.numbers
    }

    /// |s⊥|² of one column [σ²]
    pub fn size_of(&self, column: usize) -> f64 {
        self.at(column, column).max(0.0)
    }

    /// |s⊥|² of a suspect at its typical size [σ²]
    pub fn size(&self, suspect: &Suspect) -> f64 {
        self.size_of(suspect.typical)
    }

    /// The share of |s|² that the nominal numbers take, within what is stated of them [1].
    pub fn share_taken(&self, suspect: &Suspect) -> f64 {
        let k = suspect.typical;
        let whole = self.sum.signatures[(k, k)];
        if whole > 0.0 { (self.taken[(k, k)] / whole).clamp(0.0, 1.0) } else { 0.0 }
    }

    /// What is left of a suspect beside the best that a rival can make of its free numbers [σ²]; the rival's own products
    /// are raised by a share so that their equations can be solved.
    pub fn beside(&self, suspect: &Suspect, rival: &Suspect, regular: f64) -> f64 {
        let free: Vec<usize> = rival.free.clone().collect();
        let mut own = DMatrix::from_fn(free.len(), free.len(), |a, b| self.at(free[a], free[b]));
        let most = own.diagonal().max();
        for k in 0..free.len() {
            own[(k, k)] += regular * most + f64::MIN_POSITIVE;
        }
        let shared = DVector::from_fn(free.len(), |k, _| self.at(free[k], suspect.typical));
        let imitated = own.cholesky().map_or(0.0, |c| shared.dot(&c.solve(&shared)));
        (self.size(suspect) - imitated).max(0.0)
    }
}
