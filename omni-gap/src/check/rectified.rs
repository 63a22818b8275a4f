//! Currents that are logged as magnitudes though nobody says so: never below zero while the drive goes both ways.
//!
//! An offset can lift all currents above zero too; but then they still rise and fall with the drive, not with its
//! magnitude.

use super::Fault;
use super::body::largest;
use crate::log::{RobotFile, Run};

const FEWEST: usize = 50;
/// Rows on which the drive goes each way, at least.
const EACH_WAY: f64 = 0.1;
/// By so much the currents must go better with the drive's magnitude than with the drive (correlation).
const CLEARER: f64 = 0.3;

pub(super) fn check(run: &Run, robot: &RobotFile) -> Option<Fault> {
    let (current, drive) = (run.i.as_ref().filter(|i| !i.unsigned)?, run.u.as_ref().filter(|u| !u.unsigned)?);
    if current.channels.iter().flat_map(|c| c.present()).any(|(_, i)| i < 0.0) {
        return None;
    }
    let wheels: Vec<usize> =
        (0..current.channels.len()).filter(|j| is_rectified(run, robot, *j) == Some(true)).collect();
    if wheels.len() * 2 <= drive.channels.len() {
        return None;
    }
    let sentence = "No current is below zero though the voltages go both ways: the log keeps magnitudes.";
    let fix = "Log the currents with their sign, or set unsigned = true for group i in columns.toml.";
    Some(Fault::of(run, "unsigned_currents", "i", true).says(sentence, fix))
}

fn is_rectified(run: &Run, robot: &RobotFile, wheel: usize) -> Option<bool> {
    let (i, u) = (&run.i.as_ref()?.channels[wheel], &run.u.as_ref()?.channels[wheel]);
    let w = run.w.as_ref().filter(|w| !w.unsigned).map(|w| &w.channels[wheel]);
    // what drives the current: u − Kv·l·w
    let asked = |row: usize| {
        let speed = w.map_or(Some(0.0), |w| w.get(row).ok())?;
        Some((i.get(row).ok()?, u.get(row).ok()? - robot.volts_per_wheel_speed() * speed))
    };
    let pairs: Vec<(f64, f64)> = (0..run.rows()).filter_map(asked).collect();
    let slow = 0.1 * largest(u);
    let way = |sign: f64| u.present().filter(|(_, u)| sign * u > slow).count() as f64;
    let rows = pairs.len() as f64;
    if pairs.len() < FEWEST || way(1.0) < EACH_WAY * rows || way(-1.0) < EACH_WAY * rows {
        return None;
    }
    let signed = correlation(pairs.iter().copied())?;
    let magnitude = correlation(pairs.iter().map(|(i, e)| (*i, e.abs())))?;
    Some(magnitude > 0.3 && magnitude > signed + CLEARER)
}

/// Pearson's correlation of pairs.
fn correlation(pairs: impl Iterator<Item = (f64, f64)>) -> Option<f64> {
    let (mut n, mut x, mut y, mut xx, mut yy, mut xy) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for (a, b) in pairs {
        (n, x, y) = (n + 1.0, x + a, y + b);
        (xx, yy, xy) = (xx + a * a, yy + b * b, xy + a * b);
    }
    let (vx, vy) = (xx - x * x / n, yy - y * y / n);
    (vx > 0.0 && vy > 0.0).then(|| (xy - x * y / n) / (vx * vy).sqrt())
}
