//! What a window says.

use schemars::JsonSchema;
use serde::Serialize;

/// What a window says.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct Reading {
    /// Where the window begins, by the robot's clock since the first row [s]
    pub from_s: f64,
    /// Where it ends [s]
    pub to_s: f64,
    /// How many rows it has.
    pub rows: usize,
    /// How many of them got lost.
    pub lost_rows: usize,
    /// Whether it was judged: not where too much of it got lost, or nothing in it could be compared
    pub judged: bool,
    /// Mean battery voltage [V]
    #[serde(rename = "battery_V")]
    pub battery_v: Option<f64>,
    /// The error of each group of signals that was measured.
    pub groups: Vec<GroupError>,
    /// The error of each stage that could be told apart.
    pub stages: Vec<StageError>,
    /// The alarm that is on.
    pub alarm: Option<Alarm>,
    /// Whether it began with this window.
    pub alarm_began: bool,
}

/// The error of a group of signals: free runs driven by the command alone.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct GroupError {
    /// The group: `i`, `w`, `pose`, `gyro` or `vbat`
    pub group: &'static str,
    /// RMS of measured less predicted, in units of the sensor's noise
    pub error: f64,
    /// What noise alone would leave
    pub floor: f64,
}

/// The error of a stage, driven by its own measured input.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct StageError {
    /// The stage: `electrical` (voltage to current), `motion` (current to wheel speed: drivetrain and body) or `contact`
    /// (wheel speed to pose)
    pub stage: &'static str,
    /// RMS of measured less predicted, in units of the sensor's noise
    pub error: f64,
    /// What noise alone would leave
    pub floor: f64,
    /// The largest error that still fits
    pub limit: f64,
    /// Whether the error is above it
    pub above: bool,
    /// What speaks against the stage: windows above their limit add 3, others take 1 off; 18 is an alarm
    pub score: u32,
}

/// A stage that left its floor.
#[derive(Clone, Copy, Debug, PartialEq, JsonSchema, Serialize)]
pub struct Alarm {
    /// The stage
    pub stage: &'static str,
    /// Since when something speaks against it without a break, by the robot's clock [s]; chance may make that some windows
    /// earlier than the change
    pub since_s: f64,
}
