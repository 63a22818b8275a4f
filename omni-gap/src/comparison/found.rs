//! What the engine finds in each side.

use super::known::{as_free_as_stated, robot_known};
use super::options::Options;
use crate::engine::evidence::Unfit;
use crate::engine::{Engine, Evidence, Findings, Stepwise};
use crate::log::{RobotFile, Session};
use crate::vocabulary::{Kind, Verdict};

/// What the engine finds in a session, judged by a robot file.
///
/// Something new is not believed where another value of a number that every robot has explains as much: another floor before a
/// patch of it as large as the room.
///
/// # Errors
/// Where the session is no evidence.
fn found(session: &Session, robot: &RobotFile, options: &Options<'_>) -> Result<Findings, Unfit> {
    let Options { engine: knobs, knobs: own, progress } = options;
    let evidence = Evidence::of(&Session { robot: robot.clone(), ..session.clone() }, &knobs.layout)?;
    let found = Stepwise.find(&evidence, knobs, progress);
    let like_numbers = like_numbers(&found, own.as_good);
    if like_numbers.is_empty() {
        return Ok(found);
    }
    progress("trying numbers of the robot file in place of what looks like them");
    let mut knobs = knobs.clone();
    knobs.screen.without.extend(like_numbers);
    let by_numbers = Stepwise.find(&evidence, &knobs, progress);
    let as_good =
        by_numbers.shrink.after.zip(found.shrink.after).is_some_and(|(number, new)| number * own.as_good <= new);
    Ok(if explains(&by_numbers) && as_good { by_numbers } else { found })
}

/// Effects that are named though a number of the file explains as much, but for a share.
fn like_numbers(found: &Findings, share: f64) -> Vec<String> {
    let gain_of_number = |round: usize| {
        let numbers = found.considered.iter().filter(|other| other.round == round && other.kind == Kind::Parameter);
        numbers.filter_map(|other| other.gain).fold(f64::NEG_INFINITY, f64::max)
    };
    let named = found.considered.iter().filter(|c| c.taken_up && c.kind == Kind::Effect);
    let named = named.filter(|c| found.causes.contains(&c.id));
    named.filter(|c| c.gain.is_some_and(|gain| gain_of_number(c.round) > share * gain)).map(|c| c.id.clone()).collect()
}

fn explains(found: &Findings) -> bool {
    matches!(found.verdict, Verdict::Parameter | Verdict::Effect)
}

/// What the engine finds in A by its own robot file; where nothing there explains it, by what B shows of the robot.
///
/// # Errors
/// Where A is no evidence.
pub(super) fn found_in_a(a: &Session, b: &Session, options: &Options<'_>) -> Result<Findings, Unfit> {
    (options.progress)("what A teaches");
    let by_file = found(a, &a.robot, options)?;
    if by_file.verdict != Verdict::Unknown {
        return Ok(by_file);
    }
    (options.progress)("what B teaches of A");
    let Ok(in_b) = found(b, &a.robot, options) else { return Ok(by_file) };
    if in_b.verdict == Verdict::Unknown {
        return Ok(by_file);
    }
    let by_b = judged_by(&robot_known(&a.robot, &in_b, options.knobs.least_known), a, &a.robot, options)?;
    Ok(if explains(&by_b) { by_b } else { by_file })
}

/// What the engine finds in a session by what the other side shows of the robot, whose file is `stated`; where nothing explains it
/// so, once more with the numbers as free as stated: numbers that may hardly move leave errors that go on through whole windows,
/// before which no cause promises anything.
///
/// # Errors
/// Where the session is no evidence.
pub(super) fn judged_by(
    known: &RobotFile,
    session: &Session,
    stated: &RobotFile,
    options: &Options<'_>,
) -> Result<Findings, Unfit> {
    let by_known = found(session, known, options)?;
    if by_known.verdict != Verdict::Unknown {
        return Ok(by_known);
    }
    (options.progress)("once more, its numbers as free as the robot file states");
    let freer = found(session, &as_free_as_stated(known, stated), options)?;
    Ok(if freer.verdict != Verdict::Unknown { freer } else { by_known })
}
