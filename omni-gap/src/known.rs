//! What robot files may name, as the catalogue's cards say.

use model_core::effects;
use model_core::effects::active::MAX_EFFECTS;
use model_core::effects::card::Role;

use crate::log::{Catalogue, KnownEffect, KnownParam};

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
    Catalogue {
        effects: effects::catalogue::<f64>().iter().map(|e| effect(e.card())).collect(),
        most_at_once: MAX_EFFECTS,
    }
}
