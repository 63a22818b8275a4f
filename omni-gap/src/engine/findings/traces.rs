//! The signals of one held-out run: measured, by the nominal and by the corrected model.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::localise::validation::Signal;

/// A stretch of a run, as measured and as two models say it.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Traces {
    /// The run's name.
    pub run: String,
    /// How much of it is shown, at the most [s]
    pub shown_s: f64,
    /// Time between restarts of both models [s]
    pub horizon_s: f64,
    /// When they restart from the smoothed measurement [s]
    pub restarts_s: Vec<f64>,
    /// Time of every row since the first [s]
    pub t_s: Vec<f64>,
    /// The signals that were measured, each with one value a row.
    pub signals: Vec<SignalTrace>,
}

/// One signal.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct SignalTrace {
    /// Which; numbers are in its unit.
    pub signal: Signal,
    /// What was measured; none where the sample is missing.
    pub measured: Vec<Option<f64>>,
    /// What the nominal model says.
    pub nominal: Vec<f64>,
    /// What the corrected model says.
    pub corrected: Vec<f64>,
}
