//! The figures as data. The field names are those of `validation.json`; readers rely on them.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::signal::Signal;

/// The version of the form of `validation.json` that this program writes.
pub const SCHEMA: u32 = 1;

/// A model beside all runs of a session.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Validation {
    /// Version of this form.
    pub schema: u32,
    /// Name of the robot, from its file.
    pub robot: String,
    /// Name of the session folder.
    pub session: Option<String>,
    /// Run by run, those held out last.
    pub runs: Vec<RunFigures>,
    /// Every signal over all runs, each run about its own mean.
    pub all_runs: Vec<SignalFigures>,
    /// The signal that lacks most of the fit that its noise allows.
    pub worst: Option<Worst>,
    /// Errors of free runs restarted every horizon, over all runs.
    pub horizons: Vec<HorizonFigures>,
    /// What the reader should know.
    pub notices: Vec<String>,
}

/// One run.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct RunFigures {
    /// Its name.
    pub run: String,
    /// Whether it stands among the runs that no fit may see.
    pub held_out: bool,
    /// Rows.
    pub rows: usize,
    /// From the first row to the last [s]
    pub duration_s: f64,
    /// The recorded signal that drives the model: `u`, `i`, `w` or `wset`, as its columns are named.
    pub driven_by: String,
    /// What the measured v, vn and ω were taken from; none where neither is logged.
    pub speeds_from: Option<SpeedsFrom>,
    /// The signals that were compared.
    pub signals: Vec<SignalFigures>,
    /// What was logged and yet not compared, with the reason.
    pub not_compared: Vec<String>,
}

/// What the measured speeds of the body were taken from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SpeedsFrom {
    /// The wheel speeds, by least squares.
    WheelSpeeds,
    /// The slope of straight lines through the pose.
    Pose,
}

/// How near one signal comes. What ends in `_si` is in the unit that the signal's name carries.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct SignalFigures {
    /// The signal.
    pub signal: Signal,
    /// How many samples were compared.
    pub samples: usize,
    /// 100·(1 − ‖y − ŷ‖/‖y − ȳ‖) [%]
    pub fit_percent: Option<f64>,
    /// Why there is no fit.
    pub no_fit: Option<String>,
    /// The fit of a perfect model under the stated noise [%]
    pub noise_allows_percent: Option<f64>,
    /// RMS of measured minus simulated.
    pub rms_si: f64,
    /// The same in units of the measurement's sigma.
    pub rms_sigma: f64,
    /// The largest |measured − simulated|.
    pub largest_error_si: f64,
    /// The measurement's sigma; for v, vn and ω that of the sensors behind them, RMS over the samples.
    pub sigma_si: f64,
}

/// The signal that lacks most of the fit that its noise allows.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Worst {
    /// The signal.
    pub signal: Signal,
    /// The run.
    pub run: String,
    /// Its fit [%]
    pub fit_percent: f64,
    /// The fit of a perfect model under the stated noise [%]
    pub noise_allows_percent: f64,
}

/// Errors of free runs restarted every `horizon_s`.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct HorizonFigures {
    /// Time between restarts [s]
    pub horizon_s: f64,
    /// RMS over the groups.
    pub total: GroupError,
    /// Each signal group that was compared: `i`, `w`, `pose`.
    pub groups: BTreeMap<String, GroupError>,
}

/// An error and what noise alone would give.
#[derive(Clone, Copy, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct GroupError {
    /// RMS of measured minus simulated in units of the sensor's sigma.
    pub rms_sigma: f64,
    /// The same, were the model the truth.
    pub noise_floor_sigma: f64,
}

impl Validation {
    /// The text of `validation.json`; the same figures always give the same bytes.
    pub fn to_json(&self) -> serde_json::Result<String> {
        serde_json::to_string_pretty(self).map(|text| text + "\n")
    }

    /// A signal over all runs.
    pub fn over_all(&self, signal: Signal) -> Option<&SignalFigures> {
        self.all_runs.iter().find(|f| f.signal == signal)
    }
}

impl RunFigures {
    /// A signal of this run.
    pub fn signal(&self, signal: Signal) -> Option<&SignalFigures> {
        self.signals.iter().find(|f| f.signal == signal)
    }
}

impl SignalFigures {
    /// What is missing from the fit that noise allows, in points of per cent.
    pub fn lacking(&self) -> Option<f64> {
        Some(self.noise_allows_percent? - self.fit_percent?)
    }
}

/// The signal that lacks most. Poses stand aside: over a whole run they sum up every error of speed.
pub(super) fn worst(runs: &[RunFigures]) -> Option<Worst> {
    let all = runs.iter().flat_map(|run| run.signals.iter().map(move |figures| (run, figures)));
    let able = all.filter(|(_, f)| !f.signal.is_pose()).filter_map(|(run, f)| Some((run, f, f.lacking()?)));
    let (run, figures, _) = able.max_by(|a, b| a.2.total_cmp(&b.2))?;
    Some(Worst {
        signal: figures.signal,
        run: run.run.clone(),
        fit_percent: figures.fit_percent?,
        noise_allows_percent: figures.noise_allows_percent?,
    })
}
