//! How two sessions are compared, and from what size on a difference counts.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::engine::Knobs;
use crate::vocabulary::Progress;

/// How to compare.
#[derive(Clone)]
pub struct Options<'a> {
    /// Every threshold of the engine, which judges both sides.
    pub engine: Knobs,
    /// Those of the comparison itself.
    pub knobs: ComparisonKnobs,
    /// Told what is being done.
    pub progress: Progress<'a>,
}

impl std::fmt::Debug for Options<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Options").field("engine", &self.engine).field("knobs", &self.knobs).finish_non_exhaustive()
    }
}

impl Default for Options<'_> {
    fn default() -> Self {
        Self { engine: Knobs::default(), knobs: ComparisonKnobs::default(), progress: &|_| {} }
    }
}

/// From what size on a difference counts.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(default)]
pub struct ComparisonKnobs {
    /// Standard errors by which a number has to differ to have changed [1]: with twenty numbers compared, one pair of alike
    /// recordings in some hundreds has one.
    pub changed_errors: f64,
    /// The same of a number whose cause the engine names beside [1]: 99.7 %.
    pub confirmed_errors: f64,
    /// Beside another cause no number of the file is surer than this share of it [1]: no law of the catalogue is truer to a robot,
    /// and what it misses of a large change moves other numbers a little.
    pub law_error: f64,
    /// A number of the file that explains this share of what something new does is believed before it [1]: a fit of more freedom does
    /// a little more in any case.
    pub as_good: f64,
    /// No number of A counts as better known than this, relatively [1]: a model's time steps and a log's rounding are as large.
    pub least_known: f64,
    /// What B's left-over, over its noise floor, may be of A's own before it is a difference [1]: as much as a plain model may leave
    /// before the engine calls it a gap.
    pub left_over: f64,
}

impl Default for ComparisonKnobs {
    fn default() -> Self {
        Self {
            changed_errors: 4.0,
            confirmed_errors: 3.0,
            law_error: 2.5e-3,
            as_good: 0.95,
            least_known: 1e-3,
            left_over: 1.15,
        }
    }
}
