//! What robot files may name, as the catalogue's cards say.

use model_core::effects::EffectKind;
use model_core::effects::active::MAX_EFFECTS;
use model_core::effects::card::Role;
use model_core::effects::nominal::NOMINAL;

use crate::log::{Catalogue, KnownEffect, KnownParam};
use crate::simulate::ROOM_FOR_CAUSES;

/// The most effects that a file may name: a diagnosis needs room for those that it adds.
const MOST_IN_A_FILE: usize = MAX_EFFECTS - ROOM_FOR_CAUSES;

/// The names of all causes: effects, and numbers of a robot file that may be wrong.
pub fn cause_ids() -> impl Iterator<Item = &'static str> {
    EffectKind::ALL.iter().map(|effect| effect.card().id).chain(NOMINAL.iter().map(|parameter| parameter.id))
}

/// The effects that this program knows.
pub fn known_effects() -> Catalogue {
    let effect = |card: &model_core::effects::card::Card| KnownEffect {
        id: card.id.to_owned(),
        scope: card.scope,
        params: card
            .params
            .iter()
            .map(|p| KnownParam {
                key: p.key.to_owned(),
                low: p.within.0,
                high: p.within.1,
                required: p.role == Role::Size,
            })
            .collect(),
    };
    Catalogue { effects: EffectKind::ALL.iter().map(|e| effect(e.card())).collect(), most_at_once: MOST_IN_A_FILE }
}
