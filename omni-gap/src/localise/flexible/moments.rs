//! Boosted additive regression, by its sums alone.
//!
//! ```text
//! e = Σ_g z_gᵀ·w_g + ε      g: the functions of one feature
//! w_g ← w_g + ν·(Z_gᵀZ_g + ρ·diag)⁻¹·Z_gᵀ(e − Z·w)      the g that foretells best, again and again
//! ```
//!
//! Each step takes up some of one feature (component-wise L2 boosting: Bühlmann and Yu, Journal of the American Statistical
//! Association 98, 2003), whichever best foretells what it has not seen, part by part of the recordings, until none does: of many
//! features few matter, and a regression on all at once would learn noise. All is smooth in the data between one choice and
//! the next, so that machines whose last digits differ agree.

use nalgebra::{DMatrix, DVector};

/// Sums over samples of columns and an error.
#[derive(Clone, Debug)]
pub(super) struct Moments {
    /// Σ z·zᵀ; the lower triangle.
    columns: DMatrix<f64>,
    /// Σ z·e
    with_error: DVector<f64>,
    /// Σ e²
    error: f64,
}

impl Moments {
    /// Of no samples, in so many columns.
    pub fn none(columns: usize) -> Self {
        Self { columns: DMatrix::zeros(columns, columns), with_error: DVector::zeros(columns), error: 0.0 }
    }

    /// One sample more.
    pub fn add(&mut self, columns: &DVector<f64>, error: f64) {
        self.columns.syger(1.0, columns, columns, 1.0);
        self.with_error.axpy(error, columns, 1.0);
        self.error += error * error;
    }

    fn plus(mut self, other: &Self) -> Self {
        self.columns += &other.columns;
        self.with_error += &other.with_error;
        self.error += other.error;
        self
    }

    fn less(&self, other: &Self) -> Self {
        Self {
            columns: &self.columns - &other.columns,
            with_error: &self.with_error - &other.with_error,
            error: self.error - other.error,
        }
    }

    fn times(&self, weights: &DVector<f64>) -> DVector<f64> {
        let mut product = DVector::zeros(weights.len());
        product.sygemv(1.0, &self.columns, weights, 0.0);
        product
    }

    /// The same samples, with what weights foretell taken off their errors.
    pub fn after(&self, weights: &DVector<f64>) -> Self {
        let foretold = self.times(weights);
        Self {
            error: self.error - 2.0 * weights.dot(&self.with_error) + weights.dot(&foretold),
            with_error: &self.with_error - foretold,
            columns: self.columns.clone(),
        }
    }

    fn product(&self, a: usize, b: usize) -> f64 {
        self.columns[(a.max(b), a.min(b))]
    }

    /// The step of one feature's weights, of all of whose columns.
    fn step(&self, feature: &[usize], boosting: &Boosting) -> DVector<f64> {
        let n = feature.len();
        let mut stiff = DMatrix::from_fn(n, n, |a, b| self.product(feature[a], feature[b]));
        let largest = stiff.diagonal().amax();
        for k in 0..n {
            // a column that never moves stays out
            stiff[(k, k)] += boosting.ridge * stiff[(k, k)].max(f64::EPSILON * largest).max(f64::MIN_POSITIVE);
        }
        let along = DVector::from_fn(n, |k, _| self.with_error[feature[k]]);
        stiff.cholesky().map_or_else(|| DVector::zeros(n), |factor| factor.solve(&along) * boosting.rate)
    }

    /// By how much Σ e² falls with a step of one feature's weights.
    fn gain(&self, feature: &[usize], step: &DVector<f64>) -> f64 {
        let of = |(k, a): (usize, &usize)| {
            let bent: f64 = feature.iter().zip(step.iter()).map(|(b, step)| self.product(*a, *b) * step).sum();
            step[k] * (2.0 * self.with_error[*a] - bent)
        };
        feature.iter().enumerate().map(of).sum()
    }

    /// Takes what a step foretells off the errors.
    fn take(&mut self, feature: &[usize], step: &DVector<f64>) {
        self.error -= self.gain(feature, step);
        for row in 0..self.with_error.len() {
            let foretold: f64 = feature.iter().zip(step.iter()).map(|(k, step)| self.product(row, *k) * step).sum();
            self.with_error[row] -= foretold;
        }
    }
}

/// The same places of several wheels, fold by fold.
pub(super) fn together(parts: &[Vec<Moments>]) -> Vec<Moments> {
    let Some((first, rest)) = parts.split_first() else { return Vec::new() };
    rest.iter().fold(first.clone(), |sums, part| sums.into_iter().zip(part).map(|(sum, more)| sum.plus(more)).collect())
}

/// How it is boosted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Boosting {
    /// Part of its way that a step goes [1]
    pub rate: f64,
    /// Ridge over the mean square of each column [1]
    pub ridge: f64,
    /// Share of the errors' squares that a step has to foretell [1]
    pub least_gain: f64,
    /// Steps at the most.
    pub steps: usize,
}

/// The weights, of functions that belong to features, that foretell best what each fold is by the others; all zero where none do.
pub(super) fn boosted(folds: &[Moments], features: &[Vec<usize>], boosting: &Boosting) -> DVector<f64> {
    let Some((first, rest)) = folds.split_first() else { return DVector::zeros(0) };
    let mut all = rest.iter().fold(first.clone(), Moments::plus);
    let mut weights = DVector::zeros(all.with_error.len());
    let least = boosting.least_gain * all.error;
    // what each fold is foretold by, and the fold
    let mut apart: Vec<(Moments, Moments)> = folds.iter().map(|fold| (all.less(fold), fold.clone())).collect();
    for _ in 0..boosting.steps {
        let foretold = |feature: &Vec<usize>| {
            let gain = |(others, fold): &(Moments, Moments)| fold.gain(feature, &others.step(feature, boosting));
            apart.iter().map(gain).sum::<f64>()
        };
        let best = features.iter().map(|feature| (feature, foretold(feature))).max_by(|a, b| a.1.total_cmp(&b.1));
        let Some((feature, _)) = best.filter(|(_, gain)| *gain > least) else { break };
        for (others, fold) in &mut apart {
            let step = others.step(feature, boosting);
            others.take(feature, &step);
            fold.take(feature, &step);
        }
        let step = all.step(feature, boosting);
        all.take(feature, &step);
        feature.iter().zip(step.iter()).for_each(|(k, step)| weights[*k] += step);
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A fold whose errors are so many times x, with x on each side of zero.
    fn fold(times: f64) -> Moments {
        let mut sums = Moments::none(3);
        for k in 0..40 {
            let x = f64::from(k) / 20.0 - 1.0;
            // the last column never moves
            sums.add(&DVector::from_vec(vec![1.0, x, 0.0]), times * x + 0.5);
        }
        sums
    }

    const SURE: Boosting = Boosting { rate: 1.0, ridge: 1e-9, least_gain: 1e-6, steps: 20 };

    fn features() -> Vec<Vec<usize>> {
        vec![vec![0], vec![1, 2]]
    }

    #[test]
    fn what_is_so_in_every_fold_is_learned() {
        let weights = boosted(&[fold(2.0), fold(2.0), fold(2.0)], &features(), &SURE);
        assert!((weights[0] - 0.5).abs() < 1e-3 && (weights[1] - 2.0).abs() < 1e-3 && weights[2] == 0.0, "{weights}");
    }

    #[test]
    fn what_is_otherwise_in_each_fold_is_not() {
        let turned = |times: f64| fold(times).after(&DVector::from_vec(vec![0.5, 0.0, 0.0]));
        assert_eq!(boosted(&[turned(2.0), turned(-2.0)], &features(), &SURE).amax(), 0.0);
    }

    #[test]
    fn a_step_takes_off_what_it_says_it_gains() {
        let (mut sums, feature) = (fold(2.0), vec![0, 1]);
        let step = sums.step(&feature, &Boosting { rate: 0.5, ..SURE });
        let (before, gain) = (sums.error, sums.gain(&feature, &step));
        let whole = fold(2.0).after(&DVector::from_vec(vec![step[0], step[1], 0.0]));
        sums.take(&feature, &step);
        assert!(gain > 0.0 && (before - gain - sums.error).abs() < 1e-9 && (whole.error - sums.error).abs() < 1e-9);
        assert!((whole.with_error - sums.with_error).amax() < 1e-9);
    }

    #[test]
    fn what_weights_foretell_is_taken_off() {
        let left = fold(2.0).after(&DVector::from_vec(vec![0.5, 2.0, 7.0]));
        assert!(left.error.abs() < 1e-12 && left.with_error.amax() < 1e-12);
    }
}
