//! # Vocabulary: the few words that findings, reports and commands share
//!
//! What an answer is in one word, what sort of cause there is, and where on the robot it can sit. Files write these words
//! as serde does here; readers rely on them.

use serde::{Deserialize, Serialize};

/// Told, from any thread, what is being done.
pub type Progress<'a> = &'a (dyn Fn(&str) + Sync);

/// The answer in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Something the model lacks.
    Effect,
    /// A number that the model has wrong.
    Parameter,
}

/// The five stages, in signal order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Stage {
    /// Voltage to current.
    Electrical,
    /// Current to torque at the wheel.
    Drivetrain,
    /// Wheel to floor.
    Contact,
    /// Force to motion.
    Body,
    /// Motion to reading.
    Sensing,
}

impl Stage {
    /// All stages, in signal order.
    pub const ALL: [Stage; 5] = [Stage::Electrical, Stage::Drivetrain, Stage::Contact, Stage::Body, Stage::Sensing];
}

impl From<model_core::effects::card::Stage> for Stage {
    fn from(stage: model_core::effects::card::Stage) -> Stage {
        match stage {
            model_core::effects::card::Stage::Electrical => Stage::Electrical,
            model_core::effects::card::Stage::Drivetrain => Stage::Drivetrain,
            model_core::effects::card::Stage::Contact => Stage::Contact,
            model_core::effects::card::Stage::Body => Stage::Body,
            model_core::effects::card::Stage::Sensing => Stage::Sensing,
        }
    }
}

/// A body axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
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
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_are_called_what_the_cards_call_them() {
        for stage in model_core::effects::card::Stage::ALL {
            assert_eq!(serde_json::to_value(Stage::from(stage)).unwrap(), stage.name());
        }
    }

    #[test]
    fn words_of_the_verdict_are_the_contracts() {
        let all = [Verdict::Effect, Verdict::Parameter, Verdict::Unknown, Verdict::NoGap, Verdict::UnfitData];
        let words = serde_json::to_value(all).unwrap();
        assert_eq!(words, serde_json::json!(["effect", "parameter", "unknown", "no_gap", "unfit_data"]));
    }
}
