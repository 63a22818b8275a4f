//! A cause of the self-test in phrases.

use crate::engine::findings::{Imitating, Rival, SeenCause};
use crate::report::number::num;
use crate::vocabulary::Kind;

/// Rivals that a line of the table names.
const NAMED_RIVALS: usize = 3;

/// A cause and, of friction that is wrong on one axis, which.
pub(super) fn name(cause: &SeenCause) -> String {
    match (cause.axis, cause.wheel) {
        (Some(axis), _) => format!("{} ({})", cause.cause, axis.symbol()),
        (None, Some(wheel)) => format!("{} (wheel {wheel})", cause.cause),
        (None, None) => cause.cause.to_owned(),
    }
}

/// A size in its unit, or that there is none within bounds.
fn size(x: Option<f64>, cause: &SeenCause) -> String {
    match (x, cause.kind) {
        (None, _) => "not".to_owned(),
        (Some(x), Kind::Parameter) => format!("{} %", num(100.0 * x)),
        (Some(x), _) if cause.unit == "1" => num(x),
        (Some(x), _) => format!("{} {}", num(x), cause.unit),
    }
}

fn rivals(all: &[Rival]) -> String {
    let one = |rival: &Rival| format!("{} {}°", rival.cause, num(rival.angle_rad.to_degrees()));
    let mut said: Vec<String> = all.iter().take(NAMED_RIVALS).map(one).collect();
    if all.len() > NAMED_RIVALS {
        said.push(format!("{} more", all.len() - NAMED_RIVALS));
    }
    said.join(", ")
}

/// From where on, or up to where, it shows.
fn from(x: Option<f64>, cause: &SeenCause) -> String {
    let below = if x.is_some() && cause.shows_below { "up to " } else { "" };
    format!("{below}{}", size(x, cause))
}

/// Numbers that a line of the hidden names.
const NAMED_NUMBERS: usize = 4;

/// True if it is not seen because numbers of the robot imitate it.
pub(super) fn is_hidden(cause: &SeenCause) -> bool {
    cause.kind == Kind::Effect && !cause.is_seen() && !cause.imitated_by.is_empty()
}

/// What a hidden cause looks like, and which number would show it.
pub(super) fn hidden(cause: &SeenCause) -> String {
    let numbers = &cause.imitated_by;
    let mut largest: Vec<_> = numbers.iter().collect();
    largest.sort_by(|a, b| b.by.abs().total_cmp(&a.by.abs()));
    let moved = |number: &&Imitating| {
        let by = 100.0 * number.by;
        format!("{} {}{} %", number.number, if by < 0.0 { "−" } else { "+" }, num(by.abs()))
    };
    let moved: Vec<String> = largest.iter().take(NAMED_NUMBERS).map(moved).collect();
    let shown: Vec<&str> = numbers.iter().filter(|number| number.then_seen).map(|number| number.number).collect();
    let shown = match &shown[..] {
        [] => "no number alone would show it, were it known exactly".to_owned(),
        shown => format!("seen if this were known exactly: {}", shown.join(" or ")),
    };
    format!("{} at its typical size looks like {}; {shown}", name(cause), moved.join(", "))
}

/// The heads of the table, with a column for what was verified or without.
pub(super) fn heads(verified: bool) -> Vec<&'static str> {
    let simulated = verified.then_some("seen, simulated");
    let first = ["", "typical", "moves by", "seen from"];
    first.into_iter().chain(simulated).chain(["named from", "not told from, at that size"]).collect()
}

/// A line of the table, under the same heads.
pub(super) fn line(cause: &SeenCause, verified: bool) -> Vec<String> {
    let first = [
        name(cause),
        size(Some(cause.typical), cause),
        format!("{} σ", num(cause.sigma)),
        from(cause.seen_from, cause),
    ];
    let simulated = verified.then(|| cause.verified.map_or("–".to_owned(), |size| from(size.from, cause)));
    first.into_iter().chain(simulated).chain([from(cause.named_from, cause), rivals(&cause.rivals)]).collect()
}
