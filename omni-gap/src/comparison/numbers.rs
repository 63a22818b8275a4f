//! Which numbers changed beyond their uncertainty, which did not, and to which cause they belong.

use model_core::effects;

use super::answer::{Difference, NumberCompared};
use super::common::{Common, Judged};
use super::common_number::{CommonNumber, NumberOf, Place};
use super::options::ComparisonKnobs;
use super::paired::Change;
use super::told::Told;
use crate::engine::findings::{Findings, Which};
use crate::vocabulary::{Axis, Kind};

/// What differs.
#[derive(Debug)]
pub(super) struct Differences {
    /// The causes.
    pub causes: Vec<Difference>,
    /// Every number.
    pub numbers: Vec<NumberCompared>,
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
    let numbers = &common.numbers;
    let named = (0..numbers.len()).filter(|k| named(&numbers[*k], judged.b)).collect();
    let mut changing = confirmed(named, common, knobs);
    loop {
        let others = (0..numbers.len()).filter(|k| !changing.contains(k) && numbers[*k].is_size());
        let surest = others.filter_map(|k| alone(common, &changing, k, knobs));
        let surest = surest.max_by(|a, b| a.errors().total_cmp(&b.errors()));
        match surest.filter(|change| change.errors() > knobs.changed_errors) {
            Some(change) => changing.push(change.slot),
            None => break,
        }
    }
    let changing = confirmed(changing, common, knobs);
    let changes = (0..numbers.len()).map(|k| alone(common, &changing, k, knobs)).collect();
    let told =
        Told { file: judged.file, common, changing: &changing, changes, confirmed_errors: knobs.confirmed_errors };
    let mut surest_first = changing.clone();
    surest_first.sort_by(|a, b| told.errors(*b).total_cmp(&told.errors(*a)));
    let mut places: Vec<Place> = Vec::new();
    for place in surest_first.into_iter().map(|k| numbers[k].place()) {
        if !places.contains(&place) {
            places.push(place);
        }
    }
    let causes = places.into_iter().filter_map(|place| {
        let changing = |k: &usize| changing.contains(k) && numbers[*k].place() == place;
        let own: Vec<&CommonNumber> = (0..numbers.len()).filter(changing).map(|k| &numbers[k]).collect();
        difference(place, &own, told.rows(|k| told.moves_with(k, place)), judged.b)
    });
    Differences { causes: causes.collect(), numbers: told.rows(|_| true) }
}

/// How numbers change where these may. Beside another cause no number of the file is surer than the laws of the catalogue are true.
fn changes(common: &Common, changing: &[usize], knobs: &ComparisonKnobs) -> Option<Vec<Change>> {
    let mut found = common.changes(changing)?;
    for change in &mut found {
        let number = &common.numbers[change.slot];
        let beside = changing.iter().any(|other| common.numbers[*other].place() != number.place());
        if beside && matches!(number.of, NumberOf::File(_)) {
            change.by.1 = change.by.1.hypot(knobs.law_error * change.a.0);
            change.in_coordinate.1 = change.in_coordinate.1.hypot(knobs.law_error);
        }
    }
    Some(found)
}

/// How one number changes where these may too.
fn alone(common: &Common, changing: &[usize], k: usize, knobs: &ComparisonKnobs) -> Option<Change> {
    let others = changing.iter().copied().filter(|other| *other != k);
    changes(common, &others.chain([k]).collect::<Vec<_>>(), knobs)?.pop()
}

/// The numbers of those causes that differ beyond their uncertainty: one that both sides have to the same extent is no difference.
fn confirmed(mut changing: Vec<usize>, common: &Common, knobs: &ComparisonKnobs) -> Vec<usize> {
    while let Some(found) = changes(common, &changing, knobs) {
        let place = |k: usize| common.numbers[k].place();
        let differs =
            |k: &usize| found.iter().any(|c| place(c.slot) == place(*k) && c.errors() > knobs.confirmed_errors);
        let kept: Vec<usize> = changing.iter().copied().filter(differs).collect();
        if kept.len() == changing.len() {
            break;
        }
        changing = kept;
    }
    changing
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
