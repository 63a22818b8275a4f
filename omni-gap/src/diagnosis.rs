//! # The diagnosis: all rooms in order, from a session to a report
//!
//! `log → check → simulate → identify → localise → engine → report`. [`diagnose`] is the whole of it for a program that
//! wants the answer; [`Diagnosis::of`] also keeps what the report's files are made of.

use crate::check::checked;
use crate::engine::evidence::Unfit;
use crate::engine::findings::FileChanges;
use crate::engine::{Engine, Evidence, Findings, Knobs, Stepwise};
use crate::log::{Session, corrected};
use crate::report::{About, Fault, Pictures, Report};
use crate::vocabulary::Progress;

/// How to diagnose.
#[derive(Clone)]
pub struct Options<'a> {
    /// What the report calls the session.
    pub session: Option<String>,
    /// Every threshold; [`Knobs::measure`] has the time between restarts of the free runs that measure the gap.
    pub knobs: Knobs,
    /// Told what is being done.
    pub progress: Progress<'a>,
}

impl std::fmt::Debug for Options<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Options").field("session", &self.session).field("knobs", &self.knobs).finish_non_exhaustive()
    }
}

impl Default for Options<'_> {
    fn default() -> Self {
        Self { session: None, knobs: Knobs::default(), progress: &|_| {} }
    }
}

/// A report and what its files are made of.
#[derive(Clone, Debug)]
pub struct Diagnosis {
    /// The answer.
    pub report: Report,
    /// All that the engine found, of which the report is made.
    pub findings: Findings,
    /// Signals measured, by the nominal and by the corrected model.
    pub pictures: Pictures,
    /// The robot file with its numbers re-fitted within their stated uncertainty; none where no model was fitted.
    pub refitted_robot: Option<String>,
    /// The robot file with the causes written in; none where none was named.
    pub corrected_robot: Option<String>,
}

/// Diagnoses a session: where the gap lies, which cause it has, how far it shrinks once the cause is in the model.
///
/// Never fails: a recording that cannot be used is answered with the verdict `unfit_data` and the reasons.
///
/// ```
/// use omni_gap::synthesize::{Scenario, synthesize};
/// use omni_gap::{Options, Verdict, diagnose, known_effects};
///
/// // a recording of a robot that is just what its file says, give or take the stated uncertainty
/// let robot = include_str!("../../examples/feup-4w/robot.toml");
/// let plan = Scenario { runs: 3, duration: 3.0, rate: 200.0, ..Scenario::default() };
/// let session = synthesize(robot, &plan, &known_effects())?;
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
        Self::by(&Stepwise, session, options)
    }

    /// The same by another engine than the product's.
    pub fn by(engine: &dyn Engine, session: &Session, options: &Options) -> Self {
        let Options { session: name, knobs, progress } = options;
        progress("checking the recordings");
        let (faults, session) = checked(session);
        let session = &*session;
        let sound = !faults.iter().any(|f| f.fatal);
        let (findings, why, notices) = match sound.then(|| Evidence::of(session, &knobs.layout)) {
            None => (Findings::unfit(), None, Vec::new()),
            Some(Err(unfit)) => (Findings::unfit(), Some(unfit), Vec::new()),
            Some(Ok(evidence)) => (engine.find(&evidence, knobs, progress), None, evidence.notices),
        };
        let about = About {
            robot: session.robot.name.clone(),
            session: name.clone(),
            faults: why.map(fault).into_iter().chain(faults.iter().map(Fault::from)).collect(),
            notices: session.notices.iter().cloned().chain(notices).chain(left_out(&knobs.screen.without)).collect(),
        };
        let with = |changes: &FileChanges| corrected(&session.robot_text, &changes.changes()).ok();
        Self {
            report: Report::of(&findings, about),
            pictures: findings.traces.as_ref().map(Pictures::of).unwrap_or_default(),
            refitted_robot: findings.traces.as_ref().and_then(|_| with(&findings.refitted)),
            corrected_robot: (!findings.causes.is_empty()).then(|| with(&findings.corrected)).flatten(),
            findings,
        }
    }
}

/// What the reader should know of a catalogue that was not whole.
fn left_out(without: &[String]) -> Option<String> {
    let names: Vec<String> = without.iter().map(|id| format!("`{id}`")).collect();
    (!names.is_empty()).then(|| format!("left out of the catalogue, as asked: {}", names.join(", ")))
}

fn fault(unfit: Unfit) -> Fault {
    let Unfit { code, what, fix } = unfit;
    Fault { code: code.to_owned(), what: what.to_owned(), fix: fix.to_owned(), ..Fault::default() }
}
