//! Which: the causes with their probabilities, numbers and look-alikes.

use std::collections::BTreeMap;

use super::candidate::Cause;
use super::numbers::of_cause;
use super::round::Ranked;
use super::search::{Outcome, Search};
use super::settle::settle_by;
use crate::engine::findings::Which;
use crate::engine::knobs::{Knobs, ProbabilityKnobs};
use crate::identify::Fit;
use crate::log::RobotFile;

/// Every cause considered, most probable first, with the pseudo-causes.
pub(super) fn which<const N: usize>(search: &Search<N>, robot: &RobotFile, knobs: &Knobs) -> Vec<Which> {
    let ProbabilityKnobs { temperature, head_start, .. } = knobs.probability;
    let ranking = &search.rounds[0];
    let scale = ranking.scale;
    let base = ranking.base.score(scale);
    // (entry, score); of an effect tried on several wheels only the best one
    let mut entries: Vec<(Which, f64)> = Vec::new();
    for r in &ranking.ranked {
        if entries.iter().any(|(w, _)| w.cause == r.cause.id()) {
            continue;
        }
        let found = search.found.iter().find(|f| f.cause.same_id(&r.cause));
        // the final model knows a found cause best
        let fit = if found.is_some() { &search.corrected.fit } else { &r.scored.fit };
        let mut entry = fitted(&r.cause, fit, robot);
        if let Some(found) = found {
            entry.not_told_apart_from = found.not_told_apart_from.iter().map(|c| c.id().to_owned()).collect();
            entry.settle_by = settle_by(&found.cause, &found.not_told_apart_from);
        }
        entries.push((entry, r.scored.score(scale)));
    }
    for found in search.found.iter().skip(1) {
        if !entries.iter().any(|(w, _)| w.cause == found.cause.id()) {
            entries.push((fitted(&found.cause, &search.corrected.fit, robot), base));
        }
    }
    for s in &ranking.screened {
        if !entries.iter().any(|(w, _)| w.cause == s.candidate.card.id) {
            let cause = Cause::Effect(s.candidate.card, s.candidate.wheel);
            entries.push((bare(&cause), base - s.gain.min(base) / scale + head_start));
        }
    }
    entries.push((pseudo("no_gap"), base - head_start));
    let least = entries.iter().map(|e| e.1).fold(f64::INFINITY, f64::min);
    let weigh = |score: f64| (-(score - least) / (2.0 * temperature)).exp();
    let total: f64 = entries.iter().map(|e| weigh(e.1)).sum();
    let unknown = unknown(search, knobs);
    let mut which: Vec<Which> = entries
        .into_iter()
        .map(|(mut w, score)| {
            w.probability = (1.0 - unknown) * weigh(score) / total;
            w
        })
        .collect();
    which.push(Which { probability: unknown, ..pseudo("unknown") });
    which.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    which
}

/// How likely it is that nothing in the catalogue is the cause: by how little the best model closes.
fn unknown<const N: usize>(search: &Search<N>, knobs: &Knobs) -> f64 {
    let ProbabilityKnobs { unknown_without_gap, unknown_width_explained, unknown_width_unknown, .. } =
        knobs.probability;
    let beyond = search.closed - knobs.outcome.least_closed;
    match search.outcome {
        Outcome::NoGap => unknown_without_gap,
        Outcome::Unknown => 1.0 / (1.0 + (beyond / unknown_width_unknown).min(0.0).exp()).min(2.0),
        Outcome::Explained => 1.0 / (1.0 + (beyond / unknown_width_explained).exp()),
    }
}

fn pseudo(id: &str) -> Which {
    Which {
        cause: id.to_owned(),
        title: None,
        kind: None,
        probability: 0.0,
        wheel: None,
        axis: None,
        parameters: BTreeMap::new(),
        not_told_apart_from: Vec::new(),
        settle_by: None,
    }
}

fn bare(cause: &Cause) -> Which {
    let title = match cause {
        Cause::Effect(card, _) => Some(card.title.to_owned()),
        Cause::Parameter(_) => None,
    };
    Which { kind: Some(cause.kind()), title, wheel: cause.wheel(), axis: cause.axis(), ..pseudo(cause.id()) }
}

/// A fitted cause with its numbers.
fn fitted<const N: usize>(cause: &Cause, fit: &Fit<N>, robot: &RobotFile) -> Which {
    Which { parameters: of_cause(cause, fit, robot), ..bare(cause) }
}

/// The best fitted cause that is neither found nor a look-alike of one that was.
pub(super) fn runner_up<const N: usize>(search: &Search<N>) -> Option<&Ranked<N>> {
    let first = search.found.first()?;
    search.rounds[first.round]
        .ranked
        .iter()
        .find(|r| !r.cause.same_id(&first.cause) && !first.not_told_apart_from.iter().any(|c| c.same_id(&r.cause)))
}
