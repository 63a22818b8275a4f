//! A number of the model that both sides share.

use model_core::effects::card::{Card, Param, Role};
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

/// The cause that a number belongs to, and where it sits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    /// Its id.
    pub id: &'static str,
    /// Its wheel, of an effect on one.
    pub wheel: Option<usize>,
}

impl CommonNumber {
    /// The cause that it belongs to.
    pub fn place(&self) -> Place {
        match self.of {
            NumberOf::File(p) => Place { id: p.cause(), wheel: None },
            NumberOf::Effect { card, wheel, .. } => Place { id: card.id, wheel },
        }
    }

    /// The coordinate in which both sides are fitted: of a number of the file its logarithm, of an effect's the number itself.
    pub fn coordinate(&self, value: f64) -> f64 {
        if self.is_logarithmic() { value.ln() } else { value }
    }

    /// The value at a coordinate.
    pub fn value_at(&self, coordinate: f64) -> f64 {
        if self.is_logarithmic() { coordinate.exp() } else { coordinate }
    }

    /// What the value changes by with its coordinate.
    pub fn slope_at(&self, value: f64) -> f64 {
        if self.is_logarithmic() { value } else { 1.0 }
    }

    fn is_logarithmic(&self) -> bool {
        matches!(self.of, NumberOf::File(_))
    }

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

    /// True of a number without which its effect is not there, and of every number of the file.
    pub fn is_size(&self) -> bool {
        match self.of {
            NumberOf::File(_) => true,
            NumberOf::Effect { card, param, .. } => is_size(card, &card.params[param]),
        }
    }
}

/// True of a parameter that sizes its effect; of an effect that is there or not, which has none, of its shapes.
pub(super) fn is_size(card: &Card, param: &Param) -> bool {
    param.role == Role::Size || card.params.iter().all(|p| p.role != Role::Size)
}
