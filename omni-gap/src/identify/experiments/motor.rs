//! The motor's own experiment: steady voltage, current and speed at several loads.
//!
//! ```text
//! u = R·i + K_v·ω_m   ⇒   u/ω_m = R·(i/ω_m) + K_v        (eq. 29)
//! ```

use super::holds::holds;
use super::regress::{Estimate, Rows, jackknife};
use crate::simulate::{AlignedRun, Model};
use model_core::geometry::frames::BodyTwist;

/// Below this share of the speed at which back-EMF would balance the voltage a motor counts as stalled.
const SLOWEST: f64 = 0.15;

/// R [Ω] and K_v [V·s] at the motor shaft from the steady states of these runs.
pub fn motor<const N: usize>(model: &Model<N>, runs: &[&AlignedRun<N>]) -> Option<[Estimate; 2]> {
    let robot = model.plant().robot().to_owned();
    let points: Vec<Vec<[f64; 2]>> = runs
        .iter()
        .map(|run| {
            let steady = holds(run, &robot.wheels).into_iter();
            steady
                .filter_map(|hold| {
                    // the motors pull together: their mean, each turned to the way it is driven
                    let speed = robot.wheels.wheel_speeds(BodyTwist::from_array(hold.twist));
                    let (mut u, mut i, mut w) = (0.0, 0.0, 0.0);
                    for ((speed, volts), amps) in speed.into_iter().zip(hold.volts).zip(hold.amps) {
                        u += volts.abs();
                        i += volts.signum() * amps;
                        w += volts.signum() * speed * robot.motor.gear_ratio;
                    }
                    // where a load all but stops the motors, 1/ω_m is noise
                    let turning = w * robot.motor.emf_constant > SLOWEST * u;
                    turning.then(|| [u / w, i / w])
                })
                .collect()
        })
        .collect();
    jackknife(runs.len(), |without| {
        let mut rows = Rows::<2>::default();
        for (_, points) in points.iter().enumerate().filter(|(k, _)| Some(*k) != without) {
            for [u, i] in points {
                rows.push(*u, [*i, 1.0], [*i, 1.0]);
            }
        }
        rows.least_squares()
    })
}
