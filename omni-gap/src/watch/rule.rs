//! When a gap is one.

use crate::simulate::HORIZON_S;

/// How windows are laid, and when they are an alarm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rule {
    /// Length of a window [s]
    pub window_s: f64,
    /// Time between restarts of the free runs within a window [s]
    pub horizon_s: f64,
    /// How many times each window is simulated from the model.
    pub simulated: u32,
    /// What a window above the limit adds to the score of its stage; one within it takes one off.
    pub gain: u32,
    /// The score that is an alarm, and the largest that there is.
    pub alarm_at: u32,
    /// An error that is larger than its floor by less than this is none [σ]
    pub margin_sigma: f64,
    /// The largest share of a window's rows that may have got lost; with more it is not judged
    pub most_lost: f64,
}

impl Default for Rule {
    fn default() -> Self {
        Self {
            window_s: 1.0,
            horizon_s: HORIZON_S,
            simulated: 19,
            gain: 3,
            alarm_at: 18,
            margin_sigma: 0.1,
            most_lost: 0.05,
        }
    }
}

impl Rule {
    /// The score after a window.
    pub fn scored(&self, score: u32, above: bool) -> u32 {
        if above { (score + self.gain).min(self.alarm_at) } else { score.saturating_sub(1) }
    }

    /// The probability, at most, that a stage that fits begins an alarm at a window: Lundberg's bound z^−h, where
    /// p·z^(gain + 1) − z + 1 − p = 0, z > 1, and p is the share of such windows that are above.
    pub fn false_alarm(&self) -> f64 {
        let p = 1.0 / (f64::from(self.simulated) + 1.0);
        let excess = |z: f64| p * z.powi(self.gain as i32 + 1) - z + 1.0 - p;
        // below zero between one and the root, above zero beyond it
        let (mut low, mut high) = (1.0 + 1e-6, 1.0 / p);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if excess(middle) < 0.0 { low = middle } else { high = middle }
        }
        low.powi(-(self.alarm_at as i32))
    }

    /// Time between two false alarms of a robot with so many stages, at least [h]
    pub fn hours_between_false_alarms(&self, stages: usize) -> f64 {
        self.window_s / (self.false_alarm() * stages.max(1) as f64) / 3600.0
    }

    /// Until when a change that every window shows is told, at the latest, after it happened [s]
    pub fn told_within_s(&self) -> f64 {
        f64::from(self.alarm_at.div_ceil(self.gain) + 1) * self.window_s
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    #[test]
    fn false_alarms_are_no_more_than_the_bound_says_and_not_far_fewer() {
        // a low threshold, so that there are alarms to count: 200 000 windows of which one in twenty is above
        let rule = Rule { alarm_at: 8, ..Rule::default() };
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let (mut score, mut alarms, windows) = (0, 0.0, 200_000);
        for _ in 0..windows {
            score = rule.scored(score, random.random_bool(0.05));
            if score == rule.alarm_at {
                (score, alarms) = (0, alarms + 1.0);
            }
        }
        let share = alarms / f64::from(windows);
        assert!(share <= rule.false_alarm() && share > 0.1 * rule.false_alarm(), "{share} {}", rule.false_alarm());
    }

    #[test]
    fn the_bound_is_the_root_of_its_equation() {
        // steps of one up and one down: z = q/p
        let rule = Rule { gain: 1, alarm_at: 5, ..Rule::default() };
        assert!((rule.false_alarm() * 19_f64.powi(5) - 1.0).abs() < 1e-9);
        // gain 3: z³ + z² + z = q/p = 19
        let z = Rule { alarm_at: 1, ..Rule::default() }.false_alarm().recip();
        assert!((z * z * z + z * z + z - 19.0).abs() < 1e-9, "{z}");
        assert!(Rule::default().hours_between_false_alarms(3) > 100.0);
        assert_eq!(Rule::default().told_within_s(), 7.0);
    }
}
