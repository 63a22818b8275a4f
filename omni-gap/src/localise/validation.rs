//! # Validation: a model beside what was measured, run by run
//!
//! The plant runs freely from the smoothed start of a run to its end, driven by the recorded input alone, as in the
//! paper's figures 6 to 9; nothing restarts it. [`validate`] compares each signal with its measurement:
//!
//! ```text
//! fit = 100·(1 − ‖y − ŷ‖/‖y − ȳ‖)        per cent, y measured, ŷ simulated, ȳ the mean of y over the run
//! ```
//!
//! 100 is exact, 0 is no better than the mean, and less than 0 is worse than it. Beside it stand errors in SI units and in
//! the sensor's sigma, and, over all runs, the error of free runs restarted every horizon with its noise floor.

mod body_speed;
mod compare;
mod figures;
mod horizon;
mod model;
mod signal;
#[cfg(test)]
mod tests;

use rayon::prelude::*;

use crate::error::{Error, InputKind, Result};
use crate::log::{Run, Session};
use crate::simulate::{AlignedRun, Model, drivable, supply_seen};

use compare::Compared;
use figures::Sums;

pub use super::gap::HORIZONS_S;
pub use compare::Trace;
pub use figures::fit_percent;
pub use model::{GroupError, HorizonFigures, RunFigures, SCHEMA, SignalFigures, SpeedsFrom, Validation, Worst};
pub use signal::Signal;

/// The most runs whose signals are kept for pictures.
pub const MOST_PICTURED: usize = 12;

/// The figures, and the signals behind them.
#[derive(Clone, Debug)]
pub struct Validated {
    /// The figures.
    pub validation: Validation,
    /// Signals over time, of all runs or of the [`MOST_PICTURED`] that fit least.
    pub traces: Vec<RunTraces>,
}

/// The signals of one run.
#[derive(Clone, Debug)]
pub struct RunTraces {
    /// Place of the run in [`Validation::runs`].
    pub run: usize,
    /// Time of each row since the first [s]
    pub t_s: Vec<f64>,
    /// One a signal.
    pub traces: Vec<Trace>,
}

/// Compares the model of the session's robot file with all its runs; `horizons_s` are the lengths between restarts of the
/// horizon curves [s], those longer than every run left out.
///
/// ```
/// use omni_gap::known_effects;
/// use omni_gap::localise::validation::{HORIZONS_S, Signal, validate};
/// use omni_gap::synthesize::{Scenario, synthesize};
///
/// let robot = include_str!("../../robots/feup-3w/robot.toml");
/// let plan = Scenario { uncertain: false, runs: 1, duration: 2.0, rate: 100.0, ..Scenario::default() };
/// let session = synthesize(robot, &plan, &known_effects())?;
///
/// let validation = validate(&session, &HORIZONS_S)?.validation;
/// let forward = validation.runs[0].signal(Signal::V).expect("wheel speeds are logged");
/// assert!(forward.fit_percent.is_some_and(|fit| fit > 80.0));
/// # Ok::<(), omni_gap::Error>(())
/// ```
///
/// # Errors
/// Where a run cannot drive a model, or has nothing to compare it with.
pub fn validate(session: &Session, horizons_s: &[f64]) -> Result<Validated> {
    match session.robot.wheel.len() {
        3 => validated::<3>(session, horizons_s),
        _ => validated::<4>(session, horizons_s),
    }
}

fn validated<const N: usize>(session: &Session, horizons_s: &[f64]) -> Result<Validated> {
    let told = session.runs.iter().map(|run| (run, false)).chain(session.heldout.iter().map(|run| (run, true)));
    let told: Vec<(&Run, bool)> = told.collect();
    let recorded: Vec<AlignedRun<N>> =
        told.iter().map(|(run, _)| drivable(run, &session.robot)).collect::<Result<_>>()?;
    let plant = Model::<N>::nominal(&session.robot, supply_seen(&recorded)).plant();

    let measured: Vec<(RunFigures, Vec<(Signal, Sums)>)> = recorded
        .par_iter()
        .zip(&told)
        .map(|(run, (_, held_out))| {
            let compared = Compared::of(&plant, run);
            let sums = compared.sums();
            (compared.figures(run, *held_out, &sums), sums)
        })
        .collect();
    if let Some(silent) = measured.iter().position(|(_, sums)| sums.is_empty()) {
        return Err(nothing_to_compare(told[silent].0));
    }

    let runs: Vec<RunFigures> = measured.iter().map(|(figures, _)| figures.clone()).collect();
    let refs: Vec<&AlignedRun<N>> = recorded.iter().collect();
    let validation = Validation {
        schema: SCHEMA,
        robot: session.robot.name.clone(),
        session: None,
        worst: model::worst(&runs),
        all_runs: pooled(measured.iter().flat_map(|(_, sums)| sums)),
        horizons: horizon::curves(&plant, &refs, horizons_s),
        notices: session.notices.clone(),
        runs,
    };
    let traces = pictured(&validation.runs)
        .into_par_iter()
        .map(|k| RunTraces { run: k, t_s: recorded[k].t.clone(), traces: Compared::of(&plant, &recorded[k]).traces })
        .collect();
    Ok(Validated { validation, traces })
}

/// The figures of every signal over all runs.
fn pooled<'a>(sums: impl Iterator<Item = &'a (Signal, Sums)>) -> Vec<SignalFigures> {
    let mut all: std::collections::BTreeMap<Signal, Sums> = std::collections::BTreeMap::new();
    for (signal, sums) in sums {
        all.entry(*signal).or_default().add(sums);
    }
    all.iter().map(|(signal, sums)| sums.figures(*signal)).collect()
}

/// The runs that are kept for pictures, in their order: all, or those with the least fit of a body axis.
fn pictured(runs: &[RunFigures]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..runs.len()).collect();
    let least = |run: usize| {
        let axes = Signal::AXES.into_iter().filter_map(|axis| runs[run].signal(axis)?.fit_percent);
        axes.fold(f64::INFINITY, f64::min)
    };
    order.sort_by(|a, b| least(*a).total_cmp(&least(*b)));
    order.truncate(MOST_PICTURED);
    order.sort_unstable();
    order
}

fn nothing_to_compare(run: &Run) -> Error {
    let problem = "nothing was measured in it that the model could be compared with, beside the signal that drives it";
    Error::input(run.place(), problem, "Log what the robot does as well: i, w or the pose, or leave the run out")
        .of_kind(InputKind::Missing)
}
