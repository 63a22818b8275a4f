//! A number of the model that both sides share.

use model_core::effects::card::{Card, Role};
use model_core::plant::robot::Nominal;

use crate::identify::Free;
use crate::simulate::{Model, Slot};

/// A number of the common model.
#[derive(Clone, Copy, Debug)]
pub(super) struct CommonNumber {
    /// Which.
    pub of: NumberOf,
    /// The lowest and the highest value allowed.
    pub within: (f64, f64),
}

/// What a number belongs to.
#[derive(Clone, Copy, Debug)]
pub(super) enum NumberOf {
    /// A factor on the robot file's numbers.
    File(Nominal),
    /// A parameter of an effect: its place in the card.
    Effect { card: &'static Card, wheel: Option<usize>, param: usize },
}

impl CommonNumber {
    /// Its slot in a model, if that has it.
    pub fn slot_in<const N: usize>(&self, model: &Model<N>) -> Option<Slot> {
        match self.of {
            NumberOf::File(p) => Some(Slot::Nominal(p)),
            NumberOf::Effect { card, wheel, param } => {
                let at = model.effects.iter().position(|e| e.id == card.id && e.wheel == wheel)?;
                Some(Slot::Param(at, param))
            }
        }
    }

    /// The same, to be fitted.
    pub fn free_in<const N: usize>(&self, model: &Model<N>) -> Option<Free> {
        Some(Free { slot: self.slot_in(model)?, within: self.within })
    }

    /// True of a number that says how large an effect is, and of every number of the file.
    pub fn is_size(&self) -> bool {
        match self.of {
            NumberOf::File(_) => true,
            NumberOf::Effect { card, param, .. } => card.params[param].role == Role::Size,
        }
    }
}
