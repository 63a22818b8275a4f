//! # Wheel speeds from encoders
//!
//! ```text
//! ω̄ = s·(c₂ − c₁)/(t₂ − t₁),   ω((t₁ + t₂)/2) = ω̄ + O((t₂ − t₁)²·d²ω/dt²/24)
//! ```
//!
//! c is the angle in counts, its difference taken the short way round: less than half a turn of the encoder from a record to the
//! next. s is what a count is worth at the wheel's shaft. An angle is read [`LEAD_PERIODS`] before the codes of its record. Records that
//! are missing in between leave no speed, because nobody knows how often the encoder has turned meanwhile.

use model_core::link::record::TelemetryRecord;
use model_core::link::sensor_codes::{ENCODER_COUNTS, LEAD_PERIODS};

use crate::log::edges::EdgeInterval;

/// The intervals between a wheel's angles, from its records and their times [s].
///
/// `period` is the time of a current turn [s], `scale` the angle of a count at the wheel's shaft [rad].
pub fn intervals(records: &[TelemetryRecord], t: &[f64], wheel: usize, period: f64, scale: f64) -> Vec<EdgeInterval> {
    let angle = |record: &TelemetryRecord| record.sensors.and_then(|sensors| sensors.angle(wheel));
    let mut all = Vec::new();
    for (pair, times) in records.windows(2).zip(t.windows(2)) {
        let follows = pair[1].sequence == pair[0].sequence.wrapping_add(1);
        let (Some(before), Some(now)) = (angle(&pair[0]).filter(|_| follows), angle(&pair[1])) else { continue };
        let counts = i32::from(ENCODER_COUNTS);
        // −counts/2 … counts/2
        let moved = (i32::from(now) - i32::from(before) + counts / 2).rem_euclid(counts) - counts / 2;
        let middle_s = 0.5 * (times[0] + times[1]) - f64::from(LEAD_PERIODS) * period;
        // speeds are told within the run
        if middle_s >= t[0] {
            all.push(EdgeInterval { middle_s, speed: scale * f64::from(moved) / (times[1] - times[0]) });
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::log::edges::speeds_on_rows;
    use model_core::link::sensor_codes::SensorCodes;
    use std::f64::consts::TAU;

    const PERIOD: f64 = 50e-6;
    /// A magnet on the motor, behind a gear of 5
    const SCALE: f64 = TAU / 16_384.0 / 5.0;

    /// The records of a wheel whose angle is φ(t), each read 0.4 ms before its codes.
    fn recorded(angle: impl Fn(f64) -> f64, rows: u32) -> (Vec<TelemetryRecord>, Vec<f64>) {
        let t: Vec<f64> = (1..=rows).map(|k| f64::from(k) * 1e-3).collect();
        let record = |(k, t): (usize, &f64)| {
            let counts = (angle(t - 0.4e-3) / SCALE).floor() as i64;
            let sensors = Some(SensorCodes::of(None, [None, Some(counts.rem_euclid(16_384) as u16), None, None]));
            TelemetryRecord { sequence: k as u32, sensors, ..TelemetryRecord::default() }
        };
        (t.iter().enumerate().map(record).collect(), t)
    }

    #[test]
    fn an_accelerating_wheel_is_told_without_lag_either_way_round_and_past_the_zero() {
        for sign in [1.0, -1.0] {
            let (records, t) = recorded(|t| sign * (3.0 * t + 15.0 * t * t), 1000);
            let told = speeds_on_rows(&intervals(&records, &t, 1, PERIOD, SCALE), &t);
            let errors: Vec<f64> =
                told.iter().zip(&t).filter_map(|(told, t)| told.map(|told| sign * told - (3.0 + 30.0 * t))).collect();
            assert!(errors.len() > 990, "{}", errors.len());
            let mean = errors.iter().sum::<f64>() / errors.len() as f64;
            // a lag of 0.1 ms would be 3·10⁻³
            assert!(mean.abs() < 1e-3, "{mean}");
            // two counts in a millisecond
            assert!(errors.iter().all(|error| error.abs() < 2.0 * SCALE / 1e-3));
        }
    }

    #[test]
    fn what_is_missing_leaves_no_speed() {
        let (mut records, mut t) = recorded(|t| 10.0 * t, 100);
        records[50].sensors = Some(SensorCodes::default());
        records[70].sensors = None;
        records.remove(20);
        t.remove(20);
        let told = intervals(&records, &t, 1, PERIOD, SCALE);
        // 98 pairs; two for each reading that is missing, one for the record
        assert_eq!(told.len(), 98 - 2 - 2 - 1);
        assert!(told.iter().all(|x| (x.speed - 10.0).abs() < 2.0 * SCALE / 1e-3));
        assert_eq!(intervals(&records, &t, 0, PERIOD, SCALE), [], "a wheel without an encoder");
    }
}
