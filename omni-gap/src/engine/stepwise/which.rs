//! Which: the causes with their probabilities, numbers and look-alikes.

use std::collections::BTreeMap;

use model_core::effects;

use super::candidate::Cause;
use super::found::Found;
use super::judged::Outcome;
use super::numbers::of_cause;
use super::round::{Ranked, Ranking};
use super::search::Search;
use super::settle::settle_by;
use crate::engine::findings::Which;
use crate::engine::knobs::{Knobs, LogitLine, ProbabilityKnobs};
use crate::identify::Fit;
use crate::log::RobotFile;

/// Every cause considered, most probable first, with the pseudo-causes: how probable it is that it is what explains most of the
/// gap.
///
/// ```text
/// p = (1 − p_unknown)·Σ_k s_k·p_k        p_k: among all that was tried where the k-th cause was found
///                                        s_k ∝ √(what the k-th cause earns), which grows as its size does
/// ```
///
/// What the answer says first is then as probable as answers of its kind turned out to be, and all else shares the rest.
pub(super) fn which<const N: usize>(search: &Search<N>, robot: &RobotFile, knobs: &Knobs) -> Vec<Which> {
    let known = 1.0 - unknown(search, knobs);
    // one each: an effect may be found on two wheels
    let mut all: Vec<Which> = search.found.iter().map(|found| of_found(found, search, robot)).collect();
    let size = |found: &Found| found.earns.max(0.0).sqrt();
    let all_sizes: f64 = search.found.iter().map(size).sum();
    let places: Vec<(usize, f64)> = match &search.found[..] {
        several @ [_, _, ..] if all_sizes > 0.0 => several.iter().map(|f| (f.round, size(f) / all_sizes)).collect(),
        first => vec![(first.first().map_or(0, |found| found.round), 1.0)],
    };
    for (round, share) in places {
        let found = search.found.iter().find(|found| found.round == round);
        for (entry, probability) in entries(&search.rounds[round], found, robot, knobs) {
            add(&mut all, entry, known * share * probability);
        }
    }
    add(&mut all, pseudo("unknown"), 1.0 - known);
    let calibration = &knobs.probability.calibration;
    let (said, line) = match (search.outcome, search.found.first()) {
        (Outcome::NoGap, _) => ("no_gap", &calibration.no_gap),
        (Outcome::Explained, Some(first)) => (first.cause.id(), &calibration.named),
        (Outcome::Unknown, _) | (Outcome::Explained, None) => ("unknown", &calibration.unknown),
    };
    // of equals, what is said stands first
    all.sort_by_key(|entry| entry.cause != said);
    calibrate(&mut all, line);
    all.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    all
}

/// Adds to the probability of a cause: of that at the same place, else of whichever there is.
fn add(all: &mut Vec<Which>, entry: Which, probability: f64) {
    let here = |other: &Which| other.cause == entry.cause && (other.wheel, other.axis) == (entry.wheel, entry.axis);
    let at = all.iter().position(here).or_else(|| all.iter().position(|other| other.cause == entry.cause));
    match at {
        Some(at) => all[at].probability += probability,
        None => all.push(Which { probability, ..entry }),
    }
}

/// Makes what is said, the first, as probable as a line says, but no less so than anything else, and gives all others the rest.
fn calibrate(all: &mut [Which], line: &LogitLine) {
    let Some((said, others)) = all.split_first_mut() else { return };
    let sum: f64 = others.iter().map(|entry| entry.probability).sum();
    if sum <= 0.0 {
        return;
    }
    let largest = others.iter().map(|entry| entry.probability).fold(0.0, f64::max);
    // at the least what the largest of the others has once these have the rest, p = l·(1 − p)/Σ
    said.probability = line.of(said.probability).max(largest / (sum + largest) + f64::EPSILON);
    let rest = 1.0 - said.probability;
    others.iter_mut().for_each(|entry| entry.probability *= rest / sum);
}

/// A cause that was found, with its numbers by the model with all of them.
fn of_found<const N: usize>(found: &Found, search: &Search<N>, robot: &RobotFile) -> Which {
    let alike = &found.not_told_apart_from;
    Which {
        not_told_apart_from: alike.iter().map(|c| c.id().to_owned()).collect(),
        settle_by: settle_by(&found.cause, alike),
        ..fitted(&found.cause, &search.corrected.fit, robot)
    }
}

/// All that was tried in one round with its probability; of an effect tried on several wheels only the best one. What did not
/// convince, though its score is better, counts no more than what did, or than what would just not have convinced.
fn entries<const N: usize>(
    ranking: &Ranking<N>,
    found: Option<&Found>,
    robot: &RobotFile,
    knobs: &Knobs,
) -> Vec<(Which, f64)> {
    let (scale, base) = (ranking.scale, ranking.base.score(ranking.scale));
    let ProbabilityKnobs { temperature, head_start, .. } = knobs.probability;
    let of_found = found.and_then(|found| ranking.ranked.iter().find(|r| r.cause.is(&found.cause)));
    let best = of_found.map_or(base - knobs.search.convincing, |r| r.scored.score(scale));
    let mut scored: Vec<(Which, f64)> = Vec::new();
    let is_new = |scored: &[(Which, f64)], id: &str| !scored.iter().any(|(entry, _)| entry.cause == id);
    for r in &ranking.ranked {
        if is_new(&scored, r.cause.id()) {
            scored.push((fitted(&r.cause, &r.scored.fit, robot), r.scored.score(scale).max(best)));
        }
    }
    for s in &ranking.screened {
        if is_new(&scored, s.candidate.card.id) {
            let cause = Cause::Effect(s.candidate.card, s.candidate.wheel);
            scored.push((bare(&cause), (base - s.gain.min(base) / scale + head_start).max(best)));
        }
    }
    // on top of a cause that was found, none is no answer
    if ranking.base.extra == 0 {
        scored.push((pseudo("no_gap"), base - head_start));
    }
    let least = scored.iter().map(|e| e.1).fold(f64::INFINITY, f64::min);
    let weigh = |score: f64| (-(score - least) / (2.0 * temperature)).exp();
    let total: f64 = scored.iter().map(|e| weigh(e.1)).sum();
    scored.into_iter().map(|(entry, score)| (entry, weigh(score) / total)).collect()
}

/// How likely it is that nothing in the catalogue is the cause: by how little the best model closes, and by how much more than
/// noise it misses; whichever speaks more for it.
fn unknown<const N: usize>(search: &Search<N>, knobs: &Knobs) -> f64 {
    let ProbabilityKnobs { unknown_without_gap, unknown_width, adequate, .. } = knobs.probability;
    if search.outcome == Outcome::NoGap {
        return unknown_without_gap;
    }
    let by_closed = (search.closed - knobs.outcome.least_closed) / unknown_width;
    let by_left = adequate * (1.0 - search.inadequate);
    let by_both = if search.found.iter().all(Found::is_parameter) { by_left } else { by_closed.max(by_left) };
    1.0 / (1.0 + by_both.exp())
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
    let title = effects::cause(cause.id()).map(|cause| cause.title().to_owned());
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

#[cfg(test)]
mod tests {
    use super::*;

    fn list(all: &[(&str, f64)]) -> Vec<Which> {
        all.iter().map(|(id, probability)| Which { probability: *probability, ..pseudo(id) }).collect()
    }

    fn of(all: &[Which], id: &str) -> f64 {
        all.iter().find(|entry| entry.cause == id).expect("it was there").probability
    }

    #[test]
    fn what_is_said_is_as_probable_as_answers_like_it_were_right() {
        let mut all = list(&[("creep", 0.9), ("wheel_slip", 0.06), ("unknown", 0.04)]);
        calibrate(&mut all, &LogitLine { slope: 0.5, offset: 0.0 });
        assert!((of(&all, "creep") - 0.75).abs() < 1e-12);
        assert!((all.iter().map(|entry| entry.probability).sum::<f64>() - 1.0).abs() < 1e-12);
        assert!((of(&all, "wheel_slip") / of(&all, "unknown") - 1.5).abs() < 1e-12, "the others keep their order");
    }

    #[test]
    fn an_effect_found_on_two_wheels_stands_there_twice() {
        let on = |wheel| Which { wheel: Some(wheel), ..pseudo("uneven_load") };
        let mut all = vec![on(1), on(3)];
        [(on(3), 0.2), (on(0), 0.1), (pseudo("unknown"), 0.7)]
            .into_iter()
            .for_each(|(entry, p)| add(&mut all, entry, p));
        let told: Vec<_> = all.iter().map(|entry| (entry.wheel, entry.probability)).collect();
        assert_eq!(
            told,
            [(Some(1), 0.1), (Some(3), 0.2), (None, 0.7)],
            "a wheel where it was not found counts for the first"
        );
    }

    #[test]
    fn nothing_is_more_probable_than_what_is_said() {
        let mut all = list(&[("no_gap", 0.1), ("creep", 0.8), ("unknown", 0.1)]);
        calibrate(&mut all, &LogitLine::AS_IT_IS);
        assert!(of(&all, "no_gap") >= of(&all, "creep") - 1e-12);
        assert!((all.iter().map(|entry| entry.probability).sum::<f64>() - 1.0).abs() < 1e-12);
    }
}
