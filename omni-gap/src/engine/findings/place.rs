//! Where a gap can lie.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::vocabulary::{Axis, Stage, stage_name};

/// A place of the robot and its share of the gap.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Where {
    /// Stage of the signal path.
    #[serde(with = "stage_name")]
    #[schemars(with = "String")]
    pub stage: Stage,
    /// Body axis, where the gap sits on one.
    pub axis: Option<Axis>,
    /// Wheel, where the gap sits on one.
    pub wheel: Option<usize>,
    /// Share of the gap, 0 to 1.
    pub share: f64,
    /// When it shows, where that could be told.
    pub regime: Option<Regime>,
}

/// The condition under which a stage's error is largest.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Regime {
    /// The quantity that tells the regime.
    pub feature: String,
    /// Lower bound of that quantity, SI.
    pub low: Option<f64>,
    /// Upper bound of that quantity, SI.
    pub high: Option<f64>,
    /// Share of the stage's error that lies inside, 0 to 1.
    pub share: f64,
    /// The regime in words.
    pub text: String,
}
