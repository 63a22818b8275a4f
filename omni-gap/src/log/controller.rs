//! # `[controller]`: what only the robot's own controller needs to know
//!
//! An optional table of the robot file, read by `omni-gap export`; no diagnosis looks at it.
//!
//! ```toml
//! [controller]                     # all keys may be left out
//! mode = "current"                 # or "voltage": without a loop for the currents
//! feedforward = true               # false: by feedback alone
//! commutation = "field_oriented"   # or "six_step": by the sectors of the halls alone
//! pole_pairs = 8                   # electrical turns in a turn of the motor
//! inductance_H = 0.5e-3            # between two terminals, as resistance_ohm
//! bandwidth_rad_s = 2000.0         # of the currents' loop
//! feedback_A_s_per_rad = 0.3       # current for an error of a wheel's speed
//! feedback_A_per_rad = 0.05        # current for an error of a wheel's angle
//! acceleration_v_m_s2 = 3.0        # largest along v, along vn and about the vertical axis
//! acceleration_vn_m_s2 = 3.0
//! acceleration_w_rad_s2 = 30.0
//! under_voltage_V = 9.0            # the bridges open below; default 3/4 of [supply] voltage_V
//! over_voltage_V = 15.0            # and above; default 5/4 of it
//! amps_per_count = 0.0049          # phase current of one count of the converter; below zero where the code falls with it
//! bus_volts_per_count = 0.00886    # supply voltage of one count
//! linear_range_A = 9.4             # phase current up to which the amplifiers are straight; the trip has to lie within
//! continuous_current_A = 2.0       # what a motor bears for ever; default half of [limits] current_A
//! heating_time_s = 10.0            # thermal time constant of its winding
//! gyro_rad_s_per_count = 0.001065  # a robot with a gyro: yaw rate of one count; below zero where it is upside down
//! encoder_rad_per_count = 7.67e-5  # a robot with encoders: angle at the wheel of 1/16384 turn; below zero where they count backwards
//! ```

use super::toml_walk::Section;
use crate::error::Result;
use schemars::JsonSchema;
use serde::Serialize;

/// What only the robot's own controller needs to know, in the units that the keys name.
#[derive(Debug, Clone, Copy, PartialEq, JsonSchema, Serialize)]
#[allow(missing_docs)]
pub struct ControllerFile {
    /// Whether a loop holds the currents; otherwise the wheels are driven by the model's voltages alone.
    pub holds_current: bool,
    /// Whether the model's voltages and currents go ahead of the feedback.
    pub feedforward: bool,
    /// Whether the motors are commutated by the sectors of the halls alone.
    pub six_step: bool,
    pub pole_pairs: u8,
    #[serde(rename = "inductance_H")]
    pub inductance_h: f64,
    pub bandwidth_rad_s: f64,
    #[serde(rename = "feedback_A_s_per_rad")]
    pub feedback_a_s_per_rad: f64,
    #[serde(rename = "feedback_A_per_rad")]
    pub feedback_a_per_rad: f64,
    pub acceleration_v_m_s2: f64,
    pub acceleration_vn_m_s2: f64,
    pub acceleration_w_rad_s2: f64,
    /// None: three quarters of the supply.
    #[serde(rename = "under_voltage_V")]
    pub under_voltage_v: Option<f64>,
    /// None: five quarters of the supply.
    #[serde(rename = "over_voltage_V")]
    pub over_voltage_v: Option<f64>,
    /// Below zero where the code falls while the current rises.
    pub amps_per_count: f64,
    pub bus_volts_per_count: f64,
    #[serde(rename = "linear_range_A")]
    pub linear_range_a: f64,
    /// None: half of the largest current.
    #[serde(rename = "continuous_current_A")]
    pub continuous_current_a: Option<f64>,
    pub heating_time_s: f64,
    /// None: the robot has no gyro. Below zero where it is mounted upside down.
    pub gyro_rad_s_per_count: Option<f64>,
    /// None: the robot has no encoders. Below zero where they count backwards.
    pub encoder_rad_per_count: Option<f64>,
}

impl Default for ControllerFile {
    fn default() -> Self {
        ControllerFile {
            holds_current: true,
            feedforward: true,
            six_step: false,
            pole_pairs: 8,
            inductance_h: 0.5e-3,
            bandwidth_rad_s: 2000.0,
            feedback_a_s_per_rad: 0.3,
            feedback_a_per_rad: 0.05,
            acceleration_v_m_s2: 3.0,
            acceleration_vn_m_s2: 3.0,
            acceleration_w_rad_s2: 30.0,
            under_voltage_v: None,
            over_voltage_v: None,
            amps_per_count: 0.0049,
            bus_volts_per_count: 0.00886,
            linear_range_a: 9.4,
            continuous_current_a: None,
            heating_time_s: 10.0,
            gyro_rad_s_per_count: None,
            encoder_rad_per_count: None,
        }
    }
}

const KEYS: [&str; 20] = [
    "mode",
    "feedforward",
    "commutation",
    "pole_pairs",
    "inductance_H",
    "bandwidth_rad_s",
    "feedback_A_s_per_rad",
    "feedback_A_per_rad",
    "acceleration_v_m_s2",
    "acceleration_vn_m_s2",
    "acceleration_w_rad_s2",
    "under_voltage_V",
    "over_voltage_V",
    "amps_per_count",
    "bus_volts_per_count",
    "linear_range_A",
    "continuous_current_A",
    "heating_time_s",
    "gyro_rad_s_per_count",
    "encoder_rad_per_count",
];

pub(super) fn controller(s: &Section) -> Result<ControllerFile> {
    s.only_keys(&KEYS)?;
    let default = ControllerFile::default();
    let positive = |key: &str, default: f64| s.number(key)?.map_or(Ok(default), |_| s.positive(key));
    let perhaps = |key: &str| s.number(key)?.map(|_| s.positive(key)).transpose();
    let either_sign = |key: &str| {
        s.number(key)?.map(|x| s.checked(key, x, x != 0.0, "a number above zero or below, or no such key")).transpose()
    };
    let pole_pairs = match s.whole("pole_pairs")? {
        None => default.pole_pairs,
        Some(pairs @ 1..=50) => pairs as u8,
        Some(pairs) => {
            let problem = format!("found {pairs}, expected 1 to 50");
            return Err(s.key_error("pole_pairs", problem, "Count the electrical turns in a turn of the motor"));
        }
    };
    Ok(ControllerFile {
        holds_current: one_of(s, "mode", ["voltage", "current"], default.holds_current)?,
        feedforward: s.flag("feedforward")?.unwrap_or(default.feedforward),
        six_step: one_of(s, "commutation", ["field_oriented", "six_step"], default.six_step)?,
        pole_pairs,
        inductance_h: positive("inductance_H", default.inductance_h)?,
        bandwidth_rad_s: positive("bandwidth_rad_s", default.bandwidth_rad_s)?,
        feedback_a_s_per_rad: s.not_negative("feedback_A_s_per_rad", default.feedback_a_s_per_rad)?,
        feedback_a_per_rad: s.not_negative("feedback_A_per_rad", default.feedback_a_per_rad)?,
        acceleration_v_m_s2: positive("acceleration_v_m_s2", default.acceleration_v_m_s2)?,
        acceleration_vn_m_s2: positive("acceleration_vn_m_s2", default.acceleration_vn_m_s2)?,
        acceleration_w_rad_s2: positive("acceleration_w_rad_s2", default.acceleration_w_rad_s2)?,
        under_voltage_v: perhaps("under_voltage_V")?,
        over_voltage_v: perhaps("over_voltage_V")?,
        amps_per_count: amps_per_count(s, default.amps_per_count)?,
        bus_volts_per_count: positive("bus_volts_per_count", default.bus_volts_per_count)?,
        linear_range_a: positive("linear_range_A", default.linear_range_a)?,
        continuous_current_a: perhaps("continuous_current_A")?,
        heating_time_s: positive("heating_time_s", default.heating_time_s)?,
        gyro_rad_s_per_count: either_sign("gyro_rad_s_per_count")?,
        encoder_rad_per_count: either_sign("encoder_rad_per_count")?,
    })
}

/// A number of either sign, but not zero.
fn amps_per_count(s: &Section, default: f64) -> Result<f64> {
    let amps = s.number("amps_per_count")?.unwrap_or(default);
    s.checked("amps_per_count", amps, amps != 0.0, "a number above zero, or below where the code falls")
}

/// Whether the second of two words stands there.
fn one_of(s: &Section, key: &str, [no, yes]: [&str; 2], default: bool) -> Result<bool> {
    match s.text(key)? {
        None => Ok(default),
        Some(word) if word == no => Ok(false),
        Some(word) if word == yes => Ok(true),
        Some(word) => {
            let problem = format!("found `{word}`, expected \"{no}\" or \"{yes}\"");
            Err(s.key_error(key, problem, "Write one of the two"))
        }
    }
}
