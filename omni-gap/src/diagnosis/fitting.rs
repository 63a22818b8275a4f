//! The rooms at work on one session, for a robot of `N` wheels.

use super::distances::{curves, shrink};
use super::{Diagnosis, Options, blank, causes, pictures, places};
use crate::identify::{Prior, Windows};
use crate::log::{Session, corrected};
use crate::rank::{Cause, Data, Outcome, Verdict, decide};
use crate::report;
use crate::simulate::{Chain, Model, Recorded, supply_seen};

/// Length of a shooting window [s]
const WINDOW_S: f64 = 0.5;
/// Every third run is held out where the session holds out none.
const HOLD_OUT: usize = 3;
/// Parts into which a lone run is cut, to have something to hold out.
const PARTS: usize = 3;

/// The recordings laid out: those to fit on and those to judge by.
pub(super) struct Laid<const N: usize> {
    pub fit: Vec<Recorded<N>>,
    pub held: Vec<Recorded<N>>,
    pub notices: Vec<String>,
}

fn lay_out<const N: usize>(session: &Session) -> Laid<N> {
    let mut notices = Vec::new();
    let mut of = |runs: &[crate::log::Run]| -> Vec<Recorded<N>> {
        runs.iter()
            .filter_map(|run| {
                let laid = Recorded::new(run, &session.robot);
                if laid.is_none() {
                    notices.push(format!("run {}: nothing in it can drive the model; left out", run.name));
                }
                laid
            })
            .collect()
    };
    let mut fit = of(&session.runs);
    let mut held = of(&session.heldout);
    if held.is_empty() {
        if fit.len() < HOLD_OUT {
            notices.push(format!(
                "{} run(s) only: each was cut into {PARTS} parts to have some held out; hidden states start cold in each",
                fit.len()
            ));
            fit = fit.iter().flat_map(|run| run.cut(PARTS)).collect();
        }
        let (mut kept, mut out) = (Vec::new(), Vec::new());
        for (k, run) in fit.into_iter().enumerate() {
            if k % HOLD_OUT == HOLD_OUT - 1 { out.push(run) } else { kept.push(run) }
        }
        (fit, held) = (kept, out);
    }
    Laid { fit, held, notices }
}

pub(super) fn fitted<const N: usize>(session: &Session, options: &Options) -> Diagnosis {
    let Laid { fit, held, notices } = lay_out::<N>(session);
    if fit.is_empty() || held.is_empty() {
        return unfit(
            session,
            "nothing_drives_the_model",
            "no run has a voltage, a signed current, a wheel speed or a commanded wheel speed to drive the model with",
            "log at least one of u, i, w or wset for every wheel",
        );
    }
    if fit.iter().chain(&held).all(|run| run.has.iter().all(|has| *has == 0)) {
        return unfit(
            session,
            "nothing_to_compare",
            "what drives the model is all that was measured, so nothing is left to compare it with",
            "log the pose, or voltages beside the wheel speeds",
        );
    }
    let nominal = Model::<N>::nominal(&session.robot, supply_seen(fit.iter().chain(&held)));
    let data = Data {
        fit_windows: fit.iter().map(|r| Windows::new(r, WINDOW_S)).collect(),
        held_windows: held.iter().map(|r| Windows::new(r, WINDOW_S)).collect(),
        fit: fit.iter().collect(),
        held: held.iter().collect(),
        prior: Prior::stated(&session.robot),
    };
    let verdict = decide(&data, &nominal, options.horizon_s, options.progress);
    (options.progress)("writing the report");

    let mut report = blank(session, word(&verdict));
    report.notices.extend(notices);
    let plants = (nominal.plant(), verdict.reported().fit.model.plant());
    let refitted = verdict.refitted.fit.model.plant();
    let runner_up = causes::runner_up(&verdict).map(|r| r.scored.fit.model.plant());
    (report.gap, report.shrink) =
        shrink(&plants.0, &plants.1, &refitted, runner_up.as_ref(), &data.held, options.horizon_s);
    report.gap.curves = curves(&plants.0, &plants.1, &data.held);
    report.gap.horizons_s = report.gap.curves.iter().map(|c| c.horizon_s).collect();
    report.which = causes::which(&verdict, &session.robot);
    let known = matches!(verdict.outcome, Outcome::Explained);
    report.causes = if known { verdict.found.iter().map(|f| f.cause.id().to_owned()).collect() } else { Vec::new() };
    report.where_ = places::places(&verdict, &nominal, &data, options.horizon_s);
    report.parameters = causes::parameters(&verdict, &session.robot);
    report.not_seen = causes::not_seen(&verdict, &data);
    report.next_experiment = causes::next_experiment(&report);
    if data.fit[0].chain != Chain::Voltage {
        report.notices.push(format!("no usable voltage: the model is driven by {}", driven(data.fit[0].chain)));
    }
    let changes = if known { causes::changes(&verdict, &session.robot) } else { Vec::new() };
    let corrected_robot = corrected(&session.robot_text, &changes).unwrap_or_else(|_| session.robot_text.clone());
    let pictures = pictures::pictures(&plants.0, &plants.1, data.held[0], options.horizon_s);
    Diagnosis { report, pictures, corrected_robot }
}

/// The answer where the recordings cannot be used.
fn unfit(session: &Session, code: &str, what: &str, mend: &str) -> Diagnosis {
    let mut report = blank(session, report::Verdict::UnfitData);
    report.faults.push(report::Fault {
        code: code.to_owned(),
        what: what.to_owned(),
        mend: mend.to_owned(),
        ..report::Fault::default()
    });
    Diagnosis { report, pictures: report::Pictures::default(), corrected_robot: session.robot_text.clone() }
}

fn word<const N: usize>(verdict: &Verdict<N>) -> report::Verdict {
    match (&verdict.outcome, verdict.found.first().map(|f| f.cause)) {
        (Outcome::NoGap, _) => report::Verdict::NoGap,
        (Outcome::Unknown, _) | (Outcome::Explained, None) => report::Verdict::Unknown,
        // one effect is enough: then correcting parameters alone does not explain the gap
        (Outcome::Explained, _) if verdict.found.iter().any(|f| matches!(f.cause, Cause::Effect(..))) => {
            report::Verdict::Effect
        }
        (Outcome::Explained, Some(_)) => report::Verdict::Parameter,
    }
}

fn driven(chain: Chain) -> &'static str {
    match chain {
        Chain::Voltage => "the commanded voltages",
        Chain::Current => "the measured currents",
        Chain::WheelSpeed => "the measured wheel speeds",
        Chain::SetSpeed => "the commanded wheel speeds",
    }
}
