//! How sensitivities are written.

use crate::report::number::num;
use crate::simulate::{AxisSensitivity, Influence};

/// A sensitivity that is shown as zero [1]
const NOTHING: f64 = 0.005;

/// A sensitivity with its sign.
pub(super) fn signed(x: f64) -> String {
    if x.abs() < NOTHING { "0".into() } else { format!("{x:+.2}").replace('-', "−") }
}

/// Those that count and, by key, those that do not.
pub(super) fn split(axis: &AxisSensitivity) -> (Vec<&Influence>, Vec<&'static str>) {
    let counts = |i: &&Influence| {
        [i.speed, i.distance, i.final_speed.unwrap_or(0.0)].into_iter().any(|slope| slope.abs() >= NOTHING)
    };
    let (some, none): (Vec<_>, Vec<_>) = axis.influences.iter().partition(counts);
    (some, none.into_iter().map(|i| i.key).collect())
}

/// A number without zeros that say nothing.
pub(super) fn short(x: f64) -> String {
    let text = num(if x.abs() < 1e-9 { 0.0 } else { x });
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}
