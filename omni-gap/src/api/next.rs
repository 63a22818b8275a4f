//! Next: what to record or measure so that what is open is settled.

use crate::check::checked;
use crate::diagnosis::{Diagnosis, Options, joined};
use crate::engine::design::{Designed, design};
use crate::engine::knobs::DesignKnobs;
use crate::log::{Run, Session};
use crate::report::NextExperiment;
use crate::report::design::{DesignReport, SCHEMA};

/// Diagnoses a session and designs the experiment that would settle what it leaves open: between causes that were not told
/// apart; between those that come nearest, where none explains the gap; of effects that could not have shown, where nothing is
/// open. None where the recordings cannot be used, or there is nothing of the kind.
///
/// ```
/// use omni_gap::api::{DesignKnobs, Options, next};
/// use omni_gap::engine::findings::Aim;
/// use omni_gap::known_effects;
/// use omni_gap::synthesize::{Scenario, synthesize};
///
/// // a sound robot: what could these runs not have shown, and what would?
/// let robot = include_str!("../../robots/feup-4w/robot.toml");
/// let plan = Scenario { runs: 3, duration: 3.0, rate: 100.0, ..Scenario::default() };
/// let session = synthesize(robot, &plan, &known_effects())?;
/// let (_, designed) = next(&session, &Options::default(), &DesignKnobs::default());
/// let designed = designed.expect("three short runs do not show everything");
/// assert_eq!(designed.design.aim, Aim::Show);
/// assert_eq!(designed.script.rows(), 1000);
/// # Ok::<(), omni_gap::Error>(())
/// ```
pub fn next(session: &Session, options: &Options<'_>, knobs: &DesignKnobs) -> (Diagnosis, Option<Designed>) {
    let diagnosis = Diagnosis::of(session, options);
    (options.progress)("looking for the script that settles most");
    let also: Vec<&Session> = options.also.iter().map(|more| &more.session).collect();
    let all = joined(session, &also);
    let (_, sound) = checked(&all);
    let designed = diagnosis.findings.engine.as_ref().and_then(|_| design(&sound, &diagnosis.findings, knobs));
    (diagnosis, designed)
}

/// The report of a design, and the script that is to be played, if there is one.
pub fn design_report(diagnosis: Diagnosis, designed: Option<Designed>) -> (DesignReport, Option<Run>) {
    let said = diagnosis.report;
    let script = designed.as_ref().and_then(|designed| designed.to_play().cloned());
    let report = DesignReport {
        schema: SCHEMA,
        session: said.session,
        verdict: said.verdict,
        causes: said.causes,
        by_hand: said.next_experiment.map(|next| next.why).filter(|why| !why.is_empty()),
        file: script.as_ref().map(|_| NextExperiment::FILE.to_owned()),
        design: designed.map(|designed| designed.design),
    };
    (report, script)
}
