//! The thresholds of pooling.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// All of them.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(default)]
pub struct PoolingKnobs {
    /// Probability, before any data, that robots of a kind share no cause [1]. One half: neither is expected.
    pub nothing_shared: f64,
    /// Shares ρ of the file's stated uncertainty that robots of a kind may have in common [1]. Nine steps: evidence over ρ is flat.
    pub in_common: Vec<f64>,
    /// Spreads τ of an effect between robots that are tried, in typical sizes [1]. A factor of three is finer than τ is ever known.
    pub spreads: Vec<f64>,
    /// Chance of any false robot, change or contrast in a whole report [1]. One in a hundred, after Bonferroni.
    pub false_alarms: f64,
    /// Robots of a kind from which on one may stand out. Fewer do not tell their own spread.
    pub least_robots: usize,
    /// Sessions on each side of a change. One is an outlier.
    pub least_sessions: usize,
}

impl Default for PoolingKnobs {
    fn default() -> Self {
        Self {
            nothing_shared: 0.5,
            in_common: vec![0.05, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.95],
            spreads: vec![0.0, 0.03, 0.1, 0.3, 1.0, 3.0],
            false_alarms: 0.01,
            least_robots: 5,
            least_sessions: 2,
        }
    }
}
