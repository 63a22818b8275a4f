//! A shape as data. The field names are those of `report.json`; readers rely on them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::simulate::SignalGroup;

/// What a residual is laid over, and how.
#[derive(Clone, Copy, Debug, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Form {
    /// Mean residual over a feature.
    Curve,
    /// Amplitude of the residual over the order of a wheel's turn.
    Spectrum,
    /// Mean residual over places of the floor.
    Map,
}

/// What of the residual is told: what was measured less what a model says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// Current of a motor [A]
    Current,
    /// Force at a wheel's rim that the motion needs beyond what the model says [N]
    NeededForce,
    /// Speed of a wheel whose drive is told a speed [rad/s]
    WheelSpeed,
    /// Force along the body's v that the motion needs [N]
    NeededForceAhead,
    /// Force along the body's vn that the motion needs [N]
    NeededForceLeft,
    /// Torque about the vertical axis that the motion needs [N·m]
    NeededTorque,
    /// Force against the way the robot moves [N]
    Drag,
    /// Speed along the body's v by the pose, while the wheels turn as measured [m/s]
    SpeedAhead,
    /// Speed along the body's vn by the pose, while the wheels turn as measured [m/s]
    SpeedLeft,
    /// Yaw rate by the pose, while the wheels turn as measured [rad/s]
    TurningRate,
    /// Yaw rate by the gyro [rad/s]
    Gyro,
    /// What the load takes off the bus voltage [V]
    Battery,
}

impl Quantity {
    /// Its SI unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Current => "A",
            Self::NeededForce | Self::NeededForceAhead | Self::NeededForceLeft | Self::Drag => "N",
            Self::NeededTorque => "N·m",
            Self::SpeedAhead | Self::SpeedLeft => "m/s",
            Self::WheelSpeed | Self::TurningRate | Self::Gyro => "rad/s",
            Self::Battery => "V",
        }
    }

    /// The signals that it is taken from.
    pub fn group(self) -> SignalGroup {
        match self {
            Self::Current => SignalGroup::Current,
            Self::SpeedAhead | Self::SpeedLeft | Self::TurningRate => SignalGroup::Pose,
            Self::Gyro => SignalGroup::Gyro,
            Self::Battery => SignalGroup::Battery,
            _ => SignalGroup::WheelSpeed,
        }
    }
}

/// What a residual is laid over.
#[derive(Clone, Copy, Debug, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Feature {
    /// Speed of the wheel [rad/s]
    WheelSpeed,
    /// Current of the motor [A]
    Current,
    /// Its size [A]
    CurrentSize,
    /// How fast the wheel's speed changes [rad/s²]
    WheelAcceleration,
    /// Angle of the wheel within its turn [rad]
    WheelAngle,
    /// Speed along the body's v [m/s]
    SpeedAhead,
    /// Speed along the body's vn [m/s]
    SpeedLeft,
    /// Yaw rate [rad/s]
    YawRate,
    /// Heading within a turn [rad]
    Heading,
    /// Speed ahead times yaw rate [m/s²]
    Turning,
    /// Time since the run began [s]
    Time,
    /// Sum of all motors' currents, without sign [A]
    TotalCurrent,
    /// What the load takes off the bus voltage, as measured [V]
    BatteryDrop,
    /// Place on the floor [m]
    Place,
    /// Order of the wheel's turn [1/turn]
    Order,
}

impl Feature {
    /// Its unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::WheelSpeed | Self::YawRate => "rad/s",
            Self::Current | Self::CurrentSize | Self::TotalCurrent => "A",
            Self::WheelAcceleration => "rad/s²",
            Self::WheelAngle | Self::Heading => "rad",
            Self::SpeedAhead | Self::SpeedLeft => "m/s",
            Self::Turning => "m/s²",
            Self::Time => "s",
            Self::BatteryDrop => "V",
            Self::Place => "m",
            Self::Order => "1/turn",
        }
    }
}

/// The shape of the residual over a feature.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Shape {
    /// What it is: a curve, a spectrum or a map.
    pub form: Form,
    /// What the residual is laid over.
    pub feature: Feature,
    /// Unit of the feature.
    pub unit: String,
    /// What of the residual is told.
    pub quantity: Quantity,
    /// Unit of the quantity.
    pub quantity_unit: String,
    /// The signal group that it is taken from: `i`, `w`, `pose`, `gyro` or `vbat`.
    pub group: String,
    /// The wheel; none where all are laid over each other, and where it is one of the body.
    pub wheel: Option<usize>,
    /// Chance of such a shape where there is none, all that was looked at counted, 0 to 1.
    pub chance: f64,
    /// Share of the residual's mean square that the shape holds, 0 to 1.
    pub share: f64,
    /// Of a spectrum: the amplitude above which a line is none of chance.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub alarm_level: Option<f64>,
    /// Of a spectrum: the orders above it, the strongest first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lines: Vec<Line>,
    /// The parts of the feature's range.
    pub bins: Vec<ShapeBin>,
}

/// A line of a spectrum.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Line {
    /// How often it comes in a turn of the wheel.
    pub order: usize,
    /// What it is, where the model tells: such as "once a turn of the wheel".
    pub name: Option<String>,
}

/// One part of a feature's range. Residuals are those of a model: measured less predicted, in the quantity's unit.
#[derive(Clone, Copy, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct ShapeBin {
    /// Lower end, in the feature's unit; of a map, of x.
    pub low: f64,
    /// Upper end.
    pub high: f64,
    /// Mean of the feature.
    pub at: f64,
    /// Of a map: both ends of y (m).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y: Option<[f64; 2]>,
    /// Independent samples.
    pub n: usize,
    /// Mean residual of the nominal model; of a spectrum, its amplitude.
    pub nominal: f64,
    /// 95 % interval of it.
    pub nominal_ci95: [f64; 2],
    /// The same of the model that the causes were added to: the nominal one, where an effect was found or nothing explains the
    /// gap, with its numbers re-fitted within their stated uncertainty.
    pub before: f64,
    /// 95 % interval of it.
    pub before_ci95: [f64; 2],
    /// The same of the corrected model.
    pub corrected: f64,
    /// 95 % interval of it.
    pub corrected_ci95: [f64; 2],
}
