//! Compare: which cause explains the difference between two sessions.

use std::path::Path;

use crate::check::{self, checked};
use crate::comparison::{self, Compared, Comparison, Options, SideName};
use crate::engine::evidence::Unfit;
use crate::error::{Error, InputKind, Result};
use crate::log::{RobotFile, Session};
use crate::report::Fault;
use crate::report::Pictures;
use crate::report::comparison::{Against, ComparisonReport, Named, pictures};
use crate::simulate::NOMINAL_KEYS;

/// A session that is compared.
#[derive(Clone, Copy, Debug)]
pub struct ComparedSession<'a> {
    /// The session.
    pub session: &'a Session,
    /// What the report calls it.
    pub name: &'a str,
    /// Where its robot file stands, for messages.
    pub robot_file: &'a Path,
}

/// A comparison's report, and what its page is made of.
#[derive(Clone, Debug)]
pub struct SessionsCompared {
    /// The answer.
    pub report: ComparisonReport,
    /// B's signals, measured, by A's model and by that with what differs.
    pub pictures: Pictures,
}

/// Compares two sessions: A's model is the yardstick, and what differs in B is named. Recordings that cannot be used are no error
/// but its answer, `unfit_data`.
///
/// ```
/// use std::path::Path;
///
/// use omni_gap::api::{ComparedSession, compare};
/// use omni_gap::comparison::{ComparisonVerdict, Options};
/// use omni_gap::known_effects;
/// use omni_gap::report::comparison::Against;
/// use omni_gap::synthesize::{Scenario, synthesize};
///
/// // the same robot twice
/// let robot = include_str!("../../robots/feup-4w/robot.toml");
/// let plan = Scenario { runs: 3, duration: 2.0, rate: 200.0, uncertain: false, ..Scenario::default() };
/// let [before, after] = [1, 2].map(|seed| {
///     synthesize(robot, &Scenario { seed, ..plan.clone() }, &known_effects()).expect("a sound stage")
/// });
/// let side = |session, name| ComparedSession { session, name, robot_file: Path::new("robot.toml") };
/// let compared = compare([side(&before, "before"), side(&after, "after")], Against::Recordings, &Options::default())?;
/// assert_eq!(compared.report.comparison.verdict, ComparisonVerdict::Alike);
/// # Ok::<(), omni_gap::Error>(())
/// ```
///
/// # Errors
/// Where the robots have not as many wheels each.
pub fn compare(sides: [ComparedSession<'_>; 2], against: Against, options: &Options<'_>) -> Result<SessionsCompared> {
    let [a, b] = sides;
    let wheels = [a, b].map(|side| side.session.robot.wheel.len());
    if wheels[0] != wheels[1] {
        let problem = format!("{} wheels, where the robot of {} has {}", wheels[1], a.name, wheels[0]);
        let fix = "Compare sessions of robots with as many wheels each";
        return Err(Error::input(b.robot_file, problem, fix).of_kind(InputKind::Conflict));
    }
    (options.progress)("checking the recordings");
    let [(faults_a, sound_a), (faults_b, sound_b)] = [a, b].map(|side| checked(side.session));
    let told = |faults: &[check::Fault], side: ComparedSession<'_>| -> Vec<Fault> {
        faults.iter().map(|fault| Fault::from(fault).of_session(side.name)).collect()
    };
    let mut faults = told(&faults_a, a);
    faults.extend(told(&faults_b, b));
    let fatal = faults_a.iter().chain(&faults_b).any(|fault| fault.fatal);
    let unfit = || Compared { comparison: Comparison::unfit(options.knobs.clone()), traces: None, notices: Vec::new() };
    let compared = if fatal {
        unfit()
    } else {
        comparison::compare(&sound_a, &sound_b, options).unwrap_or_else(|(side, why)| {
            faults.insert(0, no_evidence(why, if side == SideName::A { a } else { b }));
            unfit()
        })
    };
    let named = Named { robot: a.session.robot.name.clone(), a: a.name.to_owned(), b: b.name.to_owned(), against };
    let of_files = [a, b].into_iter().flat_map(|side| side.session.notices.clone());
    let notices = of_files.chain(compared.notices).chain(other_numbers(&a.session.robot, &b.session.robot)).collect();
    Ok(SessionsCompared {
        pictures: compared.traces.as_ref().map(pictures).unwrap_or_default(),
        report: ComparisonReport::of(compared.comparison, named, faults, notices),
    })
}

fn no_evidence(why: Unfit, side: ComparedSession<'_>) -> Fault {
    let Unfit { code, what, fix } = why;
    Fault {
        code: code.to_owned(),
        file: Some(side.name.to_owned()),
        what: what.to_owned(),
        fix: fix.to_owned(),
        ..Fault::default()
    }
}

/// What the reader should know where the two robot files state other numbers.
fn other_numbers(a: &RobotFile, b: &RobotFile) -> Option<String> {
    let differs = |key: &&crate::simulate::NominalKey| {
        (0..a.wheel.len()).any(|wheel| a.nominal(key.key, wheel) != b.nominal(key.key, wheel))
    };
    let mut keys: Vec<&str> = NOMINAL_KEYS.iter().filter(differs).map(|key| key.key).collect();
    if a.motor.gear_ratio != b.motor.gear_ratio {
        keys.push("gear_ratio");
    }
    if a.wheel.iter().zip(&b.wheel).any(|(a, b)| a.drive_angle_deg != b.drive_angle_deg) {
        keys.push("drive_angle_deg");
    }
    let names = keys.join(", ");
    (!keys.is_empty()).then(|| format!("the robot files state other numbers ({names}); both sides are compared by A's"))
}
