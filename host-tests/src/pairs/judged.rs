//! What `compare` answers to a pair, held to what was put into it.

use std::time::Instant;

use omni_gap::comparison::{Comparison, ComparisonVerdict, Difference, Options, compare};

use super::kinds::{PairKind, RecordedPair};

/// An answer, judged.
#[derive(Clone, Debug)]
pub struct JudgedPair {
    /// The answer; none where a side is no evidence.
    pub answer: Option<Comparison>,
    /// Whether what differs is named first, at its wheel, or nothing is where nothing does.
    pub named_first: bool,
    /// Whether what differs is among what is named.
    pub named: bool,
    /// Its size as told, over the true one [1].
    pub size: Option<f64>,
    /// How long it took [s]
    pub seconds: f64,
}

/// Asks `compare`.
pub fn judged(pair: &RecordedPair) -> JudgedPair {
    let start = Instant::now();
    let answer = compare(&pair.a, &pair.b, &Options::default()).ok().map(|compared| compared.comparison);
    let seconds = start.elapsed().as_secs_f64();
    let causes: &[Difference] = answer.as_ref().map_or(&[], |answer| &answer.causes);
    let is_it = |difference: &&Difference| {
        accepted(pair.kind).contains(&difference.cause.as_str()) && difference.wheel == pair.wheel
    };
    let alike = answer.as_ref().is_some_and(|answer| answer.verdict == ComparisonVerdict::Alike);
    let nothing = pair.kind == PairKind::Nothing;
    let named = if nothing { alike } else { causes.iter().any(|d| is_it(&d)) };
    let named_first = if nothing { alike } else { causes.first().as_ref().is_some_and(is_it) };
    let size = causes.iter().find(is_it).and_then(|difference| size(pair, difference));
    JudgedPair { answer, named_first, named, size, seconds }
}

/// The names under which it may be answered.
fn accepted(kind: PairKind) -> &'static [&'static str] {
    match kind {
        PairKind::Nothing => &[],
        PairKind::Mass => &["mass"],
        PairKind::Motor => &["motor_mismatch"],
        PairKind::Floor => &["coulomb_friction", "viscous_friction"],
        PairKind::Latency => &["camera_latency"],
        PairKind::DeadTime => &["dead_time"],
    }
}

/// The change as told, over the true one; of friction, which differs by the same share on every axis, of what is told first.
fn size(pair: &RecordedPair, difference: &Difference) -> Option<f64> {
    let number = difference.numbers.first()?;
    let told = match pair.kind {
        PairKind::Floor => {
            // more than plain by a share of it, whichever side has it
            let plain = if pair.change > 0.0 { number.a.value } else { number.b.value };
            number.change.value / plain
        }
        PairKind::Mass | PairKind::Motor | PairKind::Latency | PairKind::DeadTime | PairKind::Nothing => {
            number.change.value
        }
    };
    Some(told / pair.change)
}
