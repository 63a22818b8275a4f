//! Which cause would be taken for which.

use schemars::JsonSchema;
use serde::Serialize;

use super::selftest::Rival;
use crate::vocabulary::{Axis, Kind};

/// The angles between all causes of typical size, on recordings of one kind.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct Confusion {
    /// The robot's name.
    pub robot: String,
    /// The groups of signals that are logged.
    pub logged: Vec<&'static str>,
    /// How many numbers are measured.
    pub numbers: usize,
    /// Every cause, in the order of the catalogue; of effects on one wheel, that wheel where they show least.
    pub causes: Vec<ConfusedCause>,
}

/// A cause of typical size, and what it would be taken for.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct ConfusedCause {
    /// Its id.
    pub cause: &'static str,
    /// Effect or parameter.
    pub kind: Kind,
    /// The wheel that it sits on.
    pub wheel: Option<usize>,
    /// The body axis, of friction that is wrong on one alone.
    pub axis: Option<Axis>,
    /// How far it moves the recordings beyond what starts and nominal numbers can imitate [σ], all numbers taken together.
    pub sigma: f64,
    /// True if a diagnosis finds something.
    pub seen: bool,
    /// Every other cause, each where it is nearest (on which wheel, on which axis), the nearest first.
    pub others: Vec<Rival>,
}

impl ConfusedCause {
    /// True if it is seen, and told from every other cause.
    pub fn is_named(&self) -> bool {
        self.seen && self.others.iter().all(Rival::is_told)
    }
}
