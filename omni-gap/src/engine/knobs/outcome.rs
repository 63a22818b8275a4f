//! When causes explain a gap, and when there is none.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// When causes explain a gap.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(default)]
pub struct OutcomeKnobs {
    /// Least share of the gap that known causes have to close; with less the answer is `unknown` [1]: more than half.
    pub least_closed: f64,
    /// Free-run error over its floor above which a re-fitted plain model leaves a gap [1]. By trial.
    pub inadequate: f64,
    /// The same for a model with wrong parameters corrected [1]: twice as far, a parameter need not explain all.
    pub inadequate_parameters: f64,
    /// A model whose excess is below this in every group is adequate, whatever its free-run error [1]: a floor is uncertain where
    /// starts are. By trial.
    pub like_noise: f64,
    /// One whose excess is above this in a group is not [1]: half of what is left there is no noise. By trial.
    pub unlike_noise: f64,
    /// The same for a model with wrong parameters corrected [1].
    pub unlike_noise_parameters: f64,
    /// What excess effects have to leave of that before them to be inadequate by it [1]: they need not be all that a robot has.
    pub still_there: f64,
}

impl Default for OutcomeKnobs {
    fn default() -> Self {
        Self {
            least_closed: 0.6,
            inadequate: 1.15,
            inadequate_parameters: 2.3,
            like_noise: 1.1,
            unlike_noise: 1.4,
            unlike_noise_parameters: 3.0,
            still_there: 0.1,
        }
    }
}
