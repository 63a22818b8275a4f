//! One answer: a report's parts do not contradict each other.

use omni_gap::Verdict;
use omni_gap::report::Report;

/// By how much probabilities may miss 1 [1].
const ROUNDED: f64 = 1e-9;

/// What contradicts what in a report, in words; nothing where it is one answer.
pub fn contradictions(report: &Report) -> Vec<String> {
    let mut all = Vec::new();
    let mut hold = |holds: bool, what: String| {
        if !holds {
            all.push(what);
        }
    };
    let named = matches!(report.verdict, Verdict::Effect | Verdict::Parameter);
    hold(named != report.causes.is_empty(), format!("{:?} with the causes {:?}", report.verdict, report.causes));
    if report.verdict == Verdict::UnfitData {
        return all;
    }
    let sum: f64 = report.which.iter().map(|entry| entry.probability).sum();
    hold((sum - 1.0).abs() < ROUNDED, format!("the probabilities sum to {sum}"));
    let said = match report.verdict {
        Verdict::NoGap => "no_gap",
        Verdict::Unknown => "unknown",
        _ => report.causes.first().map_or("", String::as_str),
    };
    let first = report.which.first().map_or("", |entry| entry.cause.as_str());
    hold(first == said, format!("the answer is {said}, and the most probable is {first}"));
    for cause in &report.causes {
        let probability = report.which.iter().find(|entry| entry.cause == *cause).map(|entry| entry.probability);
        hold(probability.is_some_and(|p| p > 0.0), format!("{cause} is named, with a probability of {probability:?}"));
    }
    all
}
