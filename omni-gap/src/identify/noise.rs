//! What noise the recordings have, estimated from what a fit leaves over.
//!
//! ```text
//! r = P·e,  P = 1 − J_z·H_zz⁻¹·J_zᵀ            what the windows' starts leave of the errors
//! E Σ r_k²       = s²·Σ (P·R·Pᵀ)_kk            R_kl = exp(−|t_k − t_l|/τ) within a channel
//! E Σ r_k·r_{k+1} = s²·Σ (P·R·Pᵀ)_k,k+1        over consecutive samples of a channel in a window
//! ```
//!
//! Two sums a group of channels, two unknowns: the ratio gives τ, then the first line gives s. P is the fit's own, so
//! that neither the freedom that the starts take nor their pull on neighbouring errors biases the result; the few
//! parameters that all windows share take too little to count. The noise of the other groups, which the starts carry
//! over, is taken off at its own estimate, in turns.

use std::borrow::Cow;

use nalgebra::{SMatrix, SVector};
use rayon::prelude::*;

use super::fit::Fit;
use super::linear::linearise;
use super::shoot::Shots;
use super::window::{START, WindowLinear};
use crate::simulate::{AlignedRun, Channels, SignalGroup};

/// How many sensors have a noise of their own, groups of channels that share one: currents, wheel speeds, position, heading, gyro, battery.
pub const SENSORS: usize = 6;
/// Times that the groups are estimated in turn.
const TURNS: usize = 3;
/// A lag-one autocorrelation counts if it is above that of white noise by this many of its standard errors 1/√n.
const SIGNIFICANT: f64 = 3.0;
/// The longest correlation time that a window can tell from a wrong start, as a share of its length.
const LONGEST: f64 = 0.25;
/// The shortest correlation time that is looked for, as a share of the sampling interval.
const SHORTEST: f64 = 0.1;
/// Windows that noise is estimated from, at the least.
const LEAST_WINDOWS: usize = 8;
/// Halvings of the interval of ln τ.
const HALVINGS: usize = 14;
/// No sensor is believed to be this much better than its file says.
const LEAST_SCALE: f64 = 1e-3;

/// The noise of each group of channels: currents, wheel speeds, position (x and y), heading, gyro, battery.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// Its standard deviation over the run's sigma; one where nothing was measured.
    pub scale: [f64; SENSORS],
    /// How long it remembers itself [s]; zero where it cannot be told from white.
    pub correlation_time: [f64; SENSORS],
}

/// The group of a channel of a robot with `wheels` wheels.
fn group(wheels: usize, channel: usize) -> usize {
    let channels = Channels { wheels };
    match channels.group(channel) {
        SignalGroup::Current => 0,
        SignalGroup::WheelSpeed => 1,
        SignalGroup::Pose if channel != channels.heading() => 2,
        SignalGroup::Pose => 3,
        SignalGroup::Gyro => 4,
        SignalGroup::Battery => 5,
    }
}

impl Noise {
    /// As the runs have it.
    pub const AS_STATED: Self = Self { scale: [1.0; SENSORS], correlation_time: [0.0; SENSORS] };

    /// The run with this noise stated in place of its own.
    pub fn applied<const N: usize>(&self, run: &AlignedRun<N>) -> AlignedRun<N> {
        let mut run = run.clone();
        for channel in 0..AlignedRun::<N>::channels().count() {
            let group = group(N, channel);
            run.sigma[channel] *= self.scale[group];
            run.correlation_time[channel] = self.correlation_time[group];
        }
        run
    }
}

/// Estimates the noise from what a fit leaves over of the runs that it was made to. Scales are over the runs' sigma; what
/// the runs say of correlation is not looked at.
pub fn noise_of<const N: usize>(fit: &Fit<N>, shots: Shots<'_, N>) -> Noise {
    LeftOver::of(fit, shots).noise()
}

/// What a fit leaves over of the runs that it was made to, window by window.
#[derive(Debug)]
pub struct LeftOver {
    windows: Vec<Left>,
    /// The longest correlation time that they can tell [s]
    longest: f64,
}

impl LeftOver {
    /// Of these runs.
    pub fn of<const N: usize>(fit: &Fit<N>, shots: Shots<'_, N>) -> Self {
        let runs: Vec<Cow<'_, AlignedRun<N>>> = shots.runs.iter().map(|run| white(run)).collect();
        let runs: Vec<&AlignedRun<N>> = runs.iter().map(AsRef::as_ref).collect();
        let shots = Shots { runs: &runs, windows: shots.windows };
        let linear = linearise(&fit.model, shots, &fit.starts, &[], true);
        let (mut lefts, mut lengths) = (Vec::new(), 0.0);
        for (k, windows) in linear.windows.iter().enumerate() {
            for window in windows.iter().filter(|w| !w.places.is_empty()) {
                lefts.push(Left::of::<N>(window, &runs[k].t));
            }
            for rows in (0..shots.windows[k].len()).map(|w| shots.windows[k].rows(w)) {
                lengths += runs[k].t[rows.end - 1] - runs[k].t[rows.start];
            }
        }
        let longest = LONGEST * lengths / lefts.len().max(1) as f64;
        Self { windows: lefts, longest }
    }

    /// The noise of all windows.
    pub fn noise(&self) -> Noise {
        solve(&self.windows.iter().collect::<Vec<_>>(), self.longest)
    }

    /// The noise of that share of the windows in which least is left over: noise is the same everywhere, and what a model lacks is
    /// not.
    pub fn noise_where_quiet(&self, share: f64) -> Noise {
        solve(&quietest(self.windows.iter().collect(), share), self.longest)
    }
}

/// The share of the windows in which the group that stands out most over what it leaves in its own quietest share does so least.
fn quietest(mut lefts: Vec<&Left>, share: f64) -> Vec<&Left> {
    let keep = ((share * lefts.len() as f64).ceil() as usize).max(LEAST_WINDOWS);
    if keep >= lefts.len() {
        return lefts;
    }
    let per_number = |left: &Left, g: usize| left.seen[g][0] / left.count[g][0].max(1.0);
    let usual: [f64; SENSORS] = std::array::from_fn(|g| {
        let mut all: Vec<f64> =
            lefts.iter().filter(|left| left.count[g][0] > 0.0).map(|left| per_number(left, g)).collect();
        let at = (share * all.len() as f64) as usize;
        if all.is_empty() { 1.0 } else { *all.select_nth_unstable_by(at, f64::total_cmp).1 }
    });
    let loud =
        |left: &Left| (0..SENSORS).map(|g| per_number(left, g) / usual[g].max(f64::MIN_POSITIVE)).fold(0.0, f64::max);
    lefts.sort_by(|a, b| loud(a).total_cmp(&loud(b)));
    lefts.truncate(keep);
    lefts
}

/// The run without what it says of correlation.
fn white<const N: usize>(run: &AlignedRun<N>) -> Cow<'_, AlignedRun<N>> {
    let is_white = run.correlation_time.iter().all(|tau| *tau == 0.0);
    if is_white { Cow::Borrowed(run) } else { Cow::Owned(Noise::AS_STATED.applied(run)) }
}

type Vec6 = SVector<f64, START>;
type Mat6 = SMatrix<f64, START, START>;

/// A channel in a window.
#[derive(Debug)]
struct Track {
    group: usize,
    /// Times of its samples [s]
    t: Vec<f64>,
    /// The columns of A = H_zz⁻¹·J_zᵀ.
    a: Vec<Vec6>,
    /// The rows of J_z.
    j: Vec<Vec6>,
}

/// What a window's start leaves over.
#[derive(Debug)]
struct Left {
    tracks: Vec<Track>,
    /// Σ r_k² and Σ r_k·r_{k+1} of each group [σ²]
    seen: [[f64; 2]; SENSORS],
    /// Σ j_k·j_kᵀ and Σ j_k·j_{k+1}ᵀ of each group
    outer: [[Mat6; 2]; SENSORS],
    /// How many numbers and how many neighbours each group has.
    count: [[f64; 2]; SENSORS],
}

/// What noise of one sigma in a group makes of the sums above, and what it does to the start: A·R·Aᵀ.
#[derive(Clone, Copy)]
struct Made {
    sums: [f64; 2],
    start: Mat6,
}

impl Left {
    fn of<const N: usize>(window: &WindowLinear, t: &[f64]) -> Self {
        let block = super::block::Block::of_equations(&window.jacobian, &window.error);
        let (_, step) = block.eliminate();
        let inverse =
            block.start().cholesky().map_or_else(Mat6::zeros, |c| Mat6::from_iterator(c.inverse().iter().copied()));
        let mut left = Self {
            tracks: Vec::new(),
            seen: [[0.0; 2]; SENSORS],
            outer: [[Mat6::zeros(); 2]; SENSORS],
            count: [[0.0; 2]; SENSORS],
        };
        for channel in 0..AlignedRun::<N>::channels().count() {
            let g = group(N, channel);
            let mut track = Track { group: g, t: Vec::new(), a: Vec::new(), j: Vec::new() };
            let mut before: Option<(f64, Vec6)> = None;
            for (at, (row, _)) in window.places.iter().enumerate().filter(|(_, p)| usize::from(p.1) == channel) {
                let j = Vec6::from_fn(|k, _| window.jacobian[(at, k)]);
                // r = e − J_z·H_zz⁻¹·J_zᵀ·e
                let r = window.error[at] - (0..START).map(|k| j[k] * step[k]).sum::<f64>();
                left.seen[g][0] += r * r;
                left.outer[g][0] += j * j.transpose();
                left.count[g][0] += 1.0;
                if let Some((r0, j0)) = before {
                    left.seen[g][1] += r0 * r;
                    left.outer[g][1] += j0 * j.transpose();
                    left.count[g][1] += 1.0;
                }
                before = Some((r, j));
                track.t.push(t[*row as usize]);
                track.a.push(inverse * j);
                track.j.push(j);
            }
            left.tracks.push(track);
        }
        left
    }

    /// What noise of a group with this correlation time makes.
    fn made(&self, group: usize, tau: f64) -> Made {
        let mut made = Made { sums: [0.0; 2], start: Mat6::zeros() };
        for track in self.tracks.iter().filter(|track| track.group == group) {
            let rho = |k: usize| if tau > 0.0 { (-(track.t[k + 1] - track.t[k]) / tau).exp() } else { 0.0 };
            let rhos: Vec<f64> = (1..track.t.len()).map(|k| rho(k - 1)).collect();
            // (A·R)_k = Σ_l a_l·exp(−|t_k − t_l|/τ): a sweep forward for l ≤ k, one backward for l > k
            let mut swept = track.a.clone();
            for k in 1..swept.len() {
                let carried = swept[k - 1] * rhos[k - 1];
                swept[k] += carried;
            }
            let mut after = Vec6::zeros();
            for k in (0..swept.len()).rev() {
                swept[k] += after;
                after = (after + track.a[k]) * if k > 0 { rhos[k - 1] } else { 0.0 };
            }
            for k in 0..swept.len() {
                made.start += swept[k] * track.a[k].transpose();
                // (P·R·Pᵀ)_kl = R_kl − j_k·(A·R)_l − (A·R)_k·j_l + j_k·(A·R·Aᵀ)·j_l
                made.sums[0] += 1.0 - 2.0 * track.j[k].dot(&swept[k]);
                if k > 0 {
                    made.sums[1] += rhos[k - 1] - track.j[k - 1].dot(&swept[k]) - swept[k - 1].dot(&track.j[k]);
                }
            }
        }
        for (sum, outer) in made.sums.iter_mut().zip(&self.outer[group]) {
            *sum += made.start.dot(outer);
        }
        made
    }
}

/// What one group makes, window by window.
fn made_by(lefts: &[&Left], group: usize, tau: f64) -> Vec<Made> {
    lefts.par_iter().map(|left| left.made(group, tau)).collect()
}

fn ratio(made: &[Made]) -> f64 {
    let sum = |which: usize| made.iter().map(|m| m.sums[which]).sum::<f64>();
    sum(1) / sum(0)
}

/// The groups in turn, each with what the others make taken off.
fn solve(lefts: &[&Left], longest: f64) -> Noise {
    let mut noise = Noise::AS_STATED;
    let mut made: [Vec<Made>; SENSORS] = std::array::from_fn(|g| made_by(lefts, g, 0.0));
    let white = made.clone();
    let total = |of: &dyn Fn(&Left) -> f64| lefts.iter().map(|left| of(left)).sum::<f64>();
    for _ in 0..TURNS {
        for g in 0..SENSORS {
            let [numbers, pairs] = [0, 1].map(|which| total(&|left| left.count[g][which]));
            if numbers == 0.0 {
                continue;
            }
            // what the other groups' noise does to the starts shows in this one
            let [square, lagged] = [0, 1].map(|which| {
                let others = (0..SENSORS).filter(|h| *h != g).map(|h| {
                    let shown = made[h].iter().zip(lefts).map(|(m, left)| m.start.dot(&left.outer[g][which]));
                    noise.scale[h].powi(2) * shown.sum::<f64>()
                });
                total(&|left| left.seen[g][which]) - others.sum::<f64>()
            });
            let (found, alone) = (lagged / square, ratio(&white[g]));
            let correlated = square > 0.0 && pairs > 0.0 && found - alone > SIGNIFICANT / pairs.sqrt();
            let tau = if correlated { time_of(lefts, g, found, longest) } else { 0.0 };
            if tau != noise.correlation_time[g] {
                made[g] = made_by(lefts, g, tau);
            }
            noise.correlation_time[g] = tau;
            let freedom: f64 = made[g].iter().map(|m| m.sums[0]).sum();
            noise.scale[g] = (square / freedom).max(0.0).sqrt().max(LEAST_SCALE);
        }
    }
    noise
}

/// The correlation time at which a group makes this ratio of the two sums [s].
fn time_of(lefts: &[&Left], group: usize, wanted: f64, longest: f64) -> f64 {
    let tracks =
        || lefts.iter().flat_map(|left| &left.tracks).filter(|track| track.group == group && track.t.len() > 1);
    let (time, intervals) = tracks().fold((0.0, 0.0), |(time, n), track| {
        let last = track.t.len() - 1;
        (time + track.t[last] - track.t[0], n + last as f64)
    });
    let (mut low, mut high) = ((SHORTEST * time / intervals).min(longest), longest);
    for _ in 0..HALVINGS {
        let middle = (low * high).sqrt();
        if ratio(&made_by(lefts, group, middle)) < wanted { low = middle } else { high = middle }
    }
    (low * high).sqrt()
}

#[cfg(test)]
#[path = "noise_tests.rs"]
mod tests;
