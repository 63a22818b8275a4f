//! How large the gap is, and how far it closes.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Errors of free runs, RMS in units of each sensor's nominal sigma.
#[derive(Clone, Debug, Default, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Gap {
    /// Error per signal group: `i`, `w`, `pose`; a group that is not logged is left out.
    pub signals: BTreeMap<String, SignalGap>,
    /// Window lengths at which the error was measured (s).
    pub horizons_s: Vec<f64>,
    /// Total error at each of these lengths.
    #[serde(default)]
    pub curves: Vec<HorizonError>,
}

/// Error of one signal group (sigma).
#[derive(Clone, Copy, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct SignalGap {
    /// With the nominal model.
    pub before: f64,
    /// With the corrected model.
    pub after: f64,
    /// With a perfect model and the same noise.
    pub noise_floor: f64,
}

/// Total error over windows of one length (sigma).
#[derive(Clone, Copy, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct HorizonError {
    /// Window length (s).
    pub horizon_s: f64,
    /// With the nominal model.
    pub before: f64,
    /// With the corrected model.
    pub after: f64,
    /// With a perfect model and the same noise, where it was computed.
    pub noise_floor: Option<f64>,
}

/// How far the causes close the gap, on runs held out (sigma; fractions 0 to 1).
#[derive(Clone, Debug, Default, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Shrink {
    /// Error of the nominal model.
    pub before: Option<f64>,
    /// Error of the corrected model.
    pub after: Option<f64>,
    /// Error of a perfect model with the same noise.
    pub noise_floor: Option<f64>,
    /// (before − after) / (before − noise_floor).
    pub closed: Option<f64>,
    /// Why `closed` is null.
    pub reason: Option<String>,
    /// 95 % interval of `closed`.
    pub closed_ci95: Option<[f64; 2]>,
    /// What fitting the nominal parameters alone closes.
    pub closed_by_refit_alone: Option<f64>,
    /// What the second-best cause closes.
    pub closed_by_runner_up: Option<f64>,
    /// What the best model that was found closes with a flexible one on top, which is told nothing of physics: about the most that
    /// could be had. A gap of less than 0.1 σ counts as one of 0.1 σ here.
    pub closed_by_flexible_model: Option<f64>,
    /// Excess: what the best model that was found leaves beyond the error of its starts, as a multiple of what noise alone would
    /// leave, of the signal group where it is largest. One where the model is the truth; null in reports made before.
    #[serde(default)]
    pub excess: Option<f64>,
}
