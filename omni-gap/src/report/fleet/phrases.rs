//! What a fleet's report says, for terminal and page alike.

use super::model::{FleetReport, KindOfRobot, SessionLine};
use crate::pooling::{ChangePoint, CommonCause, Contrast, PooledNumber, RobotEstimate};
use crate::report::number::{estimate, num, percent};
use crate::report::phrases::verdict as word;
use crate::vocabulary::Verdict;

/// A cause of this probability is told as found.
const FOUND: f64 = 0.9;

/// One of this probability, more likely than not, is told as perhaps found.
const PERHAPS: f64 = 0.5;

/// "30 robots of one kind, 412 sessions".
pub(super) fn subject(report: &FleetReport) -> String {
    let mut robots: Vec<(&Option<String>, &str)> =
        report.sessions.iter().map(|s| (&s.kind, s.robot.as_str())).collect();
    robots.sort_unstable();
    robots.dedup();
    let kinds = match report.kinds.as_slice() {
        [] => String::new(),
        [one] => format!(" of the kind {}", one.kind),
        several => format!(" of {} kinds", several.len()),
    };
    format!("{}{kinds}, {}", counted(robots.len(), "robot"), counted(report.sessions.len(), "session"))
}

/// One sentence about a kind.
pub(super) fn headline(kind: &KindOfRobot) -> String {
    let name = &kind.kind;
    let (who, share) = match kind.pooled.robots {
        0 => return format!("{name}: no session could be pooled."),
        1 => ("its one robot", "has"),
        _ => ("all robots", "share"),
    };
    match kind.pooled.common.first() {
        Some(cause) if cause.probability >= FOUND => {
            format!("{name}: {who} {share} {}.", named(&cause.title, cause.of.wheel))
        }
        Some(cause) if cause.probability >= PERHAPS => {
            let chance = percent(cause.probability);
            format!("{name}: perhaps {who} {share} {} ({chance}).", named(&cause.title, cause.of.wheel))
        }
        _ => format!("{name}: {who} {share} nothing that the robot file does not know."),
    }
}

/// "3 no gap, 2 effect, 1 without an answer".
pub(super) fn verdicts(sessions: &[SessionLine]) -> String {
    use Verdict::{Effect, NoGap, Parameter, UnfitData, Unknown};
    let all = [Some(NoGap), Some(Parameter), Some(Effect), Some(Unknown), Some(UnfitData), None];
    let counted = all.map(|verdict| (sessions.iter().filter(|s| s.verdict == verdict).count(), verdict));
    let told: Vec<String> = counted
        .into_iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, verdict)| format!("{count} {}", verdict.map_or("without an answer", word)))
        .collect();
    told.join(", ")
}

/// What robots share, with its size.
pub(super) fn common(cause: &CommonCause) -> String {
    let spread = match cause.spread {
        spread if spread > 0.0 => format!(", {} from robot to robot", num(spread)),
        _ => String::new(),
    };
    let alone = match cause.named_alone {
        0 => "no session named it alone".to_owned(),
        1 => "one session named it alone".to_owned(),
        n => format!("{n} sessions named it alone"),
    };
    let size = size(&cause.of.key, cause.value, cause.std);
    format!("{} {}: {size}{spread}; {alone}", named(&cause.title, cause.of.wheel), percent(cause.probability))
}

/// A session without an answer, and why.
pub(super) fn without_answer(session: &SessionLine) -> Option<String> {
    let why = session.reason.as_ref().filter(|_| session.verdict.is_none())?;
    Some(format!("{}: {why}", session.session))
}

/// A robot that is otherwise than its kind.
pub(super) fn outlier(robot: &RobotEstimate) -> String {
    let size = size(&robot.of.key, robot.value, robot.std);
    let z = robot.from_kind.unwrap_or(0.0);
    format!("{}: {}, {size}, {} standard errors from the others", robot.robot, spotted(&robot.of), num(z))
}

/// A change over time.
pub(super) fn change(change: &ChangePoint) -> String {
    let by = size(&change.of.key, change.by, change.std);
    let since = format!("between {} and {}", change.last_before, change.since);
    format!("{}: {} changed {since} by {by}", change.robot, spotted(&change.of))
}

/// A difference between two labels.
pub(super) fn contrast(contrast: &Contrast) -> String {
    let Contrast { label, from, to, .. } = contrast;
    let by = size(&contrast.of.key, contrast.by, contrast.std);
    let robots = counted(contrast.robots, "robot");
    format!("{label} {from} → {to}: {} differs by {by} ({robots})", spotted(&contrast.of))
}

/// The share of what a file states that robots have in common.
pub(super) fn in_common(kind: &KindOfRobot) -> Option<String> {
    let share = kind.pooled.in_common?;
    let told = "of what the robot file states as uncertain of its numbers is common to all robots, the rest differs";
    (kind.pooled.robots > 1).then(|| format!("About {} {told}.", percent(share)))
}

/// "dead_time on wheel 2".
pub(super) fn spotted(of: &PooledNumber) -> String {
    named(&of.id, of.wheel)
}

/// "Dead time of the bridge on wheel 2".
pub(super) fn named(id: &str, wheel: Option<usize>) -> String {
    wheel.map_or_else(|| id.to_owned(), |wheel| format!("{id} on wheel {wheel}"))
}

/// "voltage_loss_V 0.210 ± 0.030"; keys end with their unit.
pub(super) fn size(key: &str, value: f64, std: f64) -> String {
    format!("{key} {}", estimate(value, Some(std), ""))
}

fn counted(count: usize, what: &str) -> String {
    if count == 1 { format!("1 {what}") } else { format!("{count} {what}s") }
}
