//! The report as data. The field names are those of `compare.json`; readers rely on them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::comparison::Comparison;
use crate::report::Fault;

/// The version of the form of `compare.json` that this program writes.
pub const SCHEMA: u32 = 1;

/// One comparison.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct ComparisonReport {
    /// Version of this form.
    pub schema: u32,
    /// Name of the robot, from A's file.
    pub robot: String,
    /// What the first session is called.
    pub a: String,
    /// What the second is called.
    pub b: String,
    /// What the first is.
    pub against: Against,
    /// What was found.
    #[serde(flatten)]
    pub comparison: Comparison,
    /// What is wrong with the recordings, and how to mend it.
    pub faults: Vec<Fault>,
    /// What the reader should know but need not mend.
    pub notices: Vec<String>,
}

/// What the first session is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Against {
    /// Recordings of a robot, as the second's.
    Recordings,
    /// What a simulator says of the second's inputs.
    Simulator,
}

/// What a report says beside what was found: of which sessions it speaks.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    /// Name of the robot, from A's file.
    pub robot: String,
    /// What the first session is called.
    pub a: String,
    /// What the second is called.
    pub b: String,
    /// What the first is.
    pub against: Against,
}

impl ComparisonReport {
    /// The report of what was found.
    pub fn of(comparison: Comparison, named: Named, faults: Vec<Fault>, notices: Vec<String>) -> Self {
        let Named { robot, a, b, against } = named;
        Self { schema: SCHEMA, robot, a, b, against, comparison, faults, notices }
    }

    /// The text of `compare.json`; the same report always gives the same bytes.
    pub fn to_json(&self) -> serde_json::Result<String> {
        serde_json::to_string_pretty(self).map(|text| text + "\n")
    }
}
