//! Where a gap can lie.

use serde::{Deserialize, Serialize};

/// A place of the robot and its share of the gap.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Where {
    /// Stage of the signal path.
    pub stage: Stage,
    /// Body axis, where the gap sits on one.
    pub axis: Option<Axis>,
    /// Wheel, where the gap sits on one.
    pub wheel: Option<usize>,
    /// Share of the gap, 0 to 1.
    pub share: f64,
    /// When it shows, where that could be told.
    pub regime: Option<Regime>,
}

/// The condition under which a stage's error is largest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Regime {
    /// The quantity that tells the regime.
    pub feature: String,
    /// Lower bound of that quantity, SI.
    pub low: Option<f64>,
    /// Upper bound of that quantity, SI.
    pub high: Option<f64>,
    /// Share of the stage's error that lies inside, 0 to 1.
    pub share: f64,
    /// The regime in words.
    pub text: String,
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
