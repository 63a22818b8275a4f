//! An answer beside what is known: right, partly right or wrong.
//!
//! Right: the verdict is one that may be, and, where it names causes, those that are required are named, none that cannot
//! be is, and the stage with the largest share may be it. A cause counts as named too where the answer says that it cannot
//! tell it from one that it names. Partly: the verdict may be right, or a required cause is named or among the three most
//! probable; and no cause that cannot be is named with a probability of [`SURE`] or more. Wrong: all else.

use omni_gap::Verdict;
use omni_gap::report::{Report, percent};

use super::known::Known;
use crate::catalogue::page::word;

/// From this probability on an answer is sure of itself.
pub const SURE: f64 = 0.8;

/// How many of the most probable causes are looked at.
const MOST_PROBABLE: usize = 3;

/// How an answer fits what is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Score {
    /// Nothing known speaks against it.
    Right,
    /// Something in it is right.
    Partly,
    /// It contradicts what is known.
    Wrong,
}

/// An answer, scored.
#[derive(Clone, Debug, PartialEq)]
pub struct Scored {
    /// How it fits.
    pub score: Score,
    /// Probability that the answer gives to its first cause, or to the verdict that stands for one; none where it gives none.
    pub confidence: Option<f64>,
    /// What speaks against it.
    pub against: Vec<String>,
}

impl Scored {
    /// True of an answer that is wrong and sure of itself.
    pub fn is_wrong_and_sure(&self) -> bool {
        self.score == Score::Wrong && self.confidence.is_some_and(|p| p >= SURE)
    }
}

/// Scores an answer.
pub fn scored(known: &Known, report: &Report) -> Scored {
    let allowed = known.verdicts.contains(&report.verdict);
    let mut against = Vec::new();
    if !allowed {
        against.push(format!("the verdict `{}` cannot be", word(report.verdict)));
    }
    let named = named(report);
    if matches!(report.verdict, Verdict::Effect | Verdict::Parameter) {
        let missing = |cause: &String| !named.contains(&cause.as_str());
        let required = &known.causes_required;
        against.extend(required.all_of.iter().filter(|c| missing(c)).map(|cause| format!("`{cause}` is not named")));
        let groups = required.any_of.iter().filter(|group| group.iter().all(missing));
        against.extend(groups.map(|group| format!("none of {} is named", quoted(group))));
    }
    let impossible = report.causes.iter().filter_map(|cause| Some((cause, known.impossible(cause)?)));
    let impossible: Vec<(&String, &str)> = impossible.collect();
    against.extend(impossible.iter().map(|(cause, why)| format!("`{cause}` cannot be: {why}")));
    let first = report.where_.iter().max_by(|a, b| a.share.total_cmp(&b.share)).map(|place| place.stage.name());
    let open = known.stages.is_empty() || report.verdict == Verdict::NoGap;
    if let Some(stage) = first.filter(|stage| !open && !known.stages.iter().any(|s| s == stage)) {
        against.push(format!("the gap does not lie in the stage {stage}"));
    }
    let surely_impossible =
        impossible.iter().any(|(cause, _)| report.cause(cause).is_none_or(|which| which.probability >= SURE));
    let score = match (against.is_empty(), allowed || hints(known, report, &named), surely_impossible) {
        (true, ..) => Score::Right,
        (false, true, false) => Score::Partly,
        _ => Score::Wrong,
    };
    Scored { score, confidence: confidence(report), against }
}

/// The causes that an answer names, with those that it cannot tell from them.
fn named(report: &Report) -> Vec<&str> {
    let same = report.which.iter().filter(|which| report.causes.contains(&which.cause));
    let same = same.flat_map(|which| &which.not_told_apart_from);
    report.causes.iter().chain(same).map(String::as_str).collect()
}

/// True where a required cause is named, or among the most probable ones.
fn hints(known: &Known, report: &Report, named: &[&str]) -> bool {
    let probable: Vec<&str> = report.which.iter().take(MOST_PROBABLE).map(|which| which.cause.as_str()).collect();
    known.causes_required.causes().any(|c| named.contains(&c.as_str()) || probable.contains(&c.as_str()))
}

fn confidence(report: &Report) -> Option<f64> {
    let first = report.causes.first().map(String::as_str).unwrap_or(word(report.verdict));
    report.cause(first).or(report.which.first()).map(|which| which.probability)
}

fn quoted(causes: &[String]) -> String {
    causes.iter().map(|cause| format!("`{cause}`")).collect::<Vec<_>>().join(", ")
}

/// A row of the table: score, how sure the answer is, and what speaks against it.
pub fn row(scored: &Scored) -> [String; 3] {
    let score = match (scored.score, scored.is_wrong_and_sure()) {
        (Score::Right, _) => "right",
        (Score::Partly, _) => "partly",
        (Score::Wrong, false) => "wrong",
        (Score::Wrong, true) => "**wrong, and sure of it**",
    };
    let against = if scored.against.is_empty() { "–".to_owned() } else { scored.against.join("; ") };
    [score.to_owned(), scored.confidence.map_or("–".to_owned(), percent), against]
}

#[cfg(test)]
mod tests;
