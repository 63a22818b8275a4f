//! # Speed from the time between edges
//!
//! A drive with hall sensors alone knows the speed when an edge comes: a whole interval over the time it took. Such a
//! number is the mean speed of the interval that has just ended, so it is exact (up to a change of the acceleration)
//! for the middle of that interval, and it stays what it is until the next edge. Left as logged it would lag by half an
//! interval and count once a row. Here every number is told once, on the row nearest to the middle of its interval:
//!
//! ```text
//! ω̄ = (2π/n)/τ,   ω(t_edge − τ/2) = ω̄ + O(τ²·d²ω/dt²/24)
//! ```

use super::channel::{Channel, Missing};
use std::f64::consts::TAU;

/// The speeds (rad/s) of a channel that holds the last one until the next edge, each on the row where it is true.
///
/// `t_s` is the time of each row (s), `edges_per_turn` how many edges a turn of the wheel has. A number equal to the one
/// before is the same one held. Rows without a number of their own are missing as stale.
pub(crate) fn retimed(held: &Channel, t_s: &[f64], edges_per_turn: f64) -> Channel {
    let told = speeds_on_rows(&intervals(held, t_s, edges_per_turn), t_s);
    told.into_iter().map(|speed| speed.ok_or(Missing::Stale)).collect()
}

/// The speeds (rad/s) of intervals between edges, each on the row nearest to its middle, moved there along the slope of
/// the intervals around it; none on other rows. Middles lie within the rows' times `t_s` (s) and grow.
pub(crate) fn speeds_on_rows(intervals: &[EdgeInterval], t_s: &[f64]) -> Vec<Option<f64>> {
    let mut told = vec![None; t_s.len()];
    for (k, now) in intervals.iter().enumerate() {
        let after = t_s.partition_point(|t| *t < now.middle_s).min(t_s.len() - 1);
        let before_is_nearer = after > 0 && now.middle_s - t_s[after - 1] < t_s[after] - now.middle_s;
        let row = if before_is_nearer { after - 1 } else { after };
        let around = intervals.get(k.wrapping_sub(1)).zip(intervals.get(k + 1));
        let slope = around.map_or(0.0, |(a, b)| (b.speed - a.speed) / (b.middle_s - a.middle_s));
        told[row] = Some(now.speed + slope * (t_s[row] - now.middle_s));
    }
    told
}

/// An interval between two edges of a wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EdgeInterval {
    /// Its middle (s)
    pub middle_s: f64,
    /// Mean speed (rad/s)
    pub speed: f64,
}

fn intervals(held: &Channel, t_s: &[f64], edges_per_turn: f64) -> Vec<EdgeInterval> {
    let mut all: Vec<EdgeInterval> = Vec::new();
    let mut last = None;
    for (row, speed) in held.present() {
        let is_new = last.is_some_and(|before: f64| before != speed);
        last = Some(speed);
        if !is_new || speed == 0.0 {
            continue;
        }
        // the edge came somewhere between the row before and this one, and an interval shorter than a row is not seen
        let row_s = t_s[row] - t_s[row.saturating_sub(1)];
        let interval_s = (TAU / edges_per_turn / speed.abs()).max(row_s);
        let middle_s = t_s[row] - 0.5 * (row_s + interval_s);
        // two edges of one row's length may seem to come in the wrong order
        if all.last().is_none_or(|before| before.middle_s < middle_s) {
            all.push(EdgeInterval { middle_s, speed });
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a drive logs of a wheel at angle φ(t): the mean speed of the last whole interval, held.
    fn logged(angle: impl Fn(f64) -> f64, t_s: &[f64], edges_per_turn: f64) -> Channel {
        let (edge, fine_s) = (TAU / edges_per_turn, 1e-5);
        let (mut t, mut last, mut count, mut speed) = (0.0, None, 0.0, 0.0);
        let mut rows = Vec::new();
        for row_s in t_s {
            while t <= *row_s {
                let (before, after) = (angle(t), angle(t + fine_s));
                let now = (after / edge).floor();
                if now != count {
                    let crossed_s = t + fine_s * (now * edge - before) / (after - before);
                    if let Some(since_s) = last {
                        speed = (now - count) * edge / (crossed_s - since_s);
                    }
                    (last, count) = (Some(crossed_s), now);
                }
                t += fine_s;
            }
            rows.push(speed);
        }
        Channel::from_values(rows)
    }

    #[test]
    fn an_accelerating_wheel_is_read_without_the_lag_of_its_edges() {
        let t_s: Vec<f64> = (0..1000).map(|k| f64::from(k) * 1e-3).collect();
        let (start, slope) = (2.0, 20.0);
        let held = logged(|t| start * t + 0.5 * slope * t * t, &t_s, 240.0);
        let lag = |c: &Channel| {
            let off: Vec<f64> = c.present().skip(50).map(|(k, w)| w - (start + slope * t_s[k])).collect();
            off.iter().sum::<f64>() / off.len() as f64
        };
        let fresh = retimed(&held, &t_s, 240.0);
        // half an interval and half a row at 20 rad/s²: 1 to 6 ms, some 0.04 rad/s; less than a tenth of a row is left
        assert!(lag(&held) < -0.03, "{}", lag(&held));
        assert!(lag(&fresh).abs() < 0.1 * 1e-3 * slope, "{}", lag(&fresh));
    }

    #[test]
    fn a_number_that_is_held_counts_once() {
        let t_s = [0.0, 0.01, 0.02, 0.03, 0.04, 0.05];
        let held = Channel::from_values([0.0, 5.0, 5.0, 5.0, 6.0, 6.0]);
        let fresh = retimed(&held, &t_s, 240.0);
        assert_eq!(fresh.present().map(|(_, w)| w).collect::<Vec<_>>(), [5.0, 6.0]);
        assert_eq!(fresh.len(), t_s.len());
    }
}
