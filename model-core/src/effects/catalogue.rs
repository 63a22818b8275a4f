//! What can be looked up in the catalogue: effects by id or number, and causes of either kind.

use super::EffectKind;
use super::card::{Card, Stage};
use super::nominal::{NOMINAL, NominalCard};

impl EffectKind {
    /// The name that files use.
    pub const fn id(self) -> &'static str {
        self.card().id
    }

    /// Its number in a robot's parameter block.
    pub const fn code(self) -> u8 {
        self.card().code
    }

    /// The effect of this id.
    pub fn find(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.id() == id)
    }
}

/// Anything that a gap can come from: its page as data.
#[derive(Clone, Copy, Debug)]
pub enum CauseCard {
    /// Something that the model leaves out.
    Effect(&'static Card),
    /// A number that the model has wrong.
    Nominal(&'static NominalCard),
}

impl CauseCard {
    /// The name that files and reports use.
    pub const fn id(self) -> &'static str {
        match self {
            CauseCard::Effect(card) => card.id,
            CauseCard::Nominal(card) => card.id,
        }
    }

    /// Its name for people.
    pub const fn title(self) -> &'static str {
        match self {
            CauseCard::Effect(card) => card.title,
            CauseCard::Nominal(card) => card.title,
        }
    }

    /// The stage where a report places it.
    pub const fn stage(self) -> Stage {
        match self {
            CauseCard::Effect(card) => card.stage(),
            CauseCard::Nominal(card) => card.stage,
        }
    }
}

/// Every cause that there is: the effects, then the nominal parameters.
pub fn causes() -> impl Iterator<Item = CauseCard> {
    let effects = EffectKind::ALL.into_iter().map(|kind| CauseCard::Effect(kind.card()));
    effects.chain(NOMINAL.into_iter().map(CauseCard::Nominal))
}

/// The cause of this id.
pub fn cause(id: &str) -> Option<CauseCard> {
    causes().find(|cause| cause.id() == id)
}
