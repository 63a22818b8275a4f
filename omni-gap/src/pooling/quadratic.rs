//! −2·ln(likelihood) = const − 2·bᵀx + xᵀAx: sums of it are sums of A and b.

use nalgebra::{DMatrix, DVector};

/// A and b.
#[derive(Clone, Debug)]
pub(super) struct Quadratic {
    pub hess: DMatrix<f64>,
    pub toward: DVector<f64>,
}

impl Quadratic {
    /// Nothing known of so many coordinates.
    pub fn nothing(coordinates: usize) -> Self {
        Self { hess: DMatrix::zeros(coordinates, coordinates), toward: DVector::zeros(coordinates) }
    }

    /// What all of them say together; none of none.
    pub fn sum<'a>(all: impl IntoIterator<Item = &'a Self>) -> Option<Self> {
        let mut all = all.into_iter();
        let first = all.next()?.clone();
        Some(all.fold(first, |mut sum, more| {
            sum.add(more);
            sum
        }))
    }

    /// Adds what else is known of the same coordinates.
    pub fn add(&mut self, other: &Self) {
        self.hess += &other.hess;
        self.toward += &other.toward;
    }

    /// Adds what is known of some coordinates; `places` says which coordinate of this each of the other's is, or which several of
    /// this it is the sum of.
    pub fn add_at(&mut self, other: &Self, places: &[&[usize]]) {
        for (r, rows) in places.iter().enumerate() {
            for row in *rows {
                self.toward[*row] += other.toward[r];
                for (c, columns) in places.iter().enumerate() {
                    for column in *columns {
                        self.hess[(*row, *column)] += other.hess[(r, c)];
                    }
                }
            }
        }
    }

    /// The coordinate's estimate and standard error with all others free; none where the equations do not tell it.
    pub fn estimate(&self, coordinate: usize) -> Option<(f64, f64)> {
        let solved = self.hess.clone().cholesky()?;
        let mut along = DVector::zeros(self.toward.len());
        along[coordinate] = 1.0;
        let variance = solved.solve(&along)[coordinate];
        let value = solved.solve(&self.toward)[coordinate];
        (variance > 0.0 && variance.is_finite() && value.is_finite()).then(|| (value, variance.sqrt()))
    }
}
