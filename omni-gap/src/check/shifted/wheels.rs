//! How well the command of a shifted time explains how the wheels speed up.
//!
//! ```text
//! Δw_j/Δt = Σ_k a_jk·ū_k(t − d) + Σ_k b_jk·w_k(t) + Σ_k c_jk·sign w_k(t)
//! ```
//!
//! a, b and c are whatever fits: the body couples all wheels, and no number of the robot file is asked.

use nalgebra::DMatrix;

use super::integral::{Between, means};
use super::shifts::{FEWEST_WINDOWS, LeftByShift, MOST_WINDOWS, shifts};
use crate::check::body::{MOST_CHANNELS, row_of};
use crate::log::Run;

/// Length of a window [s]; two rows at the least.
const WINDOW_S: f64 = 0.06;
/// A share of their mean that is added to the squares of what explains, lest what never varies divide by nothing [1].
const RIDGE: f64 = 1e-6;

/// A window: from when to when [s], the wheels' speeds at its start [rad/s], and how they speed up in it [rad/s²].
struct Window {
    from_s: f64,
    to_s: f64,
    speed: [f64; MOST_CHANNELS],
    speeds_up: [f64; MOST_CHANNELS],
}

/// The share of how the wheels speed up that the command leaves, of what speeds alone leave, by its shift.
pub(super) fn left_by_shift(run: &Run) -> Option<LeftByShift> {
    let speed = run.w.as_ref().filter(|group| !group.unsigned)?;
    let drive = run.u.as_ref().or(run.wset.as_ref()).filter(|group| !group.unsigned)?;
    let shifts = shifts(run.duration_s());
    let windows = windows(run, *shifts.last()?);
    let n = speed.channels.len();
    if windows.len() < FEWEST_WINDOWS {
        return None;
    }
    let spans: Vec<(f64, f64)> = windows.iter().map(|window| (window.from_s, window.to_s)).collect();
    let commands: Vec<Vec<Vec<f64>>> =
        drive.channels.iter().map(|channel| means(run, channel, Between::Held, &spans, &shifts)).collect();
    let answers = DMatrix::from_fn(windows.len(), n, |k, j| windows[k].speeds_up[j]);
    let speeds = DMatrix::from_fn(windows.len(), 2 * n, |k, c| {
        let w = windows[k].speed[c % n];
        if c < n { w } else { w.signum() }
    });
    let without = left(&speeds, &answers)?;
    let with = |(at, shift): (usize, f64)| {
        let explains =
            DMatrix::from_fn(
                windows.len(),
                n + 2 * n,
                |k, c| {
                    if c < n { commands[c][at][k] } else { speeds[(k, c - n)] }
                },
            );
        Some((shift, left(&explains, &answers)? / without))
    };
    (without > 0.0).then(|| shifts.into_iter().enumerate().filter_map(with).collect())
}

/// Windows spread over a run, so far from its ends that every shift stays within it.
fn windows(run: &Run, farthest_s: f64) -> Vec<Window> {
    let (Some(speed), Some(first), Some(last)) = (&run.w, run.t_s.first(), run.t_s.last()) else { return Vec::new() };
    let length_s = WINDOW_S.max(2.0 * run.median_step_s());
    let every = (run.rows() / MOST_WINDOWS).max(1);
    let of = |row: usize| {
        let from_s = run.t_s[row];
        let end = run.t_s.partition_point(|t| *t < from_s + length_s);
        let to_s = *run.t_s.get(end)?;
        let sound = from_s - farthest_s >= *first && to_s + farthest_s <= *last && to_s - from_s < 3.0 * length_s;
        let (before, after) = row_of(speed, row).zip(row_of(speed, end)).filter(|_| sound)?;
        let speeds_up = std::array::from_fn(|j| (after[j] - before[j]) / (to_s - from_s));
        Some(Window { from_s, to_s, speed: before, speeds_up })
    };
    (0..run.rows()).step_by(every).filter_map(of).collect()
}

/// Σ error² of the answers by least squares.
fn left(explains: &DMatrix<f64>, answers: &DMatrix<f64>) -> Option<f64> {
    let mut squares = explains.tr_mul(explains);
    let ridge = RIDGE * squares.trace() / squares.ncols() as f64;
    for k in 0..squares.ncols() {
        squares[(k, k)] += ridge.max(f64::MIN_POSITIVE);
    }
    let products = explains.tr_mul(answers);
    let told = squares.cholesky()?.solve(&products);
    Some((answers - explains * told).norm_squared())
}
