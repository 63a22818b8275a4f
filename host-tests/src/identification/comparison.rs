//! The estimators of one number side by side.

use model_core::plant::robot::Nominal;
use omni_gap::identify::IDENTIFIED;

use super::prior::NUMBERS;
use super::statistics::{EstimatorStatistics, bias_reduction, median};
use super::study::StudyResult;

/// One number of a case.
#[derive(Clone, Copy, Debug)]
pub struct EstimatorComparison {
    /// Which.
    pub nominal: Nominal,
    /// Experiments 1 and 2, and the motor's.
    pub first: Option<EstimatorStatistics>,
    /// Experiment 3 by least squares.
    pub least_squares: Option<EstimatorStatistics>,
    /// Experiment 3 by instrumental variables.
    pub instrumental: Option<EstimatorStatistics>,
    /// The paper's table.
    pub table: Option<EstimatorStatistics>,
    /// All runs together.
    pub joint: Option<EstimatorStatistics>,
    /// The Cramér–Rao bound, relative.
    pub bound: f64,
    /// |bias| of least squares less that of instrumental variables, and its standard error; relative.
    pub bias_reduction: Option<(f64, f64)>,
}

impl EstimatorComparison {
    /// All numbers of a case.
    pub fn all(studied: &StudyResult) -> Vec<Self> {
        let trials = &studied.trials;
        (0..NUMBERS)
            .map(|k| Self {
                nominal: IDENTIFIED[k],
                first: EstimatorStatistics::of(trials, k, |m| &m.first),
                least_squares: EstimatorStatistics::of(trials, k, |m| &m.least_squares),
                instrumental: EstimatorStatistics::of(trials, k, |m| &m.instrumental),
                table: EstimatorStatistics::of(trials, k, |m| &m.table),
                joint: EstimatorStatistics::of(trials, k, |m| &m.joint),
                bound: studied.bound[k],
                bias_reduction: bias_reduction(trials, k),
            })
            .collect()
    }

    /// RMS error of all runs together over the bound, and its standard error.
    pub fn over_bound(&self) -> Option<(f64, f64)> {
        self.joint.map(|q| (q.rms.0 / self.bound, q.rms.1 / self.bound))
    }

    /// Median error of all runs together over that of the paper's table.
    pub fn ratio(&self) -> Option<f64> {
        Some(self.joint?.median / self.table?.median)
    }

    /// |bias| of instrumental variables over that of least squares, where the latter is plain: above this many of its
    /// standard errors.
    pub fn bias_left(&self, plain: f64) -> Option<f64> {
        let (ls, iv) = (self.least_squares?.bias, self.instrumental?.bias);
        (ls.0.abs() > plain * ls.1).then(|| iv.0.abs() / ls.0.abs())
    }
}

/// The median of the ratios of a case.
pub fn median_ratio(numbers: &[EstimatorComparison]) -> f64 {
    let mut ratios: Vec<f64> = numbers.iter().filter_map(EstimatorComparison::ratio).collect();
    ratios.sort_by(f64::total_cmp);
    median(&ratios)
}
