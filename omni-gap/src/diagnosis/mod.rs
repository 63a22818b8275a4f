//! # The diagnosis: all rooms in order, from a session to a report
//!
//! `log → check → simulate → identify → localise → rank → report`. [`diagnose`] is the whole of it for a program that
//! wants the answer; [`Diagnosis::of`] also keeps what the report's files are made of.

mod causes;
mod distances;
mod fitting;
mod pictures;
mod places;

use crate::check::check;
use crate::log::Session;
use crate::report::{self, Pictures, Report};

/// How to diagnose.
#[derive(Clone, Copy)]
pub struct Options<'a> {
    /// Time between restarts of the free runs that measure the gap [s]
    pub horizon_s: f64,
    /// Told what is being done.
    pub progress: &'a dyn Fn(&str),
}

impl std::fmt::Debug for Options<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Options").field("horizon_s", &self.horizon_s).finish_non_exhaustive()
    }
}

impl Default for Options<'_> {
    fn default() -> Self {
        Self { horizon_s: 0.5, progress: &|_| {} }
    }
}

/// A report and what its files are made of.
#[derive(Clone, Debug)]
pub struct Diagnosis {
    /// The answer.
    pub report: Report,
    /// Signals measured, by the nominal and by the corrected model.
    pub pictures: Pictures,
    /// The robot file with the causes written in.
    pub corrected_robot: String,
}

/// Diagnoses a session: where the gap lies, which cause it has, how far it shrinks once the cause is in the model.
///
/// Never fails: a recording that cannot be used is answered with the verdict `unfit_data` and the reasons.
///
/// ```
/// use omni_gap::stage::{Stage, stage};
/// use omni_gap::{Options, Verdict, diagnose, known_effects};
///
/// // a recording of a robot that is just what its file says, give or take the stated uncertainty
/// let robot = include_str!("../../../examples/feup-4w/robot.toml");
/// let plan = Stage { runs: 3, duration: 3.0, rate: 200.0, ..Stage::default() };
/// let session = stage(robot, &plan, &known_effects())?;
///
/// let report = diagnose(&session, &Options::default());
/// assert_eq!(report.verdict, Verdict::NoGap);
/// # Ok::<(), omni_gap::Error>(())
/// ```
pub fn diagnose(session: &Session, options: &Options) -> Report {
    Diagnosis::of(session, options).report
}

impl Diagnosis {
    /// Diagnoses a session and keeps what the report's files are made of.
    pub fn of(session: &Session, options: &Options) -> Self {
        (options.progress)("checking the recordings");
        let faults = check(session);
        if faults.iter().any(|f| f.fatal) {
            return Self::refused(session, &faults);
        }
        let mut diagnosis = match session.robot.wheel.len() {
            3 => fitting::fitted::<3>(session, options),
            _ => fitting::fitted::<4>(session, options),
        };
        diagnosis.report.faults.extend(faults.iter().map(told));
        diagnosis
    }

    fn refused(session: &Session, faults: &[crate::check::Fault]) -> Self {
        let mut report = blank(session, report::Verdict::UnfitData);
        report.faults = faults.iter().map(told).collect();
        Self { report, pictures: Pictures::default(), corrected_robot: session.robot_text.clone() }
    }
}

/// A report with what every verdict says.
fn blank(session: &Session, verdict: report::Verdict) -> Report {
    let mut report = Report::new(verdict);
    report.robot = Some(session.robot.name.clone());
    report.notices = session.notices.clone();
    report
}

fn told(fault: &crate::check::Fault) -> report::Fault {
    report::Fault {
        code: fault.code.to_owned(),
        file: Some(fault.run.clone()),
        column: (!fault.signal.is_empty()).then(|| fault.signal.clone()),
        rows: Some([fault.lines.0, fault.lines.1]),
        what: fault.sentence.trim_end_matches('.').to_owned(),
        mend: fault.mend.trim_end_matches('.').to_owned(),
    }
}
