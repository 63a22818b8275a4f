//! Who can be the cause, and which columns of signatures are whose.

use std::ops::Range;

use model_core::effects::EffectKind;
use model_core::effects::card::{Card, Role, Scope};
use model_core::plant::robot::Nominal;

use crate::engine::stepwise::{Cause, freed_priors, has_a_say};
use crate::identify::{Extent, FreedPrior};
use crate::simulate::{Chain, EffectInstance};

/// A cause, and where its signatures stand.
#[derive(Clone, Debug)]
pub(in crate::engine) struct Suspect {
    pub cause: Cause,
    /// Its signature at its typical size.
    pub typical: usize,
    /// What a fit of it can make of its free numbers: each alone.
    pub free: Range<usize>,
}

/// What one column is the signature of.
#[derive(Clone, Debug)]
pub(in crate::engine) enum Column {
    /// An effect that is there.
    Effect(EffectInstance),
    /// Nominal factors that are wrong together.
    Factors(Vec<Nominal>),
}

/// All suspects of a model that is driven so and carries these effects already, and their columns.
pub(super) fn suspects<const N: usize>(
    present: &[EffectInstance],
    chain: Chain,
    shape_moved: f64,
) -> (Vec<Suspect>, Vec<Column>) {
    let (mut suspects, mut columns) = (Vec::new(), Vec::new());
    let suspected =
        |card: &&Card| has_a_say(card, chain, present) && !present.iter().any(|effect| effect.id == card.id);
    for card in EffectKind::ALL.iter().map(|kind| kind.card()).filter(suspected) {
        let places: Vec<Option<usize>> =
            if card.scope == Scope::OneWheel { (0..N).map(Some).collect() } else { vec![None] };
        for wheel in places {
            let typical = EffectInstance::typical(card, wheel);
            put(Cause::Effect(card, wheel), of_effect(&typical, shape_moved), &mut suspects, &mut columns);
        }
    }
    // what each of its numbers can be it speaks of already, together and alone
    for release in freed_priors().into_iter().filter(|release| release.extent != Extent::CommonFactor) {
        put(Cause::Parameter(release), of_number(release), &mut suspects, &mut columns);
    }
    (suspects, columns)
}

/// Adds a cause, its signature, and what a fit of it can make of its free numbers.
pub(in crate::engine) fn put(
    cause: Cause,
    (typical, free): (Column, Vec<Column>),
    suspects: &mut Vec<Suspect>,
    columns: &mut Vec<Column>,
) {
    let at = columns.len();
    columns.push(typical);
    let alone = free.len() < 2;
    if !alone {
        columns.extend(free);
    }
    suspects.push(Suspect { cause, typical: at, free: if alone { at..at + 1 } else { at + 1..columns.len() } });
}

/// Factors that are wrong together; and each alone.
pub(in crate::engine) fn of_number(release: FreedPrior) -> (Column, Vec<Column>) {
    let factors: Vec<Nominal> = Nominal::ALL.into_iter().filter(|factor| release.speaks_of(*factor)).collect();
    let each = factors.iter().map(|factor| Column::Factors(vec![*factor])).collect();
    (Column::Factors(factors), each)
}

/// The effect as it is; and each of its sizes alone, and with each shape moved by a share of its typical value.
pub(in crate::engine) fn of_effect(here: &EffectInstance, shape_moved: f64) -> (Column, Vec<Column>) {
    let card = here.card();
    let with = |change: &dyn Fn(&mut Vec<f64>)| {
        let mut effect = here.clone();
        change(&mut effect.params);
        Column::Effect(effect)
    };
    let sizes: Vec<usize> = (0..card.params.len()).filter(|k| card.params[*k].role == Role::Size).collect();
    let each_size = sizes.iter().map(|size| {
        with(&|params| {
            for other in sizes.iter().filter(|other| *other != size) {
                params[*other] = card.params[*other].absent;
            }
        })
    });
    let shapes = card.params.iter().enumerate().filter(|(_, p)| p.role == Role::Shape);
    let each_shape = shapes.map(|(k, p)| {
        let (low, high) = p.within;
        let by = if low < 0.0 { shape_moved * 0.5 * (high - low) } else { shape_moved * p.typical };
        let moved = if here.params[k] + by <= high { here.params[k] + by } else { here.params[k] - by };
        with(&|params| params[k] = moved)
    });
    let free = each_size.chain(each_shape).collect();
    (Column::Effect(here.clone()), free)
}
