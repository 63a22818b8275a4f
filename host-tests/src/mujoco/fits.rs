//! The same fit on both sides: seven numbers, from recordings along one axis each.
//!
//! One axis at a time, because MuJoCo's joints have the world's axes: there the friction of v and of vn stays apart only
//! while the heading stays what it was. Here the fit has the start of every window free besides; there every run is
//! simulated as a whole, from the rest at which it is known to begin.

use std::thread::sleep;
use std::time::{Duration, Instant};

use model_core::plant::Input;
use model_core::plant::robot::Nominal;
use omni_gap::identify::Fit;
use omni_gap::known_effects;
use omni_gap::log::Session;
use omni_gap::simulate::{AXES, AlignedRun, Excitation, SensorSetup, excite, record};
use omni_gap::synthesize::{Scenario, synthesize};
use serde_json::{Value, json};

use super::median::median;
use super::worker::{Worker, array, number, numbers};
use crate::catalogue::sessions::truth;
use crate::fit_case::{COUNT, FitCase, WITHIN, WRONG, astray, found, scenario};
use crate::plant_cases::model;

/// Fits of each side.
pub const TURNS: usize = 3;

/// A pause before each turn: threads of the other side that still wait for work do so at full speed for a while.
const PAUSE: Duration = Duration::from_millis(500);

/// Where SciPy's fit stops: a round that brings the cost down by less than this share. Ours stops at the same share, and
/// at a tenth of a σ² below.
pub const TOLERANCE: f64 = 1e-6;

/// The fits of one side.
#[derive(Clone, Debug)]
pub struct Side {
    /// How long one takes, median [s]
    pub seconds: f64,
    /// The largest error of a number against the truth, relative
    pub worst: f64,
    /// What is left, per number that was compared [σ²]
    pub error: f64,
}

/// The fits of both sides.
#[derive(Clone, Debug)]
pub struct Fits {
    /// This library's.
    pub ours: Side,
    /// MuJoCo's with SciPy.
    pub theirs: Side,
    /// How many times as long as ours theirs takes, median of all turns.
    pub ratio: f64,
    /// How often SciPy had all runs simulated.
    pub rollouts: f64,
    /// How many threads each side has.
    pub threads: usize,
}

/// Takes all turns.
///
/// # Errors
/// Where MuJoCo's side does not answer, or a fit does not arrive at the truth.
pub fn measured(worker: &mut Worker) -> Result<Fits, String> {
    let case = FitCase::of(&session());
    let threads = rayon::current_num_threads();
    worker.ask(&request(&case, threads)?)?;
    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    let mut last = None;
    for _ in 0..TURNS {
        sleep(PAUSE);
        let begun = Instant::now();
        let fitted = case.fit();
        ours.push(begun.elapsed().as_secs_f64());
        sleep(PAUSE);
        let answer = worker.ask(&json!({"ask": "fit"}))?;
        theirs.push(number(&answer, "seconds")?);
        last = Some((fitted, answer));
    }
    let (fitted, answer) = last.ok_or("no turn was taken")?;
    let factors: [f64; COUNT] = array(&answer, "factors")?;
    arrived("this fit", &found(&fitted), &fitted)?;
    arrived("SciPy's fit", &factors, &fitted)?;
    Ok(Fits {
        ratio: median(theirs.iter().zip(&ours).map(|(theirs, ours)| theirs / ours).collect()),
        ours: Side { seconds: median(ours), worst: worst(&found(&fitted)), error: fitted.cost / fitted.samples as f64 },
        theirs: Side { seconds: median(theirs), worst: worst(&factors), error: number(&answer, "error")? },
        rollouts: number(&answer, "rollouts")?,
        threads,
    })
}

fn arrived(who: &str, factors: &[f64; COUNT], fitted: &Fit<4>) -> Result<(), String> {
    let astray = astray(factors, fitted);
    if astray.is_empty() { Ok(()) } else { Err(format!("{who} does not arrive at the truth: {}", astray.join("; "))) }
}

fn worst(factors: &[f64; COUNT]) -> f64 {
    WRONG.iter().zip(factors).map(|((_, _, truth), found)| (found / truth - 1.0).abs()).fold(0.0, f64::max)
}

/// The scenario's robot, each run along one axis.
fn session() -> Session {
    let plan = Scenario { runs: 0, ..scenario() };
    let mut session = synthesize(truth(4), &plan, &known_effects()).expect("the example is sound");
    let model = model(&[]);
    let plant = model.plant();
    let how = SensorSetup { sensors: session.robot.sensors, ..SensorSetup::default() };
    let wish = Excitation { duration: plan.duration, rate: plan.rate, voltage: plan.voltage };
    for k in 0..scenario().runs {
        let axis = k % AXES.len();
        let script = excite(&model.robot().wheels, &wish, plan.seed + k as u64);
        let share = model.robot().wheels.rows().map(|row| row[axis]);
        let input: Vec<_> = script.iter().map(|u| Input::Voltage(only(share, *u))).collect();
        let t: Vec<f64> = (0..input.len()).map(|row| row as f64 / plan.rate).collect();
        session.runs.push(record(&plant, &format!("run{k:02}"), &t, &input, &how, plan.seed + k as u64));
    }
    session
}

/// What there is of one axis in these voltages [V].
fn only(share: [f64; 4], volts: [f64; 4]) -> [f64; 4] {
    let dot = |a: [f64; 4]| a.iter().zip(share).map(|(a, b)| a * b).sum::<f64>();
    let size = dot(volts) / dot(share);
    share.map(|share| size * share)
}

/// What MuJoCo's side has to know of the fit.
fn request(case: &FitCase, threads: usize) -> Result<Value, String> {
    let channels = AlignedRun::<4>::channels();
    let compared = channels.heading() + 1;
    let row = |run: &AlignedRun<4>, row: usize| -> Vec<Option<f64>> {
        (0..compared).map(|c| run.saw(row, c).then_some(run.measured[row][c])).collect()
    };
    let rows = |run| (0..AlignedRun::rows(run)).map(|k| row(run, k)).collect::<Vec<_>>();
    let first = case.runs.first().ok_or("there is no recording")?;
    let mut stated = Vec::new();
    for (key, p, _) in WRONG {
        let alone = |terms: &[(Nominal, f64)]| terms == [(p, 1.0)];
        let row = case.prior.rows.iter().find(|row| alone(&row.terms));
        stated.push(row.ok_or_else(|| format!("the robot file states nothing of {key} alone"))?.sigma);
    }
    Ok(json!({
        "ask": "recorded",
        "robot": numbers(case.nominal.robot()),
        "step": first.dt[0],
        "volts": case.runs.iter().map(|run| &run.input).collect::<Vec<_>>(),
        "measured": case.runs.iter().map(rows).collect::<Vec<_>>(),
        "sigma": &first.sigma[..compared],
        "free": WRONG.map(|(_, p, _)| field(p)),
        "stated": stated,
        "within": [WITHIN.0, WITHIN.1],
        "tolerance": TOLERANCE,
        "threads": threads,
    }))
}

/// What MuJoCo's side calls a nominal value: a field of its robot, and the axis in it.
fn field(p: Nominal) -> (&'static str, Option<usize>) {
    match p {
        Nominal::Mass => ("mass", None),
        Nominal::Inertia => ("inertia", None),
        Nominal::Resistance => ("resistance", None),
        Nominal::ViscousV | Nominal::ViscousVn | Nominal::ViscousW => ("viscous", p.axis()),
        Nominal::CoulombV | Nominal::CoulombVn | Nominal::CoulombW => ("coulomb", p.axis()),
        other => unreachable!("{other:?} is not free"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_recording_goes_along_its_one_axis_from_rest() {
        for (k, run) in session().runs.iter().enumerate() {
            let share = model(&[]).robot().wheels.rows().map(|row| row[k % 3]);
            let run = AlignedRun::<4>::new(run, &session().robot).expect("voltages drive the model");
            assert_eq!(run.input[0], [0.0; 4]);
            let off = |u: &[f64; 4]| only(share, *u).iter().zip(u).any(|(a, b)| (a - b).abs() > 1e-9);
            assert!(!run.input.iter().any(off), "run {k}");
            assert!(run.input.iter().flatten().any(|u| u.abs() > 3.0), "run {k}");
        }
    }
}
