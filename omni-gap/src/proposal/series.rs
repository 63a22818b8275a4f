//! # Numbers over time

use crate::log::Channel;

/// How far something went by each instant: the integral of a rate, or a running count.
#[derive(Debug, Clone)]
pub(super) struct Way {
    t_s: Vec<f64>,
    way: Vec<f64>,
}

/// Longer than this between two samples nobody knows what was in it (s).
const GAP_S: f64 = 0.25;

impl Way {
    /// The integral of a rate, by trapezoids.
    pub fn of_rate(t_s: &[f64], rate: &Channel) -> Way {
        let mut way = Way { t_s: Vec::new(), way: Vec::new() };
        let mut last: Option<(f64, f64)> = None;
        for (row, value) in rate.present() {
            let t = t_s[row];
            let step = last.map_or(0.0, |(before_t, before)| 0.5 * (before + value) * (t - before_t));
            way.way.push(way.way.last().copied().unwrap_or(0.0) + step);
            way.t_s.push(t);
            last = Some((t, value));
        }
        way
    }

    /// A running count, or counts of each sample added up.
    pub fn of_counts(t_s: &[f64], counts: &Channel, running: bool) -> Way {
        let mut sum = 0.0;
        let at = |(_, value): (usize, f64)| match running {
            true => value,
            false => {
                sum += value;
                sum
            }
        };
        Way { t_s: counts.present().map(|(row, _)| t_s[row]).collect(), way: counts.present().map(at).collect() }
    }

    /// The mean rate between two instants (s); none beyond the ends or across a gap.
    pub fn rate(&self, from_s: f64, to_s: f64) -> Option<f64> {
        Some((self.at(to_s)? - self.at(from_s)?) / (to_s - from_s))
    }

    fn at(&self, time_s: f64) -> Option<f64> {
        let after = self.t_s.partition_point(|t| *t < time_s);
        let next_s = *self.t_s.get(after)?;
        if after == 0 {
            return (next_s == time_s).then(|| self.way[0]);
        }
        let before_s = self.t_s[after - 1];
        let share = (time_s - before_s) / (next_s - before_s);
        (next_s - before_s < GAP_S).then(|| self.way[after - 1] + share * (self.way[after] - self.way[after - 1]))
    }

    /// Its first and its last instant (s).
    pub fn span(&self) -> Option<(f64, f64)> {
        Some((*self.t_s.first()?, *self.t_s.last()?))
    }
}

/// How two signals go together: sums of their products.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Together {
    aa: f64,
    bb: f64,
    ab: f64,
}

impl Together {
    /// Adds two channels of the same rows.
    pub fn add(&mut self, a: &Channel, b: &Channel) {
        for (a, b) in a.iter().zip(b.iter()) {
            let (Ok(a), Ok(b)) = (a, b) else { continue };
            self.aa += a * a;
            self.bb += b * b;
            self.ab += a * b;
        }
    }

    /// How well, from −1 to 1.
    pub fn fit(&self) -> f64 {
        let both = (self.aa * self.bb).sqrt();
        if both > 0.0 { self.ab / both } else { 0.0 }
    }

    /// How many times the second the first is: by the regression of the first on the second, which noise of the second makes
    /// too small, and of the second on the first, which all makes too large that the second does not tell of the first.
    pub fn times(&self) -> (f64, f64) {
        (self.ab.abs() / self.bb, self.aa / self.ab.abs())
    }
}

/// The largest size of a channel's numbers.
pub(super) fn largest(values: &Channel) -> f64 {
    values.present().map(|(_, value)| value.abs()).fold(0.0, f64::max)
}

/// The step that all numbers of a channel are multiples of, where it is coarse: at most so many steps are in use.
pub(super) fn quantum(values: &Channel) -> Option<f64> {
    let mut seen: Vec<f64> = values.present().map(|(_, value)| value).collect();
    seen.sort_by(f64::total_cmp);
    seen.dedup();
    let steps: Vec<f64> = seen.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let least = steps.iter().copied().fold(f64::INFINITY, f64::min);
    let whole = |step: &f64| ((step / least) - (step / least).round()).abs() < 0.02;
    let few = seen.len() * 4 < values.len() && seen.len() > 3;
    (few && least.is_finite() && least > 0.0 && steps.iter().all(whole)).then_some(least)
}
