//! # Wheel speeds from hall edges
//!
//! A record counts edges and says how long ago the last one was, so an interval between two edges is known as a whole:
//! its length, and its middle. Its mean speed is told once (`log/edges.rs`).
//!
//! ```text
//! ω̄ = n·φ/τ,   ω(middle) = ω̄ + O(τ²·d²ω/dt²/24),   σ(ω̄) = ω·Δt/(√6·τ)
//! ```
//!
//! n edges of φ each took τ. An edge is seen at the next look, up to Δt later: half of that is taken off its time, and
//! what is left is the noise. τ is 4 ms or more, so that at Δt = 50 µs the noise stays below 0.5 % of the speed.

use std::f64::consts::TAU;

use model_core::link::record::TelemetryRecord;

use crate::log::edges::EdgeInterval;

/// The shortest interval that is told [s]
const SHORTEST_S: f64 = 4e-3;

/// The longest: a wheel that took longer from edge to edge may have stood [s]
const LONGEST_S: f64 = 0.1;

/// An edge: its number, and when it was crossed [s]
#[derive(Clone, Copy, Debug)]
struct Edge {
    number: i64,
    t: f64,
}

/// Edges in a turn of the wheel.
pub fn edges_per_turn(pole_pairs: u8, gear_ratio: f64) -> f64 {
    6.0 * f64::from(pole_pairs) * gear_ratio
}

/// The intervals between a wheel's edges, from its records and their times [s].
///
/// `period` is the time between two looks at the halls [s].
pub fn intervals(
    records: &[TelemetryRecord],
    t: &[f64],
    wheel: usize,
    period: f64,
    edges_per_turn: f64,
) -> Vec<EdgeInterval> {
    let angle = TAU / edges_per_turn;
    let mut all = Vec::new();
    let (mut count, mut from): (i64, Option<Edge>) = (0, None);
    for (pair, times) in records.windows(2).zip(t.windows(2)) {
        let moved = i64::from(pair[1].edges[wheel].wrapping_sub(pair[0].edges[wheel]));
        let before = count;
        count += moved;
        let since = f64::from(pair[1].since_edge[wheel]);
        let crossed_at = times[1] - (since + 0.5) * period;
        if moved == 0 {
            // an edge that came and went back: where the wheel turned round is not known
            if crossed_at > times[0] {
                from = None;
            }
            continue;
        }
        // edge k lies between the counts k − 1 and k
        let number = if count > before { count } else { count + 1 };
        let now = Edge { number, t: crossed_at };
        let Some(start) = from else {
            from = Some(now);
            continue;
        };
        let length = now.t - start.t;
        if now.number == start.number || length > LONGEST_S {
            from = Some(now);
        } else if length >= SHORTEST_S {
            let speed = (now.number - start.number) as f64 * angle / length;
            all.push(EdgeInterval { middle_s: 0.5 * (now.t + start.t), speed });
            from = Some(now);
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::log::edges::speeds_on_rows;

    const PERIOD: f64 = 50e-6;
    const EDGES: f64 = 240.0;

    /// The records of a wheel whose angle is φ(t), looked at every 50 µs and told every 1 ms.
    fn recorded(angle: impl Fn(f64) -> f64, rows: usize) -> (Vec<TelemetryRecord>, Vec<f64>) {
        let count = |k: usize| (angle(k as f64 * PERIOD) * EDGES / TAU).floor() as i64;
        let (mut records, mut t, mut since) = (Vec::new(), Vec::new(), 0_u16);
        for k in 1..=20 * rows {
            since = if count(k) != count(k - 1) { 0 } else { since.saturating_add(1) };
            if k.is_multiple_of(20) {
                let mut record = TelemetryRecord::default();
                record.edges[1] = count(k) as i16;
                record.since_edge[1] = since;
                records.push(record);
                t.push(k as f64 * PERIOD);
            }
        }
        (records, t)
    }

    #[test]
    fn an_accelerating_wheel_is_told_without_lag_and_with_the_noise_that_the_page_says() {
        let (start, slope) = (3.0, 30.0);
        for sign in [1.0, -1.0] {
            let (records, t) = recorded(|t| sign * (start * t + 0.5 * slope * t * t) + 0.01, 1000);
            let told = speeds_on_rows(&intervals(&records, &t, 1, PERIOD, EDGES), &t);
            let errors: Vec<(f64, f64)> = told
                .iter()
                .zip(&t)
                .filter_map(|(told, t)| told.map(|told| (sign * (start + slope * t), told)))
                .map(|(truth, told)| (truth, (told - truth) / truth))
                .collect();
            assert!(errors.len() > 150, "{}", errors.len());
            let mean = errors.iter().map(|(_, e)| e).sum::<f64>() / errors.len() as f64;
            let rms = (errors.iter().map(|(_, e)| e * e).sum::<f64>() / errors.len() as f64).sqrt();
            // half a row of lag would be 1.5·10⁻² at the start and 5·10⁻⁴ at the end
            assert!(mean.abs() < 3e-4, "{mean}");
            assert!(rms < 0.005, "{rms}");
        }
    }

    #[test]
    fn a_wheel_that_turns_round_at_an_edge_is_not_told_a_speed_through_it() {
        // back and forth over one edge
        let (records, t) = recorded(|t| 0.001 + 0.004 * (TAU * t / 0.05).sin(), 400);
        assert_eq!(intervals(&records, &t, 1, PERIOD, EDGES), []);
    }

    #[test]
    fn a_wheel_that_stood_is_told_nothing_for_that_time() {
        let (records, t) = recorded(|t| 5.0 * t.min(0.2) + 5.0 * (t - 0.5).max(0.0) + 0.01, 700);
        let all = intervals(&records, &t, 1, PERIOD, EDGES);
        assert!(all.iter().all(|x| (x.speed - 5.0).abs() < 0.05), "{all:?}");
        assert!(all.iter().all(|x| x.middle_s < 0.2 || x.middle_s > 0.5));
    }

    #[test]
    fn counts_may_wrap() {
        let (mut records, t) = recorded(|t| 20.0 * t, 300);
        for record in &mut records {
            record.edges[1] = record.edges[1].wrapping_add(i16::MAX - 100);
        }
        let all = intervals(&records, &t, 1, PERIOD, EDGES);
        assert!(all.len() > 50 && all.iter().all(|x| (x.speed - 20.0).abs() < 0.4), "{all:?}");
    }
}
