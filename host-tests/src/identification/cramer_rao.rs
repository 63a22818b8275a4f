//! What no unbiased estimator can go below.

use omni_gap::identify::{IDENTIFIED, Shots, Windows, linearise};
use omni_gap::simulate::{AlignedRun, Model, Slot};

use super::joint_fit::freely_driven;
use super::prior::NUMBERS;

/// The Cramér–Rao bound of each number, relative: the least standard deviation that the inverse of Fisher's information
/// at the truth allows, for Gaussian noise of the stated sizes, each run's start unknown. The camera's errors are alike
/// over `camera_correlation` [s], white where that is zero.
///
/// # Panics
/// Where the runs do not tell all numbers.
pub fn cramer_rao_bound<const N: usize>(
    truth: &Model<N>,
    runs: &[AlignedRun<N>],
    camera_correlation: f64,
) -> [f64; NUMBERS] {
    let mut runs: Vec<AlignedRun<N>> = freely_driven(runs).into_iter().cloned().collect();
    for run in &mut runs {
        run.correlation_time[2 * N..2 * N + 3].fill(camera_correlation);
    }
    let runs: Vec<&AlignedRun<N>> = runs.iter().collect();
    let windows: Vec<Windows> = runs.iter().map(|run| Windows::whole(run)).collect();
    let at_rest = vec![vec![[0.0; 6]]; runs.len()];
    let slots = IDENTIFIED.map(Slot::Nominal);
    let shots = Shots { runs: &runs, windows: &windows };
    let information = linearise(truth, shots, &at_rest, &slots, false).reduced().hess;
    let covariance = information.try_inverse().expect("the experiments tell all numbers");
    std::array::from_fn(|k| covariance[(k, k)].sqrt())
}
