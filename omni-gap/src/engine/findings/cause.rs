//! What can cause a gap, and what to do next.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::vocabulary::{Axis, Kind};

/// One cause that was considered.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Which {
    /// Id of the catalogue, or `unknown` or `no_gap`.
    pub cause: String,
    /// The cause's name for people, from its card.
    pub title: Option<String>,
    /// Effect or parameter; none for `unknown` and `no_gap`.
    pub kind: Option<Kind>,
    /// Calibrated probability, 0 to 1.
    pub probability: f64,
    /// Wheel, where the cause sits on one.
    pub wheel: Option<usize>,
    /// Body axis, where the cause sits on one.
    pub axis: Option<Axis>,
    /// Fitted parameters by key.
    #[serde(default)]
    pub parameters: BTreeMap<String, Estimate>,
    /// Causes that this log cannot tell from this one.
    #[serde(default)]
    pub not_told_apart_from: Vec<String>,
    /// What would tell them apart.
    pub settle_by: Option<String>,
}

/// A number with its uncertainty.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Estimate {
    /// Value, SI.
    pub value: f64,
    /// One standard deviation, SI.
    pub std: Option<f64>,
    /// Unit; `1` where dimensionless.
    pub unit: String,
}

/// A parameter of the robot file, before and after.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Corrected {
    /// Its key in `robot.toml`, with table and wheel where needed.
    pub key: String,
    /// Unit; `1` where dimensionless.
    pub unit: String,
    /// Nominal value; none where the nominal file has no such entry.
    pub nominal: Option<f64>,
    /// Stated uncertainty of the nominal value, one standard deviation, SI.
    pub nominal_std: Option<f64>,
    /// Value in the corrected file.
    pub corrected: f64,
    /// One standard deviation of the corrected value, SI.
    pub std: Option<f64>,
}

impl NextExperiment {
    /// The file with the input to play, beside a report.
    pub const FILE: &'static str = "next_experiment.csv";
}

/// The run that would tell apart what this session could not.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct NextExperiment {
    /// What to do, and why, in a sentence.
    pub why: String,
    /// Causes that it tells apart.
    pub tells_apart: Vec<String>,
    /// File with the input to play, beside the report; none where hands do it.
    pub file: Option<String>,
}
