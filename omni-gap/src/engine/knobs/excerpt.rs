//! The thresholds of an excerpt.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Which rows stand for recordings that are too long to be weighed whole.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(default)]
pub struct ExcerptKnobs {
    /// Rows that an answer rests on, at the most [rows]: a limit of time; two minutes at 500 rows a second.
    pub most_rows: usize,
    /// Into how many pieces these are cut [pieces]: many places of the recording, each long enough to get going.
    pub pieces: usize,
    /// So many runs to fit on, or fewer, are looked at as they come [runs]: as many as the screen looks at.
    pub few_runs: usize,
    /// Time between two looks at a signal [s]: shorter than any manoeuvre, longer than what noise makes of a change.
    pub look_s: f64,
    /// Equal parts of the range of a signal, or of its change [parts]; what is beyond the range makes two more.
    pub levels: usize,
    /// Share of the looks that is beyond the range at either end [1]: a few outliers must not stretch it.
    pub beyond: f64,
    /// Parts of the time of the whole recording [parts].
    pub ages: usize,
    /// A situation counts as met once it lasted this long [s].
    pub met_s: f64,
}

impl Default for ExcerptKnobs {
    fn default() -> Self {
        Self {
            most_rows: 60_000,
            pieces: 24,
            few_runs: 4,
            look_s: 0.05,
            levels: 8,
            beyond: 0.005,
            ages: 10,
            met_s: 0.5,
        }
    }
}
