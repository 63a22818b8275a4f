//! Straight lines and planes through measurements, and how far they would move without one of the runs.

use nalgebra::{DMatrix, DVector};

/// A number and its one-sigma uncertainty, in the number's unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// One sigma.
    pub std: f64,
}

/// Rows of y = X·θ, with instruments Z that go with X but not with its noise.
#[derive(Clone, Debug)]
pub(super) struct Rows<const K: usize> {
    y: Vec<f64>,
    x: Vec<[f64; K]>,
    z: Vec<[f64; K]>,
}

impl<const K: usize> Default for Rows<K> {
    fn default() -> Self {
        Self { y: Vec::new(), x: Vec::new(), z: Vec::new() }
    }
}

impl<const K: usize> Rows<K> {
    /// Adds a row.
    pub fn push(&mut self, y: f64, x: [f64; K], z: [f64; K]) {
        self.y.push(y);
        self.x.push(x);
        self.z.push(z);
    }

    /// θ = (XᵀX)⁻¹·Xᵀ·y (eq. 40); `None` where X does not tell the numbers apart.
    pub fn least_squares(&self) -> Option<[f64; K]> {
        solve(&self.x, &self.x, &self.y)
    }

    /// θ = (ZᵀX)⁻¹·Zᵀ·y (eq. 41).
    pub fn instrumental(&self) -> Option<[f64; K]> {
        solve(&self.z, &self.x, &self.y)
    }
}

fn solve<const K: usize>(z: &[[f64; K]], x: &[[f64; K]], y: &[f64]) -> Option<[f64; K]> {
    if y.len() < K {
        return None;
    }
    let rows = |of: &[[f64; K]]| DMatrix::from_fn(of.len(), K, |r, c| of[r][c]);
    let (z, x, y) = (rows(z), rows(x), DVector::from_column_slice(y));
    let zx = z.tr_mul(&x);
    // the columns' own sizes set what counts as singular
    let size = |m: &DMatrix<f64>, k: usize| m.column(k).norm();
    let scaled = DMatrix::from_fn(K, K, |r, c| zx[(r, c)] / (size(&z, r) * size(&x, c)));
    let singular = scaled.svd(false, false).singular_values;
    if !singular.iter().all(|s| s.is_finite() && *s > 1e-6) {
        return None;
    }
    let theta = zx.lu().solve(&z.tr_mul(&y))?;
    Some(std::array::from_fn(|k| theta[k]))
}

/// The estimates from all runs, and the uncertainty that leaving out one run after the other shows.
///
/// `runs` is how many there are; `estimate(without)` makes the numbers, without a run where one is named. With a single
/// run there is no uncertainty to be had: it is infinite.
pub(super) fn jackknife<const K: usize>(
    runs: usize,
    estimate: impl Fn(Option<usize>) -> Option<[f64; K]>,
) -> Option<[Estimate; K]> {
    let all = estimate(None)?;
    let without: Vec<[f64; K]> = (0..runs).filter_map(|run| estimate(Some(run))).collect();
    let n = without.len() as f64;
    Some(std::array::from_fn(|k| {
        // σ² = (n − 1)/n·Σ(θ₋ᵢ − mean)²
        let mean = without.iter().map(|w| w[k]).sum::<f64>() / n;
        let squares: f64 = without.iter().map(|w| (w[k] - mean).powi(2)).sum();
        let std = if without.len() < 2 { f64::INFINITY } else { ((n - 1.0) / n * squares).sqrt() };
        Estimate { value: all[k], std }
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_is_found_again_and_a_column_twice_is_refused() {
        let (mut rows, mut twice) = (Rows::<2>::default(), Rows::<2>::default());
        for k in 0..9 {
            let x = [f64::from(k), f64::from(k * k)];
            rows.push(2.0 * x[0] - 0.5 * x[1], x, x);
            twice.push(x[0], [x[0], x[0]], [x[0], x[0]]);
        }
        let [a, b] = rows.least_squares().unwrap();
        assert!((a - 2.0).abs() < 1e-9 && (b + 0.5).abs() < 1e-9);
        assert_eq!(twice.least_squares(), None);
    }

    #[test]
    fn noise_in_the_regressor_draws_least_squares_down_and_not_the_instruments() {
        let mut rows = Rows::<1>::default();
        for k in 0..4000 {
            let clean = f64::from(k % 10) - 4.5;
            let noise = if k % 20 < 10 { 3.0 } else { -3.0 };
            rows.push(2.0 * clean, [clean + noise], [clean]);
        }
        // var(x) = 8.25, var(noise) = 9: least squares is drawn down to 2·8.25/17.25
        assert!((rows.least_squares().unwrap()[0] - 2.0 * 8.25 / 17.25).abs() < 1e-9);
        assert!((rows.instrumental().unwrap()[0] - 2.0).abs() < 1e-9);
    }

    #[test]
    fn the_jackknife_of_a_mean_is_its_standard_error() {
        let x = [1.0, 2.0, 4.0, 7.0];
        let mean = |without: Option<usize>| {
            let kept: Vec<f64> = (0..4).filter(|k| Some(*k) != without).map(|k| x[k]).collect();
            Some([kept.iter().sum::<f64>() / kept.len() as f64])
        };
        let [found] = jackknife(4, mean).unwrap();
        // s²/n with s² = Σ(x − 3.5)²/3 = 21/3
        assert!((found.value - 3.5).abs() < 1e-12 && (found.std - (7.0_f64 / 4.0).sqrt()).abs() < 1e-12);
    }
}
