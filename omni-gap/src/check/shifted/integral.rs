//! A signal's means over spans of time, shifted by this and that.

use crate::log::{Channel, Run};

/// What a signal holds between two rows.
#[derive(Clone, Copy)]
pub(super) enum Between {
    /// The value of the row before: a command.
    Held,
    /// A straight line: a measurement.
    Line,
}

/// The means of a signal over spans (from, to) [s], for each shift [s] one for each span; a hole has the value before it. Every
/// shifted span lies within the run.
pub(super) fn means(
    run: &Run,
    channel: &Channel,
    between: Between,
    spans: &[(f64, f64)],
    shifts: &[f64],
) -> Vec<Vec<f64>> {
    let integral = Integral::of(&run.t_s, channel, between);
    let of = |shift: &f64| spans.iter().map(|(from, to)| integral.mean(from - shift, to - shift)).collect();
    shifts.iter().map(of).collect()
}

/// ∫ x dt from the first row on [unit of x times s].
struct Integral<'a> {
    t_s: &'a [f64],
    sum: Vec<f64>,
}

impl<'a> Integral<'a> {
    fn of(t_s: &'a [f64], channel: &Channel, between: Between) -> Self {
        let (mut sum, mut total, mut before) = (Vec::with_capacity(t_s.len()), 0.0, 0.0);
        for (row, t) in t_s.iter().enumerate() {
            let now = channel.get(row).unwrap_or(before);
            if row > 0 {
                let mean = match between {
                    Between::Held => before,
                    Between::Line => 0.5 * (before + now),
                };
                total += mean * (t - t_s[row - 1]);
            }
            sum.push(total);
            before = now;
        }
        Self { t_s, sum }
    }

    /// The mean from one time to a later one, both within the run.
    fn mean(&self, from_s: f64, to_s: f64) -> f64 {
        (self.at(to_s) - self.at(from_s)) / (to_s - from_s)
    }

    fn at(&self, t: f64) -> f64 {
        let after = self.t_s.partition_point(|at| *at < t).clamp(1, self.t_s.len() - 1);
        let (from, to) = (self.t_s[after - 1], self.t_s[after]);
        self.sum[after - 1] + (t - from) / (to - from) * (self.sum[after] - self.sum[after - 1])
    }
}
