//! A cause of the self-test in phrases.

use crate::engine::findings::{Rival, SeenCause};
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

/// The heads of the table.
pub(super) const HEADS: [&str; 6] =
    ["", "typical", "moves by", "seen from", "named from", "not told from, at that size"];

/// A line of the table.
pub(super) fn line(cause: &SeenCause) -> [String; 6] {
    [
        name(cause),
        size(Some(cause.typical), cause),
        format!("{} σ", num(cause.sigma)),
        from(cause.seen_from, cause),
        from(cause.named_from, cause),
        rivals(&cause.rivals),
    ]
}
