//! The answer: what the robots of one kind tell together.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::pooled_number::PooledNumber;

/// A cause that all robots of a kind may share.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct CommonCause {
    /// What it is.
    #[serde(flatten)]
    pub of: PooledNumber,
    /// The cause's name for people.
    pub title: String,
    /// What the robots have in common, SI; of a number of the robot file the factor on it.
    pub value: f64,
    /// One standard error of it.
    pub std: f64,
    /// One standard deviation between robots; zero where none shows.
    pub spread: f64,
    /// Standard errors from absent, or from what the robot file admits [1]
    pub z: f64,
    /// Probability that this is what they share, at whatever place, among all causes and none [1]
    pub probability: f64,
    /// Sessions that named it on their own.
    pub named_alone: usize,
}

/// How much of a cause one robot has.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct RobotEstimate {
    /// The robot.
    pub robot: String,
    /// What it is.
    #[serde(flatten)]
    pub of: PooledNumber,
    /// What that is where the cause is absent.
    pub absent: f64,
    /// The estimate, not held to bounds, SI; of a number of the robot file the factor on it.
    pub value: f64,
    /// One standard error of it.
    pub std: f64,
    /// Standard errors from the other robots of the kind; none where there are too few [1]
    pub from_kind: Option<f64>,
    /// Whether that is more than chance in a whole report.
    pub stands_out: bool,
}

/// A change of one robot from one day to another.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct ChangePoint {
    /// The robot.
    pub robot: String,
    /// What it is.
    #[serde(flatten)]
    pub of: PooledNumber,
    /// The last day on which it was as before.
    pub last_before: String,
    /// The first day on which it was otherwise.
    pub since: String,
    /// By how much; of a number of the robot file the logarithm of its factor.
    pub by: f64,
    /// One standard error of it.
    pub std: f64,
    /// by/std [1]
    pub z: f64,
    /// Every session of the robot in its order.
    pub course: Vec<CourseDay>,
}

/// What one session of a robot says of a cause.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct CourseDay {
    /// The day, YYYY-MM-DD.
    pub date: String,
    /// The estimate, SI; of a number of the robot file the factor on it.
    pub value: f64,
    /// One standard error of it.
    pub std: f64,
}

/// A difference between two labels, on robots that drove under both.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Contrast {
    /// `firmware` or `floor`.
    pub label: String,
    /// Its one value.
    pub from: String,
    /// Its other value.
    pub to: String,
    /// What it is.
    #[serde(flatten)]
    pub of: PooledNumber,
    /// By how much the second is more than the first; of a number of the robot file the logarithm of its factor.
    pub by: f64,
    /// One standard error of it.
    pub std: f64,
    /// by/std [1]
    pub z: f64,
    /// Robots that tell it.
    pub robots: usize,
}

/// What the robots of one kind tell together.
#[derive(Clone, Debug, Default, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Pooled {
    /// Robots whose sessions told something.
    pub robots: usize,
    /// The share of the file's stated uncertainty that they have in common [1]; none where it cannot be told.
    pub in_common: Option<f64>,
    /// Causes that they share, the most probable first; what is missing from 1 is the probability that they share none.
    pub common: Vec<CommonCause>,
    /// Every cause on every robot.
    pub estimates: Vec<RobotEstimate>,
    /// Changes over time, the surest first.
    pub changes: Vec<ChangePoint>,
    /// Differences between firmware versions or floors, the surest first.
    pub contrasts: Vec<Contrast>,
}
