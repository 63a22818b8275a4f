//! Every cause that was considered, named or not, with its estimate: what can be compared over many robots.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::vocabulary::{Axis, Kind};

/// A cause that was considered on top of one model.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct ConsideredCause {
    /// Id of the catalogue.
    pub id: String,
    /// Effect or parameter.
    pub kind: Kind,
    /// Wheel, where it sits on one.
    pub wheel: Option<usize>,
    /// Body axis, where it speaks of one.
    pub axis: Option<Axis>,
    /// The round of the search in which it was tried; zero: on top of the plain model, re-fitted.
    pub round: usize,
    /// True if it was taken up in this round.
    pub taken_up: bool,
    /// Where the numbers come from.
    pub estimated_by: EstimatedBy,
    /// Its free numbers, all other numbers of the model and the starts of all windows profiled out.
    pub numbers: Vec<EstimatedNumber>,
    /// Drop of Σ error²/φ and of what was stated that the screen promises [1].
    pub promise: f64,
    /// Score of the model with it, on held-out runs; none where it was not fitted. Lower is better.
    pub score: Option<f64>,
    /// What that score is lower than without it; none where it was not fitted.
    pub gain: Option<f64>,
}

/// Where an estimate comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum EstimatedBy {
    /// A fit of the model with the cause: within bounds, standard errors robust.
    Fit,
    /// One linear step from the model without it: not held to bounds, so that it has no bias towards them, and with the
    /// standard error of the linear equations.
    Screen,
}

/// A free number of a cause.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct EstimatedNumber {
    /// Its key.
    pub key: String,
    /// Unit; `1` where dimensionless.
    pub unit: String,
    /// Its value where the cause is not there: absent for an effect, the robot file's for a parameter.
    pub absent: f64,
    /// The estimate; none where the recordings say nothing of it.
    pub value: Option<f64>,
    /// One standard error; none where the value was not estimated but held while the others were.
    pub std: Option<f64>,
}
