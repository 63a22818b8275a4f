//! How good an estimator was of one number, over many trials.

use super::study::{Estimates, Trial};

/// Statistics of one estimator of one number; errors are relative.
#[derive(Clone, Copy, Debug)]
pub struct EstimatorStatistics {
    /// Mean error, and its standard error.
    pub bias: (f64, f64),
    /// Median of the absolute error.
    pub median: f64,
    /// RMS error, and its standard error.
    pub rms: (f64, f64),
    /// Largest absolute error.
    pub worst: f64,
    /// Share of 90 % intervals that hold the truth.
    pub covered: f64,
    /// Trials with an estimate.
    pub count: usize,
}

/// Half of a 90 % interval of a Gaussian [σ]
const NINETY: f64 = 1.6449;

impl EstimatorStatistics {
    /// Of number `k`, as an estimator found it.
    pub fn of(trials: &[Trial], k: usize, pick: impl Fn(&Trial) -> &Estimates) -> Option<Self> {
        let found: Vec<(f64, f64)> = trials.iter().filter_map(|m| pick(m)[k]).collect();
        if found.is_empty() {
            return None;
        }
        let square: Vec<f64> = found.iter().map(|(x, _)| (x - 1.0).powi(2)).collect();
        let mut size: Vec<f64> = square.iter().map(|s| s.sqrt()).collect();
        size.sort_by(f64::total_cmp);
        let (mean_square, square_error) = mean(&square);
        let rms = mean_square.sqrt();
        let covered = found.iter().filter(|(x, std)| (x - 1.0).abs() <= NINETY * std).count();
        Some(Self {
            bias: mean(&found.iter().map(|(x, _)| x - 1.0).collect::<Vec<_>>()),
            median: median(&size),
            // d√s = ds/(2·√s)
            rms: (rms, square_error / (2.0 * rms)),
            worst: size[size.len() - 1],
            covered: covered as f64 / found.len() as f64,
            count: found.len(),
        })
    }
}

/// The mean, and its standard error; that is infinite for a single one.
pub fn mean(x: &[f64]) -> (f64, f64) {
    let n = x.len() as f64;
    let mean = x.iter().sum::<f64>() / n;
    let squares: f64 = x.iter().map(|x| (x - mean).powi(2)).sum();
    (mean, if x.len() < 2 { f64::INFINITY } else { (squares / (n * (n - 1.0))).sqrt() })
}

/// The median of numbers in order; of an even count, the mean of the two in the middle.
pub fn median(sorted: &[f64]) -> f64 {
    let half = sorted.len() / 2;
    if sorted.is_empty() {
        f64::NAN
    } else if sorted.len() % 2 == 1 {
        sorted[half]
    } else {
        0.5 * (sorted[half - 1] + sorted[half])
    }
}

/// By how much the size of the bias of least squares is above that of instrumental variables, over the trials that have
/// both, with its standard error; relative.
pub fn bias_reduction(trials: &[Trial], k: usize) -> Option<(f64, f64)> {
    let both: Vec<(f64, f64)> =
        trials.iter().filter_map(|m| Some((m.least_squares[k]?.0 - 1.0, m.instrumental[k]?.0 - 1.0))).collect();
    if both.is_empty() {
        return None;
    }
    let sign = |of: fn(&(f64, f64)) -> f64| both.iter().map(of).sum::<f64>().signum();
    let (ls, iv) = (sign(|b| b.0), sign(|b| b.1));
    // the same noise is in both: what is uncertain is the difference
    Some(mean(&both.iter().map(|(a, b)| ls * a - iv * b).collect::<Vec<_>>()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identification::prior::NUMBERS;

    fn trials(ls: &[f64], iv: &[f64]) -> Vec<Trial> {
        let all = |x: f64| [Some((x, 0.1)); NUMBERS];
        let of = |(a, b): (&f64, &f64)| Trial {
            first: all(1.0),
            least_squares: all(*a),
            instrumental: all(*b),
            table: all(1.0),
            joint: all(1.0),
            follows: true,
        };
        ls.iter().zip(iv).map(of).collect()
    }

    #[test]
    fn the_statistics_are_those_of_the_errors() {
        let m = trials(&[1.1, 0.8, 1.2, 1.1], &[1.0; 4]);
        let q = EstimatorStatistics::of(&m, 0, |m| &m.least_squares).unwrap();
        // errors 0.1, −0.2, 0.2, 0.1: mean 0.05, Σ(x − mean)² = 0.09, median of sizes 0.15, mean square 0.025
        assert!((q.bias.0 - 0.05).abs() < 1e-12 && (q.bias.1 - (0.09_f64 / 12.0).sqrt()).abs() < 1e-12);
        assert!((q.median - 0.15).abs() < 1e-12 && (q.rms.0 - 0.025_f64.sqrt()).abs() < 1e-12);
        assert!((q.worst - 0.2).abs() < 1e-12);
        // within 0.16449: two of four
        assert_eq!((q.covered, q.count), (0.5, 4));
    }

    #[test]
    fn a_bias_of_the_other_sign_and_half_the_size_counts_as_less() {
        let m = trials(&[0.88, 0.92], &[1.06, 1.04]);
        let (less, error) = bias_reduction(&m, 0).unwrap();
        // sizes 0.10 and 0.05; trial by trial 0.12 − 0.06 and 0.08 − 0.04
        assert!((less - 0.05).abs() < 1e-12 && (error - 0.01).abs() < 1e-12, "{less}, {error}");
    }
}
