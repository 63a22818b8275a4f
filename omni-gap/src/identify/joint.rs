//! All runs together: the better estimator.
//!
//! Every run is predicted from a start of its own to its end by one model, and the numbers of that model are those that
//! predict best what was measured, each sensor weighted by its noise: a prediction-error fit, for Gaussian noise the
//! maximum of the likelihood. It goes in steps, each beginning where the last one ended:
//!
//! 1. windows of half a second, which converge from far away;
//! 2. the noise, from what those leave over: its size, and how long it remembers itself;
//! 3. whole runs as windows: nothing is given away to starts;
//! 4. the noise once more, and the fit with it.
//!
//! Where the model cannot follow whole runs, something is missing in it; then the short windows' numbers are kept, with
//! an uncertainty that holds under errors that go on through a window.

use model_core::plant::robot::Nominal;
use nalgebra::DMatrix;

use super::driven::by_input;
use super::fit::{Fit, FitOptions, fit};
use super::free::Free;
use super::identifiability::{Identifiability, KNOWN, TradeOff, identifiability_of, trade_offs};
use super::information::invert;
use super::linear::linearise;
use super::noise::{Noise, noise_of};
use super::prior::Prior;
use super::shoot::{Shots, WINDOW_S, Windows};
use crate::log::RobotFile;
use crate::simulate::{AlignedRun, Model, NominalKey, SignalGroup, Slot};

/// What is identified: R, K_t = K_v, J, and the friction of the body. Mass and geometry are weighed and measured.
pub const IDENTIFIED: [Nominal; 9] = [
    Nominal::Resistance,
    Nominal::TorqueConstant,
    Nominal::Inertia,
    Nominal::ViscousV,
    Nominal::ViscousVn,
    Nominal::ViscousW,
    Nominal::CoulombV,
    Nominal::CoulombVn,
    Nominal::CoulombW,
];

/// What is taken as the robot file states it, with its stated uncertainty.
pub const GIVEN: [Nominal; 3] = [Nominal::Mass, Nominal::WheelRadius, Nominal::CenterDistance];

/// Rounds of the fit to short windows, which need only come near, and of those to whole runs, at the most.
const ROUNDS: (usize, usize) = (6, 25);
/// A factor on a nominal value is looked for between these.
const WITHIN: (f64, f64) = (0.01, 50.0);
/// Σ error² per number up to which whole runs count as predicted to within their noise.
const FOLLOWS: f64 = 1.15;

/// A signal whose standard deviation is above this many times its sensor's is one of a robot that moves.
const MOVING: f64 = 2.0;

/// What became of one number.
#[derive(Clone, Debug)]
pub struct Identified {
    /// Which.
    pub nominal: Nominal,
    /// Factor on the robot file's value.
    pub factor: f64,
    /// One sigma of it, from the noise, and from an input that was measured instead of commanded.
    pub std: f64,
    /// One sigma of it, from what is stated of mass and geometry.
    pub std_given: f64,
    /// What the runs say of it.
    pub word: Identifiability,
}

/// A fit to all runs together.
#[derive(Clone, Debug)]
pub struct Joint<const N: usize> {
    /// The model with the numbers found.
    pub model: Model<N>,
    /// The numbers, in the order of [`IDENTIFIED`].
    pub numbers: Vec<Identified>,
    /// Covariance of their factors, from the noise.
    pub covariance: DMatrix<f64>,
    /// Directions in which numbers can move together without being noticed.
    pub trade_offs: Vec<TradeOff>,
    /// The noise that was found, over what the robot file states.
    pub noise: Noise,
    /// True if whole runs are predicted to within that noise.
    pub follows: bool,
    /// RMS error of the whole runs over that noise [1]
    pub misfit: f64,
    /// How many measured numbers were compared.
    pub samples: usize,
}

/// Why runs identify nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refused {
    /// There is no run that can drive a model, or none with a measurement to compare.
    NothingMeasured,
    /// The robot stands still, or moves so little that no number shows above the noise.
    NothingMoves,
}

impl<const N: usize> Joint<N> {
    /// What was found of a number.
    pub fn of(&self, nominal: Nominal) -> Option<&Identified> {
        self.numbers.iter().find(|n| n.nominal == nominal)
    }
}

/// Fits what [`IDENTIFIED`] lists to all runs. `model` is where to begin, `file` what is stated of the rest.
///
/// # Errors
/// Where the runs cannot tell a single number.
pub fn joint<const N: usize>(model: &Model<N>, file: &RobotFile, runs: &[&AlignedRun<N>]) -> Result<Joint<N>, Refused> {
    let measured = |run: &&AlignedRun<N>| run.has.iter().any(|has| *has != 0);
    let runs: Vec<&AlignedRun<N>> = runs.iter().copied().filter(measured).collect();
    if runs.is_empty() {
        return Err(Refused::NothingMeasured);
    }
    if !runs.iter().any(|run| moves(run)) {
        return Err(Refused::NothingMoves);
    }
    let free = IDENTIFIED.map(|p| Free { slot: Slot::Nominal(p), within: WITHIN });
    let prior = Prior { rows: Vec::new() };
    let how = FitOptions { free: &free, prior: &prior, dispersion: 1.0, rounds: ROUNDS.1, by_window: 0.0 };
    let short: Vec<Windows> = runs.iter().map(|run| Windows::new(run, WINDOW_S)).collect();
    let whole: Vec<Windows> = runs.iter().map(|run| Windows::whole(run)).collect();

    let shots = Shots { runs: &runs, windows: &short };
    let near = fit(model.clone(), shots, None, FitOptions { rounds: ROUNDS.0, ..how });
    let mut noise = noise_of(&near, shots);
    let with_noise: Vec<AlignedRun<N>> = runs.iter().map(|run| noise.applied(run)).collect();
    let mut noisy: Vec<&AlignedRun<N>> = with_noise.iter().collect();
    let mut best = fit(near.model.clone(), Shots { runs: &noisy, windows: &whole }, None, how);
    let misfit = best.cost / best.samples.max(1) as f64;
    let follows = misfit < FOLLOWS;
    let again;
    let windows = if follows { &whole } else { &short };
    if follows {
        noise = noise_of(&best, Shots { runs: &runs, windows });
        again = runs.iter().map(|run| noise.applied(run)).collect::<Vec<_>>();
        noisy = again.iter().collect();
        // it is there already but for the weights
        let near = FitOptions { rounds: ROUNDS.0, ..how };
        best = fit(best.model, Shots { runs: &noisy, windows }, Some(best.starts), near);
    } else {
        best = fit(near.model, Shots { runs: &noisy, windows }, Some(near.starts), how);
    }
    judged(best, Shots { runs: &noisy, windows }, file, noise, follows, misfit.sqrt())
}

/// True if any wheel speed or pose of a run varies by more than its noise; currents can flow in a robot that is held. A
/// run that shows neither is not judged.
fn moves<const N: usize>(run: &AlignedRun<N>) -> bool {
    if !run.has_group(SignalGroup::WheelSpeed) && !run.has_group(SignalGroup::Pose) {
        return true;
    }
    let channels = AlignedRun::<N>::channels();
    (channels.wheel_speed(0)..=channels.heading()).any(|channel| {
        let told = (0..run.rows()).filter(|row| run.saw(*row, channel)).map(|row| run.measured[row][channel]);
        let (n, sum) = told.clone().fold((0.0, 0.0), |(n, sum), x| (n + 1.0, sum + x));
        let square: f64 = told.map(|x| (x - sum / n).powi(2)).sum();
        n > 1.0 && square / (n - 1.0) > (MOVING * run.sigma[channel]).powi(2)
    })
}

/// Uncertainties and words of a fit.
fn judged<const N: usize>(
    best: Fit<N>,
    shots: Shots<'_, N>,
    file: &RobotFile,
    noise: Noise,
    follows: bool,
    misfit: f64,
) -> Result<Joint<N>, Refused> {
    let n = IDENTIFIED.len();
    let slots: Vec<Slot> = IDENTIFIED.iter().chain(&GIVEN).map(|p| Slot::Nominal(*p)).collect();
    let reduced = linearise(&best.model, shots, &best.starts, &slots, false).reduced();
    // per relative change of each number
    let size: Vec<f64> = slots.iter().map(|slot| best.model.get(*slot)).collect();
    let relative = DMatrix::from_fn(slots.len(), slots.len(), |a, b| reduced.hess[(a, b)] * size[a] * size[b]);
    let information = relative.view((0, 0), (n, n)).into_owned();
    let mut words: Vec<Identifiability> =
        (0..n).map(|k| identifiability_of(&information, k, best.at_bound(&best.free[k]))).collect();
    if words.iter().all(|word| *word == Identifiability::NotSeen) {
        return Err(Refused::NothingMoves);
    }
    // a number that is not seen takes no part: what is not known of it is no uncertainty of the others
    let seen: Vec<usize> = (0..n).filter(|k| words[*k] != Identifiability::NotSeen).collect();
    let pick = |m: &DMatrix<f64>| DMatrix::from_fn(seen.len(), seen.len(), |a, b| m[(seen[a], seen[b])]);
    let inverse = invert(&pick(&information));
    let covariance = if follows {
        inverse.clone()
    } else {
        let factors = seen.iter().map(|k| size[*k]).collect::<Vec<_>>();
        let meat = pick(&reduced.meat.view((0, 0), (n, n)).into_owned());
        let meat = DMatrix::from_fn(seen.len(), seen.len(), |a, b| meat[(a, b)] * factors[a] * factors[b]);
        let robust = &inverse * meat * &inverse;
        // no surer than white noise would be
        let by = |k: usize| (inverse[(k, k)] / robust[(k, k)]).max(1.0).sqrt();
        DMatrix::from_fn(seen.len(), seen.len(), |a, b| robust[(a, b)] * by(a) * by(b))
    };
    let given = by_given(&relative, &inverse, &seen, file);
    let input = by_input(&best.model, shots, &best.starts, &slots[..n], &inverse, &seen);
    let mut covariance = covariance;
    for (at, input) in input.iter().enumerate() {
        covariance[(at, at)] += input * input;
        if words[seen[at]] == Identifiability::Identified && covariance[(at, at)].sqrt() > KNOWN {
            words[seen[at]] = Identifiability::Weak;
        }
    }
    let numbers = (0..n)
        .map(|k| {
            let at = seen.iter().position(|s| *s == k);
            let std = at.map_or(f64::INFINITY, |at| covariance[(at, at)].max(0.0).sqrt() * size[k]);
            let std_given = at.map_or(0.0, |at| given[at] * size[k]);
            Identified { nominal: IDENTIFIED[k], factor: size[k], std, std_given, word: words[k] }
        })
        .collect();
    let all = DMatrix::from_fn(n, n, |a, b| {
        let at = |k: usize| seen.iter().position(|s| *s == k);
        at(a)
            .zip(at(b))
            .map_or(if a == b { f64::INFINITY } else { 0.0 }, |(p, q)| covariance[(p, q)] * size[a] * size[b])
    });
    let members: Vec<Nominal> = seen.iter().map(|k| IDENTIFIED[*k]).collect();
    let words: Vec<Identifiability> = seen.iter().map(|k| words[*k]).collect();
    let trade_offs = trade_offs(&inverse, &members, &words);
    let samples = best.samples;
    Ok(Joint { model: best.model, numbers, covariance: all, trade_offs, noise, follows, misfit, samples })
}

/// The relative uncertainty that each number takes over from what is stated of mass and geometry.
///
/// ```text
/// H_pp·Δp = −H_pq·Δq        p: identified, q: given
/// ```
fn by_given(relative: &DMatrix<f64>, inverse: &DMatrix<f64>, seen: &[usize], file: &RobotFile) -> Vec<f64> {
    let mut square = vec![0.0; seen.len()];
    for (q, nominal) in GIVEN.iter().enumerate() {
        let key = NominalKey::alone(*nominal).map(|key| key.key);
        let stated = key.and_then(|key| file.relative_uncertainty(key)).unwrap_or(0.0);
        let column = DMatrix::from_fn(seen.len(), 1, |a, _| relative[(seen[a], IDENTIFIED.len() + q)]);
        let moved = inverse * column;
        for (sum, moved) in square.iter_mut().zip(moved.iter()) {
            *sum += (moved * stated).powi(2);
        }
    }
    square.into_iter().map(f64::sqrt).collect()
}
