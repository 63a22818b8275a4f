//! What a comparison says: plain, owned, free of the number of wheels.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::options::ComparisonKnobs;
use crate::engine::findings::{Estimate, Where};
use crate::vocabulary::{Axis, Kind, Stage, stage_name};

/// The answer in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ComparisonVerdict {
    /// What differs is named.
    Different,
    /// Nothing differs by more than its uncertainty.
    Alike,
    /// The two differ, and nothing in the catalogue explains it.
    Unknown,
    /// The recordings of one side cannot be used.
    UnfitData,
}

impl ComparisonVerdict {
    /// Exit code of `compare --exit-code`.
    pub fn exit_code(self) -> u8 {
        match self {
            ComparisonVerdict::Alike => 0,
            ComparisonVerdict::Different => 20,
            ComparisonVerdict::Unknown => 30,
            ComparisonVerdict::UnfitData => 40,
        }
    }
}

/// What two sessions say of each other.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Comparison {
    /// The answer in one word.
    pub verdict: ComparisonVerdict,
    /// How the two were laid over each other.
    pub aligned_by: AlignedBy,
    /// What explains the difference, what explains most first.
    pub causes: Vec<Difference>,
    /// Every number of the common model, A beside B, in the order of the robot file, then of the effects.
    pub numbers: Vec<NumberCompared>,
    /// The error of free runs by A's model, per signal group: `i`, `w`, `pose`, `gyro`, `vbat`; only groups that both sides logged.
    pub gap: BTreeMap<String, GapCompared>,
    /// Where in B the gap to A's model lies; shares sum to 1.
    #[serde(rename = "where")]
    pub where_: Vec<Where>,
    /// Causes that A's own recordings show beside its robot file: what both have in common.
    pub explained_in_a: Vec<String>,
    /// Thresholds of the comparison.
    pub knobs: ComparisonKnobs,
}

impl Comparison {
    /// What recordings that cannot be used say of each other: nothing.
    pub fn unfit(knobs: ComparisonKnobs) -> Self {
        Self {
            verdict: ComparisonVerdict::UnfitData,
            aligned_by: AlignedBy::Model,
            causes: Vec::new(),
            numbers: Vec::new(),
            gap: BTreeMap::new(),
            where_: Vec::new(),
            explained_in_a: Vec::new(),
            knobs,
        }
    }
}

/// How two sessions were laid over each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AlignedBy {
    /// Every run of B was driven by the input of a run of A, row by row.
    Input,
    /// Inputs differ: what A teaches is driven with B's.
    Model,
}

/// A cause of the difference.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Difference {
    /// Id of the catalogue.
    pub cause: String,
    /// Its name for people.
    pub title: String,
    /// Effect or parameter.
    pub kind: Kind,
    /// Stage of the signal path.
    #[serde(with = "stage_name")]
    #[schemars(with = "String")]
    pub stage: Stage,
    /// Wheel, where it sits on one.
    pub wheel: Option<usize>,
    /// Body axis, where it speaks of one.
    pub axis: Option<Axis>,
    /// Its numbers, those that changed among them.
    pub numbers: Vec<NumberCompared>,
    /// Causes that the engine cannot tell from it.
    pub not_told_apart_from: Vec<String>,
    /// What would tell them apart.
    pub settle_by: Option<String>,
}

/// A number in A and in B.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct NumberCompared {
    /// Its key: `body.mass_kg`, `effects.dead_time.voltage_loss_V (wheel 1)`.
    pub key: String,
    /// In A, SI.
    pub a: Estimate,
    /// In B, SI.
    pub b: Estimate,
    /// From A to B, SI; surer than both where they share an error, such as that of another number of the file.
    pub change: Estimate,
    /// Standard errors by which the change differs from none [1].
    pub errors: f64,
    /// True where it changed beyond its uncertainty.
    pub changed: bool,
}

/// The error of free runs in one signal group, RMS in units of each sensor's sigma.
#[derive(Clone, Copy, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct GapCompared {
    /// Of A by its own model.
    pub a: f64,
    /// A perfect model of A with the same noise.
    pub a_noise_floor: f64,
    /// Of B by A's model as it is.
    pub b: f64,
    /// Of B by A's model with what differs.
    pub b_explained: f64,
    /// A perfect model of B with the same noise.
    pub b_noise_floor: f64,
}

impl NumberCompared {
    /// True where the change over A's value says something: A's is plainly not zero.
    pub fn is_share_telling(&self) -> bool {
        self.a.std.is_none_or(|std| self.a.value.abs() > 3.0 * std) && self.a.value != 0.0
    }
}
