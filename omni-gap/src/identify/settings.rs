//! What decides how a fit goes, and so what comes out of it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Settings of a fit whose dispersion suits what it finds.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(default)]
pub struct FitSettings {
    /// Rounds of a fit at one dispersion, at the most [rounds]: steps are quadratic near the end, six are seldom all taken.
    pub rounds: usize,
    /// Times that the dispersion is brought to what the fit sees, at the most [times]: it settles after two or three.
    pub temperings: usize,
    /// A first fit starts from what was stated: its dispersion is this many times what the errors alone suggest [1], so that
    /// the errors of a wrong model do not drive the numbers away before anything is known.
    pub caution: f64,
    /// The dispersion stays when its logarithm would move by less than this [1]: by a fifth, standard errors by a tenth.
    pub settled: f64,
    /// A nominal value is not believed to be off by more than these factors [1].
    pub believable: (f64, f64),
    /// Relative sigma of a nominal value whose statement is struck out [1]: a factor of about two, so that a fit cannot
    /// run away.
    pub released_sigma: f64,
    /// Rounds in which the starts of windows are found for a model as it is, at the most [rounds].
    pub start_rounds: usize,
    /// The part of its step that a start goes in the next round where the whole of it led to worse [1].
    pub start_part: f64,
    /// A round that takes less than this off Σ error² is the last [σ²].
    pub least_gain: f64,
}

impl Default for FitSettings {
    fn default() -> Self {
        Self {
            rounds: 6,
            temperings: 8,
            caution: 300.0,
            settled: 0.2,
            believable: (0.1, 4.0),
            released_sigma: 0.7,
            start_rounds: 6,
            start_part: 0.1,
            least_gain: 0.1,
        }
    }
}
