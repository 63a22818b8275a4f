//! One session diagnosed, and the answer held to the truth.

use std::path::Path;
use std::time::Instant;

use omni_gap::engine::evidence::LaidOut;
use omni_gap::engine::{Engine, Evidence, Knobs, Stepwise};
use omni_gap::error::Result;
use omni_gap::localise::{floor, measure};
use omni_gap::log::RobotFile;
use omni_gap::report::{Estimate, Report, Verdict};
use omni_gap::simulate::{AlignedRun, Model, NOMINAL_KEYS, NominalKey};
use omni_gap::{Diagnosis, Options, known_effects};

use super::sessions::{BenchmarkCase, HiddenCause};

/// The engines that stand in the table.
pub const ENGINES: [&dyn Engine; 1] = [&Stepwise];

/// A gap smaller than this is not divided by [σ], here as in a report.
pub fn too_small() -> f64 {
    Knobs::default().measure.smallest_room_sigma
}

/// Nor is one that is a smaller share than this of what a model that knows everything leaves [1]: robots that slip part by
/// chance, and a tenth more or less of that is no cause's doing.
pub const TOO_SMALL_A_SHARE: f64 = 0.1;

/// True if what lies between two errors [σ] can be divided by.
fn worth_dividing_by(before: f64, after: f64) -> bool {
    before - after >= too_small().max(TOO_SMALL_A_SHARE * after)
}

/// How good the answer is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Judgement {
    /// The hidden cause comes first; where nothing is hidden, the answer is `no_gap`.
    First,
    /// The hidden cause is named as one that the data cannot tell from the first.
    Named,
    /// Neither.
    Wrong,
}

/// Errors of the free runs of the held-out runs [σ].
#[derive(Clone, Copy, Debug)]
pub struct Oracle {
    /// With the session's own robot file.
    pub before: f64,
    /// With the true model.
    pub after: f64,
    /// With the true model, on runs that it made itself with the sensors' noise.
    pub floor: f64,
}

/// A number of the hidden cause, against the truth.
#[derive(Clone, Debug)]
pub struct EstimatedNumber {
    /// Its key.
    pub key: String,
    /// The true value, SI.
    pub truth: f64,
    /// What the diagnosis says of it; none where it does not speak of it.
    pub estimate: Option<Estimate>,
}

impl EstimatedNumber {
    /// How many of its own standard deviations the estimate is off.
    pub fn off(&self) -> Option<f64> {
        let estimate = self.estimate.as_ref()?;
        estimate.std.filter(|std| *std > 0.0).map(|std| (estimate.value - self.truth).abs() / std)
    }
}

/// A diagnosed session.
#[derive(Clone, Debug)]
pub struct BenchmarkOutcome {
    /// What was diagnosed.
    pub case: BenchmarkCase,
    /// Which engine did it: its name and its version.
    pub engine: String,
    /// The answer.
    pub report: Report,
    /// What the true model achieves.
    pub oracle: Oracle,
    /// The hidden cause's numbers.
    pub numbers: Vec<EstimatedNumber>,
    /// How far the session's robot file is off the truth, in the sigmas that it states, by key.
    pub drawn: Vec<(&'static str, f64)>,
    /// How long the diagnosis took [s]
    pub seconds: f64,
}

/// Stages a session and lets an engine diagnose it.
///
/// # Errors
/// Where the true robot's file is not sound.
pub fn diagnose_case(case: &BenchmarkCase, engine: &dyn Engine) -> Result<BenchmarkOutcome> {
    let session = case.session()?;
    let options = Options::default();
    let start = Instant::now();
    let report = Diagnosis::by(engine, &session, &options).report;
    let seconds = start.elapsed().as_secs_f64();
    let file = RobotFile::parse(&case.truth()?, Path::new("robot.toml"), &known_effects())?;
    let evidence = Evidence::of(&session, &options.knobs.layout).expect("a staged session has all signals");
    let horizon_s = options.knobs.measure.horizon_s;
    let oracle = match &evidence.runs {
        LaidOut::Three(runs) => oracle(case, &evidence.robot, &file, &runs.held, horizon_s),
        LaidOut::Four(runs) => oracle(case, &evidence.robot, &file, &runs.held, horizon_s),
    };
    let numbers = numbers(case, &report, &file);
    let drawn = drawn(&session.robot, &file);
    let engine = format!("{} {}", engine.name(), engine.version());
    Ok(BenchmarkOutcome { case: case.clone(), engine, report, oracle, numbers, drawn, seconds })
}

fn drawn(nominal: &RobotFile, truth: &RobotFile) -> Vec<(&'static str, f64)> {
    let off = |key: &NominalKey| {
        let sigma = truth.relative_uncertainty(key.key)?;
        Some((key.key, (key.value(nominal) / key.value(truth) - 1.0) / sigma))
    };
    NOMINAL_KEYS.iter().filter_map(off).collect()
}

fn oracle<const N: usize>(
    case: &BenchmarkCase,
    nominal: &RobotFile,
    truth: &RobotFile,
    held: &[AlignedRun<N>],
    horizon_s: f64,
) -> Oracle {
    let voltage = case.plan().voltage;
    let mut model = Model::<N>::nominal(truth, voltage);
    if let HiddenCause::Effect(effect) = &case.hidden {
        model.add_effect(effect.clone());
    }
    let held: Vec<&AlignedRun<N>> = held.iter().collect();
    let (nominal, truth) = (Model::<N>::nominal(nominal, voltage).plant(), model.plant());
    Oracle {
        before: measure(&nominal, &held, horizon_s).total(),
        after: measure(&truth, &held, horizon_s).total(),
        floor: floor(&truth, &held, horizon_s).total(),
    }
}

fn numbers(case: &BenchmarkCase, report: &Report, file: &RobotFile) -> Vec<EstimatedNumber> {
    let Some((cause, _)) = case.hidden.cause() else { return Vec::new() };
    let said = report.cause(cause);
    let number = |key: &str, truth: f64| EstimatedNumber {
        key: key.to_owned(),
        truth,
        estimate: said.and_then(|which| which.parameters.get(key)).cloned(),
    };
    match &case.hidden {
        HiddenCause::Effect(effect) => {
            effect.card().params.iter().zip(&effect.params).map(|(p, x)| number(p.key, *x)).collect()
        }
        HiddenCause::Parameter(wrong) => {
            NominalKey::of(wrong.key).map(|k| number(k.key, k.value(file))).into_iter().collect()
        }
        HiddenCause::Nothing => Vec::new(),
    }
}

/// The cause that a report puts first, with its wheel; none where it names none.
fn first(report: &Report) -> Option<(&str, Option<usize>)> {
    let id = report.causes.first()?;
    Some((id, report.cause(id).and_then(|which| which.wheel)))
}

/// Causes that a report cannot tell from its first.
fn alike(report: &Report) -> &[String] {
    let first = report.causes.first().and_then(|id| report.cause(id));
    first.map_or(&[], |which| &which.not_told_apart_from)
}

/// How good an answer is, where the truth is known.
pub fn judge(hidden: &HiddenCause, report: &Report) -> Judgement {
    judge_cause(hidden.cause(), report)
}

/// How good an answer is, where a cause was hidden, on a wheel if it sits on one; or nothing.
pub fn judge_cause(hidden: Option<(&str, Option<usize>)>, report: &Report) -> Judgement {
    let Some((cause, wheel)) = hidden else {
        return if report.verdict == Verdict::NoGap { Judgement::First } else { Judgement::Wrong };
    };
    let in_place = report.cause(cause).is_some_and(|which| which.wheel == wheel);
    match first(report) {
        Some((first, _)) if first == cause && in_place => Judgement::First,
        Some(_) if in_place && alike(report).iter().any(|id| id == cause) => Judgement::Named,
        _ => Judgement::Wrong,
    }
}

impl BenchmarkOutcome {
    /// The cause that the diagnosis puts first, with its wheel; none where it names none.
    pub fn first(&self) -> Option<(&str, Option<usize>)> {
        first(&self.report)
    }

    /// Causes that the diagnosis cannot tell from its first.
    pub fn alike(&self) -> &[String] {
        alike(&self.report)
    }

    /// How good the answer is.
    pub fn judged(&self) -> Judgement {
        judge(&self.case.hidden, &self.report)
    }

    /// What the true model closes of its gap; none where there is none worth dividing by.
    pub fn closed_by_truth(&self) -> Option<f64> {
        let Oracle { before, after, floor } = self.oracle;
        worth_dividing_by(before, floor).then(|| (before - after) / (before - floor))
    }

    /// What the diagnosis closes of what the true model closes.
    pub fn closed_of_truth(&self) -> Option<f64> {
        let Oracle { before, after, .. } = self.oracle;
        worth_dividing_by(before, after).then_some(())?;
        Some((before - self.report.shrink.after?) / (before - after))
    }

    /// True where the report's gap before is the one that was measured here: both then speak of the same runs.
    pub fn same_runs(&self) -> bool {
        self.report.shrink.before.is_some_and(|before| (before - self.oracle.before).abs() < 1e-6 * before)
    }

    /// The probability that the diagnosis gives to the hidden cause.
    pub fn probability(&self) -> f64 {
        let cause = self.case.hidden.cause().map_or("no_gap", |(cause, _)| cause);
        self.report.cause(cause).map_or(0.0, |which| which.probability)
    }
}
