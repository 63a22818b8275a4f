//! How flexible the flexible model is.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How flexible the flexible model is.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(default)]
pub struct FlexibleSettings {
    /// Knots of a function of one feature [knots]: enough for a step at rest, a threshold or a saturation.
    pub knots: usize,
    /// What a robot has half made of a wrong force after about so long [s]: its mechanical time constant.
    pub lag_s: f64,
    /// Samples of a window that are learned from, at the most [samples]: its errors are hardly independent.
    pub samples_a_window: usize,
    /// Recordings that are learned from, at the most [s].
    pub most_s: f64,
    /// Parts of the recordings, each of which is foretold by what the others taught [parts]: whole runs where
    /// there are enough.
    pub folds: usize,
    /// Where there are too few runs to hold out whole ones, the length of a stretch that is held out as one [s]: what noise, start
    /// and place make alike is held out together.
    pub stretch_s: f64,
    /// Part of its way that each step of the boosting goes [1]: what several features explain alike is shared among them.
    pub rate: f64,
    /// Ridge over the mean square of each function [1].
    pub ridge: f64,
    /// Share of the errors' squares that a step has to foretell of recordings it has not seen [1]: less is chance.
    pub least_gain: f64,
    /// Steps at the most [steps].
    pub steps: usize,
}

impl Default for FlexibleSettings {
    fn default() -> Self {
        Self {
            knots: 5,
            lag_s: 0.1,
            samples_a_window: 12,
            most_s: 120.0,
            folds: 4,
            stretch_s: 2.0,
            rate: 0.5,
            ridge: 0.1,
            least_gain: 0.003,
            steps: 40,
        }
    }
}
