//! The sentences that terminal and page share. Each is made of fields of the report.

use super::model::{Against, ComparisonReport};
use crate::comparison::{AlignedBy, ComparisonVerdict, Difference, GapCompared, NumberCompared};
use crate::engine::findings::{Estimate, SignalGap};
use crate::report::number::{NBSP, estimate, figures, num, percent};
use crate::report::phrases::{group, list, place, spot};
use crate::simulate::SignalGroup;
use crate::vocabulary::Kind;

/// The verdict as one sentence.
pub fn headline(report: &ComparisonReport) -> String {
    let found = &report.comparison;
    let simulator = report.against == Against::Simulator;
    match found.verdict {
        ComparisonVerdict::Different if simulator => {
            let (wrong, missing): (Vec<_>, Vec<_>) = found.causes.iter().partition(|d| d.kind == Kind::Parameter);
            let missing = (!missing.is_empty()).then(|| format!("The simulator leaves out: {}.", named(&missing)));
            let wrong = (!wrong.is_empty()).then(|| format!("Its numbers are not the robot’s: {}.", named(&wrong)));
            missing.into_iter().chain(wrong).collect::<Vec<_>>().join(" ")
        }
        ComparisonVerdict::Different => {
            format!("B differs from A in: {}.", named(&found.causes.iter().collect::<Vec<_>>()))
        }
        ComparisonVerdict::Alike if simulator => {
            "The simulator does what the robot does: nothing differs by more than its uncertainty.".into()
        }
        ComparisonVerdict::Alike => "Alike: nothing differs by more than its uncertainty.".into(),
        ComparisonVerdict::Unknown => {
            let most = found.where_.iter().max_by(|a, b| a.share.total_cmp(&b.share));
            let lies = most.map(|w| format!(" It lies mostly in {}.", place(w))).unwrap_or_default();
            format!("The two differ, and nothing in the catalogue explains it.{lies}")
        }
        ComparisonVerdict::UnfitData => match report.faults.len() {
            1 => "These logs are not fit for a comparison: mend one fault first.".into(),
            n => format!("These logs are not fit for a comparison: mend {n} faults first."),
        },
    }
}

/// The verdict's name in a heading.
pub fn verdict(verdict: ComparisonVerdict) -> &'static str {
    match verdict {
        ComparisonVerdict::Different => "different",
        ComparisonVerdict::Alike => "alike",
        ComparisonVerdict::Unknown => "unknown",
        ComparisonVerdict::UnfitData => "unfit data",
    }
}

/// "Mass, and Dead time of the bridge at wheel 2"
fn named(causes: &[&Difference]) -> String {
    let name = |d: &&Difference| {
        let at = spot(d.wheel, d.axis).replacen(", ", " at ", 1);
        format!("{}{at}", d.title)
    };
    list(&causes.iter().map(name).collect::<Vec<_>>())
}

/// How the two were laid over each other.
pub fn aligned(report: &ComparisonReport) -> &'static str {
    match report.comparison.aligned_by {
        AlignedBy::Input => "both were driven by the same inputs, row by row",
        AlignedBy::Model => "their inputs differ: A’s model, driven by B’s inputs, is laid over B",
    }
}

/// "body.mass_kg 2.340 ± 0.010 → 2.930 ± 0.020 kg, +0.590 ± 0.018 kg (25 %)"
pub fn changed(number: &NumberCompared) -> String {
    let NumberCompared { key, a, b, .. } = number;
    let [from, to] = [a, b].map(|x| estimate(x.value, x.std, &x.unit));
    format!("{key} {from} → {to}, {}", change(number))
}

/// "+0.590 ± 0.018 kg (+25 %)"
pub fn change(number: &NumberCompared) -> String {
    let Estimate { value, std, unit } = &number.change;
    let share = share(number);
    let share = if share.is_empty() { share } else { format!(" ({share})") };
    format!("{}{}{share}", plus(*value), estimate(*value, *std, unit))
}

/// "+25 %", of A's value; empty where that is not plainly away from zero, or the change below a thousandth of it.
pub fn share(number: &NumberCompared) -> String {
    let share = number.change.value / number.a.value.abs();
    if !number.is_share_telling() || share.abs() < LEAST_SHARE {
        return String::new();
    }
    format!("{}{}", plus(share), percent(share))
}

/// A change of less than this of a number is not told as a share [1].
const LEAST_SHARE: f64 = 1e-3;

fn plus(x: f64) -> &'static str {
    if x > 0.0 { "+" } else { "" }
}

/// "37", of the change's standard errors
pub fn errors(number: &NumberCompared) -> String {
    figures(number.errors, 2)
}

/// The change from which on it would have counted.
pub fn seen_from(report: &ComparisonReport, number: &NumberCompared) -> String {
    let unit = if number.change.unit == "1" { String::new() } else { format!("{NBSP}{}", number.change.unit) };
    number.change.std.map_or("–".into(), |std| num(std * report.comparison.knobs.changed_errors) + &unit)
}

/// What to write into a simulator so that it does what the robot does: a line for each number.
pub fn lines_to_change(report: &ComparisonReport) -> Vec<String> {
    if report.against == Against::Recordings {
        return Vec::new();
    }
    let line = |d: &Difference| {
        let at = spot(d.wheel, None);
        let of = |n: &NumberCompared| {
            let to = estimate(n.b.value, n.b.std, &n.b.unit);
            match d.kind {
                Kind::Parameter => format!("{}: set {to}; the simulator behaves as with {}", n.key, num(n.a.value)),
                Kind::Effect => format!("{}{at}: {} {to}; in the simulator {}", d.title, n.key, num(n.a.value)),
            }
        };
        d.numbers.iter().filter(|n| n.changed).map(of).collect::<Vec<_>>()
    };
    report.comparison.causes.iter().flat_map(line).collect()
}

/// The groups of signals that both sides have, in their order, with what bars show of B.
pub fn groups(report: &ComparisonReport) -> Vec<(&'static str, GapCompared)> {
    let of = |g: SignalGroup| Some((g.name(), *report.comparison.gap.get(g.name())?));
    SignalGroup::ALL.into_iter().filter_map(of).collect()
}

/// B's error by A's model, and by that with what differs.
pub fn bars_of_b(report: &ComparisonReport) -> Vec<(&'static str, SignalGap)> {
    let of = |(name, gap): (&'static str, GapCompared)| {
        (group(name), SignalGap { before: gap.b, after: gap.b_explained, noise_floor: gap.b_noise_floor })
    };
    groups(report).into_iter().map(of).collect()
}

/// What both have in common beside the robot file; none where that is nothing.
pub fn in_common(report: &ComparisonReport) -> Option<String> {
    let ids = &report.comparison.explained_in_a;
    (!ids.is_empty()).then(|| format!("A itself shows, beside its robot file: {}.", list(ids)))
}
