//! # The diagnosis: all rooms in order, from a session to a report
//!
//! `log → check → simulate → identify → localise → engine → report`. [`diagnose`] is the whole of it for a program that
//! wants the answer; [`Diagnosis::of`] also keeps what the report's files are made of.

use std::borrow::Cow;

use crate::check::{self, checked};
use crate::engine::design::design;
use crate::engine::evidence::Unfit;
use crate::engine::findings::{FileChanges, NextExperiment};
use crate::engine::knobs::DesignKnobs;
use crate::engine::{Engine, Evidence, Findings, Knobs, Stepwise};
use crate::log::{Run, Session, corrected};
use crate::report::{About, Fault, Pictures, Report, settled};
use crate::vocabulary::Progress;

/// How to diagnose.
#[derive(Clone)]
pub struct Options<'a> {
    /// What the report calls the session.
    pub session: Option<String>,
    /// Further recordings of the same robot, judged by the same file together with the session's own; the report says what they
    /// settled.
    pub also: &'a [NamedSession],
    /// Every threshold; [`Knobs::measure`] has the time between restarts of the free runs that measure the gap.
    pub knobs: Knobs,
    /// Told what is being done.
    pub progress: Progress<'a>,
}

/// A session and what a report calls it.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedSession {
    /// Its name.
    pub name: String,
    /// The session; its robot file is not looked at.
    pub session: Session,
}

impl std::fmt::Debug for Options<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { session, also, knobs, .. } = self;
        let also: Vec<&str> = also.iter().map(|more| more.name.as_str()).collect();
        f.debug_struct("Options")
            .field("session", session)
            .field("also", &also)
            .field("knobs", knobs)
            .finish_non_exhaustive()
    }
}

impl Default for Options<'_> {
    fn default() -> Self {
        Self { session: None, also: &[], knobs: Knobs::default(), progress: &|_| {} }
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
    /// The script that would tell apart causes that were not; none where nothing of the kind is open, or no script helps.
    pub next_run: Option<Run>,
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
/// let robot = include_str!("../robots/feup-4w/robot.toml");
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
        let mut together = Self::together(engine, session, options);
        if options.also.is_empty() {
            return together;
        }
        (options.progress)("what the session says alone");
        let alone = Self::together(engine, session, &Options { also: &[], ..options.clone() });
        let names: Vec<&str> = options.also.iter().map(|more| more.name.as_str()).collect();
        together.report.notices.insert(0, settled(&alone.report, &together.report, &names));
        together
    }

    /// Diagnoses all sessions as one.
    fn together(engine: &dyn Engine, session: &Session, options: &Options) -> Self {
        let Options { session: name, also, knobs, progress } = options;
        progress("checking the recordings");
        let Checked { session, also, faults, fatal } = Checked::of(session, also);
        let also: Vec<&Session> = also.iter().map(|further| &**further).collect();
        let (mut findings, why, notices) = match (!fatal).then(|| Evidence::of_all(&session, &also, &knobs.layout)) {
            None => (Findings::unfit(), None, Vec::new()),
            Some(Err(unfit)) => (Findings::unfit(), Some(unfit), Vec::new()),
            Some(Ok(evidence)) => (engine.find(&evidence, knobs, progress), None, evidence.notices),
        };
        let script = next_run(&joined(&session, &also), &mut findings, knobs, *progress);
        let of_files =
            std::iter::once(&*session).chain(also.iter().copied()).flat_map(|session| session.notices.clone());
        let about = About {
            robot: session.robot.name.clone(),
            session: name.clone(),
            faults: why.map(fault).into_iter().chain(faults).collect(),
            notices: of_files.chain(notices).chain(left_out(&knobs.screen.without)).collect(),
        };
        let with = |changes: &FileChanges| corrected(&session.robot_text, &changes.changes()).ok();
        Self {
            report: Report::of(&findings, about),
            pictures: findings.traces.as_ref().map(Pictures::of).unwrap_or_default().of_robot(&session.robot.wheel),
            refitted_robot: findings.traces.as_ref().and_then(|_| with(&findings.refitted)),
            corrected_robot: (!findings.causes.is_empty()).then(|| with(&findings.corrected)).flatten(),
            next_run: script,
            findings,
        }
    }
}

/// Sessions as they are to be used, and all that is wrong with their recordings.
struct Checked<'a> {
    session: Cow<'a, Session>,
    also: Vec<Cow<'a, Session>>,
    faults: Vec<Fault>,
    /// Whether any of them is fatal.
    fatal: bool,
}

impl<'a> Checked<'a> {
    fn of(session: &'a Session, also: &'a [NamedSession]) -> Self {
        let (own, session) = checked(session);
        let mut all = Self { session, also: Vec::new(), faults: Vec::new(), fatal: false };
        all.add(&own, |fault| Fault::from(fault));
        for more in also {
            let (faults, sound) = checked(&more.session);
            all.add(&faults, |fault| Fault::from(fault).of_session(&more.name));
            all.also.push(sound);
        }
        all
    }

    fn add(&mut self, faults: &[check::Fault], told: impl Fn(&check::Fault) -> Fault) {
        self.fatal |= faults.iter().any(|fault| fault.fatal);
        self.faults.extend(faults.iter().map(told));
    }
}

/// All runs in one session.
pub(crate) fn joined<'a>(session: &'a Session, also: &[&Session]) -> Cow<'a, Session> {
    if also.is_empty() {
        return Cow::Borrowed(session);
    }
    let mut joined = session.clone();
    for more in also {
        joined.runs.extend(more.runs.iter().cloned());
        joined.heldout.extend(more.heldout.iter().cloned());
    }
    Cow::Owned(joined)
}

/// The script that would tell apart what the findings could not; they are told its file.
fn next_run(session: &Session, findings: &mut Findings, knobs: &Knobs, progress: Progress<'_>) -> Option<Run> {
    findings.next_experiment.as_ref()?;
    progress("looking for the script that settles most");
    let mut of = DesignKnobs::default();
    of.selftest.engine = knobs.clone();
    let script = design(session, findings, &of)?.to_play().cloned();
    if let (Some(next), Some(_)) = (&mut findings.next_experiment, &script) {
        next.file = Some(NextExperiment::FILE.to_owned());
    }
    script
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
