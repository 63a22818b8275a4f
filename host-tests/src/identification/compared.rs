//! The estimators of one number side by side.

use model_core::plant::robot::Nominal;
use omni_gap::identify::IDENTIFIED;

use super::believed::NUMBERS;
use super::quality::{Quality, bias_taken_off, middle};
use super::study::Studied;

/// One number of a case.
#[derive(Clone, Copy, Debug)]
pub struct Compared {
    /// Which.
    pub nominal: Nominal,
    /// Experiments 1 and 2, and the motor's.
    pub first: Option<Quality>,
    /// Experiment 3 by least squares.
    pub least_squares: Option<Quality>,
    /// Experiment 3 by instrumental variables.
    pub instrumental: Option<Quality>,
    /// The paper's table.
    pub table: Option<Quality>,
    /// All runs together.
    pub joint: Option<Quality>,
    /// The Cramér–Rao bound, relative.
    pub bound: f64,
    /// |bias| of least squares less that of instrumental variables, and its standard error; relative.
    pub bias_taken_off: Option<(f64, f64)>,
}

impl Compared {
    /// All numbers of a case.
    pub fn all(studied: &Studied) -> Vec<Self> {
        let mornings = &studied.mornings;
        (0..NUMBERS)
            .map(|k| Self {
                nominal: IDENTIFIED[k],
                first: Quality::of(mornings, k, |m| &m.first),
                least_squares: Quality::of(mornings, k, |m| &m.least_squares),
                instrumental: Quality::of(mornings, k, |m| &m.instrumental),
                table: Quality::of(mornings, k, |m| &m.table),
                joint: Quality::of(mornings, k, |m| &m.joint),
                bound: studied.bound[k],
                bias_taken_off: bias_taken_off(mornings, k),
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
pub fn median_ratio(numbers: &[Compared]) -> f64 {
    let mut ratios: Vec<f64> = numbers.iter().filter_map(Compared::ratio).collect();
    ratios.sort_by(f64::total_cmp);
    middle(&ratios)
}
