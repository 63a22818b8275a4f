//! # Vocabulary: the few words that findings, reports and commands share
//!
//! What an answer is in one word, what sort of cause there is, and where on the robot it can sit. Files write these words
//! as serde does here; readers rely on them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use model_core::effects::card::Stage;

/// Told, from any thread, what is being done.
pub type Progress<'a> = &'a (dyn Fn(&str) + Sync);

/// The answer in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// One or more effects of the catalogue explain the gap.
    Effect,
    /// Correcting nominal parameters explains the gap.
    Parameter,
    /// A gap is there and nothing in the catalogue explains it.
    Unknown,
    /// The nominal model predicts as well as noise and stated uncertainty allow.
    NoGap,
    /// The log itself is broken.
    UnfitData,
}

impl Verdict {
    /// Exit code of `diagnose --exit-code`.
    pub fn exit_code(self) -> u8 {
        match self {
            Verdict::NoGap => 0,
            Verdict::Parameter => 10,
            Verdict::Effect => 20,
            Verdict::Unknown => 30,
            Verdict::UnfitData => 40,
        }
    }
}

/// What sort of cause.
#[derive(Clone, Copy, Debug, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Something the model lacks.
    Effect,
    /// A number that the model has wrong.
    Parameter,
}

/// A [`Stage`] in files: the name that its card has, for `#[serde(with = "stage_name")]`.
pub(crate) mod stage_name {
    use model_core::effects::card::Stage;
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serializer};

    /// Its name.
    pub fn serialize<S: Serializer>(stage: &Stage, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(stage.name())
    }

    /// The stage of a name.
    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Stage, D::Error> {
        let name = String::deserialize(from)?;
        let found = Stage::ALL.into_iter().find(|stage| stage.name() == name);
        found.ok_or_else(|| D::Error::custom(format!("`{name}` is no stage")))
    }
}

/// A body axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Axis {
    /// Forward.
    V,
    /// Sideways.
    Vn,
    /// Turning.
    W,
}

impl Axis {
    /// All axes: v, vn, ω.
    pub const ALL: [Axis; 3] = [Axis::V, Axis::Vn, Axis::W];

    /// Its symbol.
    pub const fn symbol(self) -> &'static str {
        match self {
            Axis::V => "v",
            Axis::Vn => "vn",
            Axis::W => "ω",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_the_verdict_are_the_contracts() {
        let all = [Verdict::Effect, Verdict::Parameter, Verdict::Unknown, Verdict::NoGap, Verdict::UnfitData];
        let words = serde_json::to_value(all).unwrap();
        assert_eq!(words, serde_json::json!(["effect", "parameter", "unknown", "no_gap", "unfit_data"]));
    }
}
