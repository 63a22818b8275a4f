//! How scores become probabilities, and probabilities calibrated ones.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How scores become probabilities.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(default)]
pub struct ProbabilityKnobs {
    /// Score differences are divided by this [1]: they are worth less than their face, models are never quite right.
    pub temperature: f64,
    /// What the plain model is given, in score, against any one of many causes [1]: about 2·ln of their number, and as
    /// much again for what was tried of each.
    pub head_start: f64,
    /// How likely an unknown cause is where there is no gap [1].
    pub unknown_without_gap: f64,
    /// Width over which `unknown` fades as more than the least share is closed [1]. By trial.
    pub unknown_width: f64,
    /// How sure it is that a cause is known whose model misses no more than noise does, as ln(p/(1 − p)) [1]: 99 %.
    pub adequate: f64,
    /// What answers so probable turned out to be.
    pub calibration: CalibrationKnobs,
}

/// How often answers of each kind were right, by the probability that scores gave them (Platt 1999); fitted on recordings whose
/// truth is known, by `bench calibrate`.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(default)]
pub struct CalibrationKnobs {
    /// What the lines were fitted on.
    pub made_of: String,
    /// Of the cause named first.
    pub named: LogitLine,
    /// Of `unknown`.
    pub unknown: LogitLine,
    /// Of `no_gap`.
    pub no_gap: LogitLine,
}

/// ln(p/(1 − p)) = slope·ln(p₀/(1 − p₀)) + offset
#[derive(Clone, Copy, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct LogitLine {
    /// How much is kept of what the scores say [1]
    pub slope: f64,
    /// How sure an answer is about which the scores say one half [1]
    pub offset: f64,
}

impl LogitLine {
    /// What the scores say is kept.
    pub const AS_IT_IS: Self = Self { slope: 1.0, offset: 0.0 };

    /// The calibrated probability.
    pub fn of(&self, probability: f64) -> f64 {
        1.0 / (1.0 + (-(self.slope * logit(probability) + self.offset)).exp())
    }

    /// The probability by the scores, of a calibrated one.
    pub fn undone(&self, calibrated: f64) -> f64 {
        1.0 / (1.0 + (-(logit(calibrated) - self.offset) / self.slope).exp())
    }
}

/// ln(p/(1 − p)), of p no nearer to 0 or 1 than numbers are to each other.
pub fn logit(probability: f64) -> f64 {
    let p = probability.clamp(f64::EPSILON, 1.0 - f64::EPSILON);
    (p / (1.0 - p)).ln()
}

impl Default for ProbabilityKnobs {
    fn default() -> Self {
        Self {
            temperature: 3.0,
            head_start: 12.0,
            unknown_without_gap: 0.01,
            unknown_width: 0.08,
            adequate: 4.6,
            calibration: CalibrationKnobs::default(),
        }
    }
}

impl Default for CalibrationKnobs {
    fn default() -> Self {
        Self {
            made_of: "120 answers to every tenth session of the tuning split, 24 November 2026".to_owned(),
            named: LogitLine { slope: 0.239, offset: 0.549 },
            unknown: LogitLine { slope: 0.05, offset: 0.415 },
            no_gap: LogitLine { slope: 0.05, offset: 1.104 },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_keeps_the_order_of_probabilities_and_can_be_undone() {
        let line = LogitLine { slope: 0.4, offset: -0.3 };
        let all = [0.01, 0.3, 0.5, 0.97].map(|p| line.of(p));
        assert!(all.windows(2).all(|pair| pair[0] < pair[1]), "{all:?}");
        assert!((line.undone(line.of(0.83)) - 0.83).abs() < 1e-12);
        assert!((LogitLine::AS_IT_IS.of(0.2) - 0.2).abs() < 1e-12);
    }

    #[test]
    fn nothing_is_certain() {
        assert!(LogitLine::AS_IT_IS.of(1.0) < 1.0 && LogitLine::AS_IT_IS.of(0.0) > 0.0);
    }
}
