//! Which numbers changed beyond their uncertainty, which did not, and to which cause they belong.

use model_core::effects::{self, card::Role};
use model_core::plant::robot::Nominal;

use super::answer::{Difference, NumberCompared};
use super::common::{Common, Judged};
use super::common_number::{CommonNumber, NumberOf};
use super::known::explaining;
use super::options::ComparisonKnobs;
use super::paired::Change;
use crate::engine::findings::{Estimate, Findings, Which};
use crate::log::RobotFile;
use crate::simulate::NOMINAL_KEYS;
use crate::vocabulary::{Axis, Kind};

/// What differs.
#[derive(Debug)]
pub(super) struct Differences {
    /// The causes.
    pub causes: Vec<Difference>,
    /// Every number.
    pub numbers: Vec<NumberCompared>,
}

/// Where a cause of the common model sits.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Place {
    id: &'static str,
    wheel: Option<usize>,
}

fn place_of(number: &CommonNumber) -> Place {
    match number.of {
        NumberOf::File(p) => Place { id: p.cause(), wheel: None },
        NumberOf::Effect { card, wheel, .. } => Place { id: card.id, wheel },
    }
}

/// Whether the engine names a cause for B that speaks of this number.
fn named(number: &CommonNumber, found: &Findings) -> bool {
    let speaks = |which: &&Which| match number.of {
        NumberOf::File(p) => {
            which.kind == Some(Kind::Parameter)
                && which.cause == p.cause()
                && which.axis.is_none_or(|axis| p.axis().is_some_and(|own| Axis::ALL[own] == axis))
        }
        NumberOf::Effect { card, wheel, .. } => which.cause == card.id && which.wheel == wheel,
    };
    found.which.iter().filter(|which| found.causes.contains(&which.cause)).any(|which| speaks(&which))
}

/// Takes up what the engine names of B where the two sides differ in it, then whatever else differs beyond its uncertainty, the
/// surest first; and lays every number of A beside that of B.
pub(super) fn differences(judged: &Judged<'_>, common: &Common, knobs: &ComparisonKnobs) -> Differences {
    let Common { numbers, pair } = common;
    let named = (0..numbers.len()).filter(|k| named(&numbers[*k], judged.b)).collect();
    let mut changing = confirmed(named, common, knobs.confirmed_errors);
    let alone = |changing: &[usize], k: usize| -> Option<Change> {
        let others = changing.iter().copied().filter(|other| *other != k);
        pair.changes(&others.chain([k]).collect::<Vec<_>>())?.pop()
    };
    loop {
        let others = (0..numbers.len()).filter(|k| !changing.contains(k) && numbers[*k].is_size());
        let surest = others.filter_map(|k| alone(&changing, k)).max_by(|a, b| a.errors().total_cmp(&b.errors()));
        match surest.filter(|change| change.errors() > knobs.changed_errors) {
            Some(change) => changing.push(change.slot),
            None => break,
        }
    }
    let changing = confirmed(changing, common, knobs.confirmed_errors);
    let told: Vec<Option<Change>> = (0..numbers.len()).map(|k| alone(&changing, k)).collect();
    let changed = |k: usize, change: &Change| changing.contains(&k) && change.errors() > knobs.confirmed_errors;
    let rows = |keep: &dyn Fn(usize) -> bool| -> Vec<NumberCompared> {
        let kept = (0..numbers.len()).filter(|k| keep(*k));
        kept.filter_map(|k| row(judged.file, &numbers[k], &told[k]?, (common, changed(k, &told[k]?)))).collect()
    };
    let mut surest_first = changing.clone();
    surest_first.sort_by(|a, b| {
        let errors = |k: usize| told[k].map_or(0.0, |change| change.errors());
        errors(*b).total_cmp(&errors(*a))
    });
    let mut places: Vec<Place> = Vec::new();
    for k in surest_first {
        let place = place_of(&numbers[k]);
        if !places.contains(&place) {
            places.push(place);
        }
    }
    let causes = places
        .into_iter()
        .filter_map(|place| {
            let of = |k: usize| changing.contains(&k) && place_of(&numbers[k]) == place;
            let own: Vec<&CommonNumber> = (0..numbers.len()).filter(|k| of(*k)).map(|k| &numbers[k]).collect();
            difference(place, &own, rows(&of), judged.b)
        })
        .chain(there_or_not(judged))
        .collect();
    Differences { causes, numbers: rows(&|_| true) }
}

/// The numbers of those causes that differ by more than so many errors: one that both sides have to the same extent is no
/// difference.
fn confirmed(mut changing: Vec<usize>, common: &Common, errors: f64) -> Vec<usize> {
    while let Some(found) = common.pair.changes(&changing) {
        let place = |k: usize| place_of(&common.numbers[k]);
        let differs = |k: &usize| found.iter().any(|c| place(c.slot) == place(*k) && c.errors() > errors);
        let kept: Vec<usize> = changing.iter().copied().filter(differs).collect();
        if kept.len() == changing.len() {
            break;
        }
        changing = kept;
    }
    changing
}

/// Effects without a size that the engine names of B and A's model lacks.
fn there_or_not(judged: &Judged<'_>) -> Vec<Difference> {
    let in_a = &explaining(judged.a).effects;
    let sizeless = |which: &&Which| match effects::cause(&which.cause) {
        Some(effects::CauseCard::Effect(card)) => card.params.iter().all(|p| p.role != Role::Size),
        _ => false,
    };
    let new = |which: &&Which| !in_a.iter().any(|e| e.id == which.cause && e.wheel == which.wheel);
    let named = judged.b.which.iter().filter(|which| judged.b.causes.contains(&which.cause));
    named
        .filter(sizeless)
        .filter(new)
        .filter_map(|which| {
            let id = effects::cause(&which.cause)?.id();
            difference(Place { id, wheel: which.wheel }, &[], Vec::new(), judged.b)
        })
        .collect()
}

fn difference(
    place: Place,
    own: &[&CommonNumber],
    numbers: Vec<NumberCompared>,
    found: &Findings,
) -> Option<Difference> {
    let card = effects::cause(place.id)?;
    let which = found.which.iter().find(|w| w.cause == place.id && w.wheel == place.wheel);
    let which = which.filter(|w| found.causes.contains(&w.cause));
    let mut axes = own.iter().map(|number| match number.of {
        NumberOf::File(p) => p.axis(),
        NumberOf::Effect { .. } => None,
    });
    // of friction on several axes it speaks of none alone
    let axis = match (axes.next(), axes.next()) {
        (Some(Some(axis)), None) => Some(Axis::ALL[axis]),
        _ => None,
    };
    let kind = match card {
        effects::CauseCard::Effect(_) => Kind::Effect,
        effects::CauseCard::Nominal(_) => Kind::Parameter,
    };
    Some(Difference {
        cause: place.id.to_owned(),
        title: card.title().to_owned(),
        kind,
        stage: card.stage(),
        wheel: place.wheel,
        axis,
        numbers,
        not_told_apart_from: which.map(|w| w.not_told_apart_from.clone()).unwrap_or_default(),
        settle_by: which.and_then(|w| w.settle_by.clone()),
    })
}

/// A number in its own unit.
fn row(
    file: &RobotFile,
    number: &CommonNumber,
    change: &Change,
    (common, changed): (&Common, bool),
) -> Option<NumberCompared> {
    let (key, unit, scale) = match number.of {
        NumberOf::File(p) => {
            let key = NOMINAL_KEYS.iter().find(|key| key.factors.last() == Some(&p))?;
            let others = key.factors.iter().filter(|other| **other != p);
            let factor_of = |p: &Nominal| {
                let at = common.numbers.iter().position(|n| matches!(n.of, NumberOf::File(own) if own == *p))?;
                Some(common.pair.in_a(at))
            };
            let others: f64 = others.map(factor_of).product::<Option<f64>>()?;
            (format!("{}.{}", key.table, key.key), key.unit, key.value(file) * others)
        }
        NumberOf::Effect { card, wheel, param } => {
            let place = wheel.map_or(String::new(), |j| format!(" (wheel {j})"));
            let param = &card.params[param];
            (format!("effects.{}.{}{place}", card.id, param.key), param.unit, 1.0)
        }
    };
    let estimate = |(value, std): (f64, f64)| Estimate {
        value: value * scale,
        std: Some((std * scale).abs()).filter(|std| std.is_finite()),
        unit: unit.to_owned(),
    };
    Some(NumberCompared {
        key,
        a: estimate(change.a),
        b: estimate(change.b),
        change: estimate(change.by),
        errors: change.errors(),
        changed,
    })
}
