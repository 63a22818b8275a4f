//! Which: the causes with their probabilities, numbers and look-alikes, and what they change in the robot file.

use std::collections::BTreeMap;

use model_core::effects::{self, CauseCard};
use model_core::plant::robot::Nominal;

use crate::identify::Fit;
use crate::log::{Change, EffectEntry, RobotFile};
use crate::rank::{Cause, Data, LEAST_CLOSED, Outcome, Ranked, Verdict};
use crate::report::{Axis, Corrected, Estimate, Kind, NextExperiment, Report, Which};
use crate::simulate::{Chain, NOMINAL_KEYS, NominalKey, Slot};

/// Score differences are worth less than their face: models are never quite right.
const TEMPERATURE: f64 = 3.0;
/// What the plain model is given, in score, against any one of many causes.
const HEAD_START: f64 = 12.0;
/// A typical effect below this many sigma of the whole recording could not have been seen.
const VISIBLE: f64 = 5.0;

/// Every cause considered, most probable first, with the pseudo-causes.
pub(super) fn which<const N: usize>(verdict: &Verdict<N>, robot: &RobotFile) -> Vec<Which> {
    let ranking = verdict.found.first().map_or(&verdict.last, |f| &f.ranking);
    let scale = ranking.scale;
    let base = ranking.base.score(scale);
    // (entry, score); of an effect tried on several wheels only the best one
    let mut entries: Vec<(Which, f64)> = Vec::new();
    for r in &ranking.ranked {
        if entries.iter().any(|(w, _)| w.cause == r.cause.id()) {
            continue;
        }
        let found = verdict.found.iter().find(|f| f.cause.same_id(&r.cause));
        // the final model knows a found cause best
        let fit = if found.is_some() { &verdict.corrected.fit } else { &r.scored.fit };
        let mut entry = entry(&r.cause, fit, robot);
        if let Some(found) = found {
            entry.not_told_apart_from = found.not_told_apart_from.iter().map(|c| c.id().to_owned()).collect();
            entry.settle_by = settle_by(&found.cause, &found.not_told_apart_from);
        }
        entries.push((entry, r.scored.score(scale)));
    }
    for found in verdict.found.iter().skip(1) {
        if !entries.iter().any(|(w, _)| w.cause == found.cause.id()) {
            entries.push((entry(&found.cause, &verdict.corrected.fit, robot), base));
        }
    }
    for s in &ranking.screened {
        if !entries.iter().any(|(w, _)| w.cause == s.candidate.card.id) {
            let cause = Cause::Effect(s.candidate.card, s.candidate.wheel);
            entries.push((bare(&cause), base - s.gain.min(base) / scale + HEAD_START));
        }
    }
    entries.push((pseudo("no_gap"), base - HEAD_START));
    let least = entries.iter().map(|e| e.1).fold(f64::INFINITY, f64::min);
    let weigh = |score: f64| (-(score - least) / (2.0 * TEMPERATURE)).exp();
    let total: f64 = entries.iter().map(|e| weigh(e.1)).sum();
    let unknown = unknown(verdict);
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
fn unknown<const N: usize>(verdict: &Verdict<N>) -> f64 {
    match verdict.outcome {
        Outcome::NoGap => 0.01,
        Outcome::Unknown => 1.0 / (1.0 + ((verdict.closed - LEAST_CLOSED) / 0.1).min(0.0).exp()).min(2.0),
        Outcome::Explained => 1.0 / (1.0 + ((verdict.closed - LEAST_CLOSED) / 0.08).exp()),
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
    let (kind, title) = match cause {
        Cause::Effect(card, _) => (Kind::Effect, Some(card.title.to_owned())),
        Cause::Parameter(_) => (Kind::Parameter, None),
    };
    let axis = cause.axis().map(|a| [Axis::V, Axis::Vn, Axis::W][a]);
    Which { kind: Some(kind), title, wheel: cause.wheel(), axis, ..pseudo(cause.id()) }
}

/// A fitted cause with its numbers.
fn entry<const N: usize>(cause: &Cause, fit: &Fit<N>, robot: &RobotFile) -> Which {
    let mut which = bare(cause);
    match cause {
        Cause::Effect(card, wheel) => {
            let Some(at) = fit.model.effects.iter().position(|e| e.id == card.id && e.wheel == *wheel) else {
                return which;
            };
            for (p, param) in card.params.iter().enumerate() {
                let estimate = Estimate {
                    value: fit.model.effects[at].params[p],
                    std: fit.std(Slot::Param(at, p)),
                    unit: param.unit.to_owned(),
                };
                which.parameters.insert(param.key.to_owned(), estimate);
            }
        }
        Cause::Parameter(release) => {
            let own = |p: &Nominal| p.cause() == release.cause && (release.axis.is_none() || release.axis == p.axis());
            for key in NOMINAL_KEYS.iter().filter(|k| k.factors.iter().any(own)) {
                let value = key.value(robot) * key.factor(&fit.model.factor);
                let std = relative_std(fit, key).map(|s| s * value);
                which.parameters.insert(key.key.to_owned(), Estimate { value, std, unit: key.unit.to_owned() });
            }
        }
    }
    which
}

/// Relative uncertainty of a nominal number after a fit, its factors' correlation left aside.
fn relative_std<const N: usize>(fit: &Fit<N>, key: &NominalKey) -> Option<f64> {
    let mut variance = 0.0;
    for p in key.factors {
        variance += (fit.std(Slot::Nominal(*p))? / fit.model.factor[*p as usize]).powi(2);
    }
    Some(variance.sqrt())
}

/// The measurement that would settle what is open: from the card of either, else for a nominal value by name.
fn settle_by(cause: &Cause, alike: &[Cause]) -> Option<String> {
    let from_card = |a: &Cause, b: &Cause| match a {
        Cause::Effect(card, _) => card.look_alikes.iter().find(|l| l.with == b.id()).map(|l| l.settled_by.to_owned()),
        Cause::Parameter(_) => None,
    };
    let other = alike.first()?;
    let named = from_card(cause, other).or_else(|| from_card(other, cause));
    Some(named.unwrap_or_else(|| {
        let of = |id: &str| match effects::cause(id) {
            Some(CauseCard::Nominal(card)) => card.settled_by,
            _ => "repeat the runs with stronger motion on all three axes",
        };
        let mut how: Vec<&str> = [cause, other].iter().map(|c| of(c.id())).collect();
        how.dedup();
        how.join("; ")
    }))
}

/// The best fitted cause that is neither found nor a look-alike of one that was.
pub(super) fn runner_up<const N: usize>(verdict: &Verdict<N>) -> Option<&Ranked<N>> {
    let first = verdict.found.first()?;
    first
        .ranking
        .ranked
        .iter()
        .find(|r| !r.cause.same_id(&first.cause) && !first.not_told_apart_from.iter().any(|c| c.same_id(&r.cause)))
}

/// The robot file's numbers before and after.
pub(super) fn parameters<const N: usize>(verdict: &Verdict<N>, robot: &RobotFile) -> Vec<Corrected> {
    let fit = &verdict.reported().fit;
    let mut rows: Vec<Corrected> = NOMINAL_KEYS
        .iter()
        .map(|key| {
            let nominal = key.value(robot);
            let corrected = nominal * key.factor(&fit.model.factor);
            Corrected {
                key: format!("{}.{}", key.table, key.key),
                unit: key.unit.to_owned(),
                nominal: Some(nominal),
                nominal_std: robot.relative_uncertainty(key.key).map(|s| s * nominal),
                corrected,
                std: relative_std(fit, key).map(|s| s * corrected),
            }
        })
        .collect();
    for (at, effect) in fit.model.effects.iter().enumerate() {
        for (p, param) in effect.card().params.iter().enumerate() {
            let place = effect.wheel.map_or(String::new(), |j| format!(" (wheel {j})"));
            rows.push(Corrected {
                key: format!("effects.{}.{}{place}", effect.id, param.key),
                unit: param.unit.to_owned(),
                nominal: None,
                nominal_std: None,
                corrected: effect.params[p],
                std: fit.std(Slot::Param(at, p)),
            });
        }
    }
    rows
}

/// What the causes change in the robot file: the fitted model, written in.
pub(super) fn changes<const N: usize>(verdict: &Verdict<N>, robot: &RobotFile) -> Vec<Change> {
    let model = &verdict.reported().fit.model;
    let mut changes: Vec<Change> =
        NOMINAL_KEYS.iter().flat_map(|key| key.scaled(robot, key.factor(&model.factor))).collect();
    for effect in &model.effects {
        let params = effect.card().params.iter().zip(&effect.params).map(|(p, x)| (p.key.to_owned(), *x)).collect();
        changes.push(Change::Effect(EffectEntry { id: effect.id.to_owned(), wheel: effect.wheel, params }));
    }
    changes
}

/// What this recording could not have shown.
pub(super) fn not_seen<const N: usize>(verdict: &Verdict<N>, data: &Data<'_, N>) -> Vec<String> {
    let mut lines = Vec::new();
    let missing = |group: &str| !data.fit.iter().any(|run| run.has_group(group));
    let by_speed = matches!(data.fit[0].chain, Chain::WheelSpeed | Chain::SetSpeed);
    if by_speed {
        lines.push(
            "voltages, currents and forces: the model is driven by wheel speeds and says nothing of them".to_owned(),
        );
    } else if missing("i") {
        lines.push("the electrical stage by itself: no current to compare is logged".to_owned());
    }
    if missing("w") {
        lines.push("slip and drivetrain apart from the body: no measured wheel speed to compare".to_owned());
    }
    if missing("pose") {
        lines.push("the contact and the camera: no pose is logged".to_owned());
    }
    let screened = &verdict.found.first().map_or(&verdict.last, |f| &f.ranking).screened;
    let mut named: Vec<&str> = Vec::new();
    for effect in effects::catalogue::<f64>() {
        let card = effect.card();
        let best = screened.iter().filter(|s| s.candidate.card.id == card.id).map(|s| s.visible).fold(0.0, f64::max);
        let tried = screened.iter().any(|s| s.candidate.card.id == card.id);
        if tried && best < VISIBLE && !named.contains(&card.id) {
            named.push(card.id);
            lines
                .push(format!("{}: at its typical size it would move these recordings by {best:.1} σ in all", card.id));
        }
    }
    lines
}

/// What to do next, where something is open.
pub(super) fn next_experiment(report: &Report) -> Option<NextExperiment> {
    let open = report.which.iter().find(|w| report.causes.contains(&w.cause) && !w.not_told_apart_from.is_empty())?;
    let tells_apart = std::iter::once(open.cause.clone()).chain(open.not_told_apart_from.clone()).collect();
    Some(NextExperiment { why: open.settle_by.clone().unwrap_or_default(), tells_apart, file: None })
}

/// The stage of a cause.
pub(super) fn stage_of(id: &str) -> crate::report::Stage {
    effects::cause(id).map_or(crate::report::Stage::Body, |cause| cause.stage().into())
}
