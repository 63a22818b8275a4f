//! In which regime of the motion the error is largest: a fixed menu of features, each cut into equal parts.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::simulate::{AlignedRun, Prediction};

/// A part of a feature's range that holds more than its share of the error.
#[derive(Clone, Debug)]
pub struct Hotspot {
    /// Name of the feature, for programs.
    pub feature: &'static str,
    /// Lower end of the part, in the feature's unit; `None` where it is open.
    pub low: Option<f64>,
    /// Upper end; `None` where it is open.
    pub high: Option<f64>,
    /// Share of the error in the part.
    pub share: f64,
    /// In words, to follow "where …".
    pub text: String,
}

/// What counts as a hotspot.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(default)]
pub struct RegimeSettings {
    /// Equal parts of the samples into which each feature's range is cut [parts]: fine enough to say low, middle or high.
    pub parts: usize,
    /// Samples that each part has to have, at the least [samples]: fewer say nothing of a share.
    pub fewest_samples: usize,
    /// A part that holds less than this of the error is no hotspot [1]: a fifth of the samples hold a fifth by chance.
    pub notable: f64,
    /// A part that is no wider than this, in the feature's unit, says nothing: a robot at rest for most of the time.
    pub least_width: f64,
}

impl Default for RegimeSettings {
    fn default() -> Self {
        Self { parts: 5, fewest_samples: 10, notable: 0.35, least_width: 1e-9 }
    }
}

struct Feature {
    name: &'static str,
    words: &'static str,
    unit: &'static str,
}

const FEATURES: [Feature; 5] = [
    Feature { name: "wheel_speed", words: "|wheel speed|", unit: "rad/s" },
    Feature { name: "current", words: "|current|", unit: "A" },
    Feature { name: "wheel_acceleration", words: "|wheel acceleration|", unit: "rad/s²" },
    Feature { name: "turning", words: "|yaw rate × speed|", unit: "m/s²" },
    Feature { name: "heading", words: "heading modulo a turn", unit: "rad" },
];

/// The hotspots of a prediction's error on its wheel speeds and currents (on the pose where neither was measured), the
/// strongest first.
pub fn regimes<const N: usize>(runs: &[(&AlignedRun<N>, &Prediction)], settings: &RegimeSettings) -> Vec<Hotspot> {
    let mut samples: Vec<([f64; FEATURES.len()], f64)> = Vec::new();
    let channels = AlignedRun::<N>::channels();
    let [x, y, theta] = channels.pose();
    for (run, prediction) in runs {
        for row in 1..run.rows() {
            let p = &prediction.rows[row];
            let span = (run.t[row] - run.t[row - 1]).max(1e-6);
            let restarted = prediction.restarts.contains(&row);
            for j in 0..N {
                let (i, w) = (channels.current(j), channels.wheel_speed(j));
                let own: Vec<usize> = [i, w].into_iter().filter(|c| run.saw(row, *c)).collect();
                if own.is_empty() {
                    continue;
                }
                let error: f64 = own.iter().map(|c| run.error(row, *c, p[*c]).powi(2)).sum();
                let before = &prediction.rows[row - 1];
                let rate = if restarted { 0.0 } else { (p[w] - before[w]) / span };
                let speed = (p[x] - before[x]).hypot(p[y] - before[y]) / span;
                let yaw = (p[theta] - before[theta]) / span;
                let turning = if restarted { 0.0 } else { (speed * yaw).abs() };
                let heading = p[theta].rem_euclid(std::f64::consts::TAU);
                samples.push(([p[w].abs(), p[i].abs(), rate.abs(), turning, heading], error));
            }
        }
    }
    let mut found: Vec<Hotspot> = (0..FEATURES.len()).filter_map(|f| hotspot(f, &samples, settings)).collect();
    found.sort_by(|a, b| b.share.total_cmp(&a.share));
    found
}

fn hotspot(f: usize, samples: &[([f64; FEATURES.len()], f64)], settings: &RegimeSettings) -> Option<Hotspot> {
    let RegimeSettings { parts, fewest_samples, notable, least_width } = *settings;
    let total: f64 = samples.iter().map(|s| s.1).sum();
    let mut sorted: Vec<(f64, f64)> = samples.iter().map(|(x, e)| (x[f], *e)).collect();
    if sorted.len() < fewest_samples * parts || total <= 0.0 {
        return None;
    }
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let size = sorted.len() / parts;
    let part = |k: usize| &sorted[k * size..if k + 1 == parts { sorted.len() } else { (k + 1) * size }];
    let shares: Vec<f64> = (0..parts).map(|k| part(k).iter().map(|s| s.1).sum::<f64>() / total).collect();
    let (k, share) = shares.into_iter().enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let (low, high) = (part(k)[0].0, part(k)[part(k).len() - 1].0);
    if share < notable || high - low <= least_width {
        return None;
    }
    let Feature { name, words, unit } = FEATURES[f];
    let low = (k > 0).then_some(low);
    let high = (k + 1 < parts).then_some(high);
    let text = match (low, high) {
        (None, Some(high)) => format!("{words} < {high:.2} {unit}"),
        (Some(low), None) => format!("{words} > {low:.2} {unit}"),
        (low, high) => format!("{:.2} < {words} < {:.2} {unit}", low.unwrap_or(0.0), high.unwrap_or(0.0)),
    };
    Some(Hotspot { feature: name, low, high, share, text })
}
