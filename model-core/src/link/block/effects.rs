//! The effects in a block: a number each, that never changes its meaning, and their parameters.

use super::{BlockError, BlockErrorKind, BoundedField};
use crate::effects::active::MOST_UNDONE;
use crate::effects::card::{MAX_PARAMS, Scope};
use crate::effects::{Effect, EffectKind};
use crate::link::bytes::Reader;

/// An effect that a block may name.
#[derive(Clone, Copy, Debug)]
pub struct EffectCode {
    /// Which effect.
    pub kind: EffectKind,
    /// Its number in a block.
    pub code: u8,
    /// Its id in the catalogue.
    pub id: &'static str,
    /// Where it sits.
    pub scope: Scope,
    count: usize,
    fields: [BoundedField; MAX_PARAMS],
    typical: [f32; MAX_PARAMS],
}

/// Every effect with its number, as the cards say.
pub static EFFECT_CODES: [EffectCode; EffectKind::ALL.len()] = {
    let mut codes = [EffectCode::of(EffectKind::ALL[0]); EffectKind::ALL.len()];
    let mut k = 0;
    while k < codes.len() {
        codes[k] = EffectCode::of(EffectKind::ALL[k]);
        k += 1;
    }
    codes
};

impl EffectCode {
    /// What a block needs of a card, in single precision; made when the program is built.
    const fn of(kind: EffectKind) -> Self {
        let card = kind.card();
        assert!(card.params.len() <= MAX_PARAMS, "a block has no room for so many parameters");
        let mut fields = [BoundedField { key: "", within: (0.0, 0.0), either_sign: false }; MAX_PARAMS];
        let mut typical = [0.0; MAX_PARAMS];
        let mut k = 0;
        while k < card.params.len() {
            let (low, high) = card.params[k].within;
            fields[k] = BoundedField { key: card.params[k].key, within: (low as f32, high as f32), either_sign: false };
            typical[k] = card.params[k].typical as f32;
            k += 1;
        }
        Self { kind, code: card.code, id: card.id, scope: card.scope, count: card.params.len(), fields, typical }
    }

    /// The effect of this number.
    pub fn by_code(code: u8) -> Option<&'static EffectCode> {
        EFFECT_CODES.iter().find(|known| known.code == code)
    }

    /// The effect of this id.
    pub fn by_id(id: &str) -> Option<&'static EffectCode> {
        EFFECT_CODES.iter().find(|known| known.id == id)
    }

    /// Its parameters' keys and bounds, in the card's order.
    pub fn fields(&self) -> &[BoundedField] {
        self.fields.get(..self.count).unwrap_or_default()
    }

    /// Values often met, in the card's order.
    pub fn typical(&self) -> &[f32] {
        self.typical.get(..self.count).unwrap_or_default()
    }
}

/// In a block: on all wheels, or on the robot.
pub(super) const EVERY_WHEEL: u8 = 0xff;

/// An effect with its parameters.
#[derive(Clone, Copy, Debug)]
pub struct BlockEffect {
    known: &'static EffectCode,
    wheel: Option<u8>,
    params: [f32; MAX_PARAMS],
}

impl BlockEffect {
    /// The effect of this id on a wheel, or on all where there is none; parameters in the card's order.
    ///
    /// # Errors
    /// [`BlockError`] where there is no such effect, or it has another number of parameters.
    pub fn new(id: &str, wheel: Option<u8>, params: &[f32]) -> Result<Self, BlockError> {
        let known = EffectCode::by_id(id).ok_or(BlockError::because(BlockErrorKind::UnknownEffect, "effects"))?;
        if params.len() != known.count {
            return Err(BlockError::because(BlockErrorKind::Length, known.id));
        }
        let mut effect = Self { known, wheel, params: [0.0; MAX_PARAMS] };
        effect.params.iter_mut().zip(params).for_each(|(slot, x)| *slot = *x);
        Ok(effect)
    }

    pub(super) fn read(reader: &mut Reader, short: BlockError) -> Result<Self, BlockError> {
        let [code, wheel] = reader.array().ok_or(short)?;
        let unknown =
            BlockError { value: f32::from(code), ..BlockError::because(BlockErrorKind::UnknownEffect, "effects") };
        let known = EffectCode::by_code(code).ok_or(unknown)?;
        let mut effect =
            Self { known, wheel: Some(wheel).filter(|wheel| *wheel != EVERY_WHEEL), params: [0.0; MAX_PARAMS] };
        for slot in effect.params.iter_mut().take(known.count) {
            *slot = reader.f32().ok_or(short)?;
        }
        Ok(effect)
    }

    /// Its number in a block.
    pub fn code(&self) -> u8 {
        self.known.code
    }

    /// Its id in the catalogue.
    pub fn id(&self) -> &'static str {
        self.known.id
    }

    /// The wheel that it sits on alone; `None`: on all, or on the robot.
    pub fn wheel(&self) -> Option<u8> {
        self.wheel
    }

    /// The effect itself.
    pub fn effect(&self) -> Option<Effect<f32>> {
        self.known.kind.with(self.params())
    }

    /// Its parameters, in the card's order and units.
    pub fn params(&self) -> &[f32] {
        self.params.get(..self.known.count).unwrap_or_default()
    }

    fn check(&self, wheels: usize) -> Result<(), BlockError> {
        if !self.known.scope.admits(self.wheel.map(usize::from), wheels) {
            let value = f32::from(self.wheel.unwrap_or(EVERY_WHEEL));
            return Err(BlockError { value, ..BlockError::because(BlockErrorKind::EffectWheel, self.known.id) });
        }
        self.known.fields().iter().zip(self.params).try_for_each(|(field, x)| field.check(x))
    }
}

/// The effects of a block.
#[derive(Clone, Copy, Debug, Default)]
pub struct BlockEffects {
    items: [Option<BlockEffect>; MOST_UNDONE],
    len: usize,
}

impl BlockEffects {
    /// Adds an effect.
    ///
    /// # Errors
    /// [`BlockError`] where it is there already on this wheel, or there is no room.
    pub fn push(&mut self, effect: BlockEffect) -> Result<(), BlockError> {
        if self.iter().any(|other| other.code() == effect.code() && other.wheel == effect.wheel) {
            return Err(BlockError::because(BlockErrorKind::EffectTwice, effect.id()));
        }
        let full = BlockError::because(BlockErrorKind::TooManyEffects, "effects");
        *self.items.get_mut(self.len).ok_or(full)? = Some(effect);
        self.len += 1;
        Ok(())
    }

    /// All of them, in the order in which they were added.
    pub fn iter(&self) -> impl Iterator<Item = &BlockEffect> {
        self.items.iter().flatten()
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.len
    }

    /// True if there is none.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    pub(super) fn check(&self, wheels: usize) -> Result<(), BlockError> {
        self.iter().try_for_each(|effect| effect.check(wheels))
    }
}
