//! The report as data. The field names are those of `fleet.json`; readers rely on them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::pooling::{Pooled, PoolingKnobs};
use crate::vocabulary::Verdict;

/// The version of the form of `fleet.json` that this program writes.
pub const SCHEMA: u32 = 1;

/// A fleet.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct FleetReport {
    /// Version of this form.
    pub schema: u32,
    /// Each kind of robot, by its name.
    pub kinds: Vec<KindOfRobot>,
    /// Every session, by its folder.
    pub sessions: Vec<SessionLine>,
    /// The thresholds that it was made with.
    pub knobs: PoolingKnobs,
}

/// Robots whose files have one name and state the same.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct KindOfRobot {
    /// The name in their robot files.
    pub kind: String,
    /// What they tell together.
    pub pooled: Pooled,
}

/// A session, and what it answered alone.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct SessionLine {
    /// Its folder.
    pub session: String,
    /// The robot.
    pub robot: String,
    /// The name in its robot file; none where that could not be read.
    pub kind: Option<String>,
    /// The day, YYYY-MM-DD.
    pub date: String,
    /// The answer in one word; none where it could not be asked.
    pub verdict: Option<Verdict>,
    /// The causes that it named.
    pub causes: Vec<String>,
    /// Why there is no answer, or why the data are unfit.
    pub reason: Option<String>,
    /// The error of the free runs by the robot file [σ].
    pub gap: Option<f64>,
    /// The same with the causes in the model [σ].
    pub gap_after: Option<f64>,
    /// Its report, relative to the page; none where none was kept.
    pub report: Option<String>,
}

impl FleetReport {
    /// The text of `fleet.json`; the same report always gives the same bytes.
    pub fn to_json(&self) -> serde_json::Result<String> {
        serde_json::to_string_pretty(self).map(|text| text + "\n")
    }
}
