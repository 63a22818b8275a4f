//! A clock that counts something else than seconds.
//!
//! Rows that lie half a second apart or more can show no drive, and rows closer than the fastest logger writes are none:
//! a clock in milliseconds, microseconds or nanoseconds, or one that was scaled twice. In between the wheels tell: they
//! must have turned as far as the pose went.

use super::Fault;
use super::windows::{self, Stretch};
use crate::log::{RobotFile, Run};

/// Rows this far apart (s) show no drive.
const SLOWEST_S: f64 = 0.5;
/// No log has rows as close as this (s).
const FASTEST_S: f64 = 5e-6;
/// A usual length of a row (s) that a unit should lead to.
const USUAL_S: f64 = 0.25;

const UNITS: [(&str, &str, f64); 3] =
    [("milliseconds", "ms", 1e3), ("microseconds", "us", 1e6), ("nanoseconds", "ns", 1e9)];

/// By the rows' distance alone.
pub(super) fn by_rows(run: &Run) -> Option<Fault> {
    let step = run.median_step_s();
    if run.rows() < 2 || (FASTEST_S..SLOWEST_S).contains(&step) {
        return None;
    }
    if step < FASTEST_S {
        let sentence = format!("The rows lie {step:e} s apart, closer than any log: the clock is no clock in seconds.");
        let fix = "Write `t_s` in seconds, and state its unit in columns.toml only once.";
        return Some(Fault::of(run, "wrong_time_unit", "t_s", true).says(sentence, fix));
    }
    let unit = UNITS.iter().find(|(.., per_s)| step / per_s < USUAL_S).unwrap_or(&UNITS[2]);
    let apart = if step < 1e6 { format!("{step:.3}") } else { format!("{step:e}") };
    Some(describe(run, format!("The rows lie {apart} s apart, expected less than {SLOWEST_S} s"), unit))
}

fn describe(run: &Run, found: String, (name, short, per_s): &(&str, &str, f64)) -> Fault {
    let fix = format!("Divide `t_s` by {per_s:e}, or state unit = \"{short}\" for it in columns.toml.");
    Fault::of(run, "wrong_time_unit", "t_s", true).says(format!("{found}: the clock looks like {name}."), fix)
}

/// How well wheels and pose must go together (correlation).
const TOGETHER: f64 = 0.8;
/// How far from a unit's own factor the ratio may be.
const NEAR: f64 = 6.0;

/// By the wheels against the pose: both must have gone equally far.
pub(super) fn by_wheels(run: &Run, robot: &RobotFile) -> Option<Fault> {
    let stretches = windows::stretches(run, robot)?;
    let turn = ratio(&stretches, |s| (s.pose[2], s.wheels[2]));
    let go = ratio(&stretches, |s| (s.pose[0].hypot(s.pose[1]), s.wheels[0].hypot(s.wheels[1])));
    // a pose in millimetres goes too far as well, but turns as the wheels say
    let ratio = turn.or(go.filter(|go| *go < 1.0))?;
    let near = |per_s: f64| (ratio * per_s).ln().abs() < NEAR.ln();
    if let Some(unit) = UNITS.iter().find(|(.., per_s)| near(*per_s)) {
        let found = format!("By its wheels the robot moved {:.0} times as far as its pose says", 1.0 / ratio);
        return Some(describe(run, found, unit));
    }
    UNITS.iter().find(|(.., per_s)| near(1.0 / per_s)).map(|_| {
        let sentence = format!(
            "By its pose the robot moved {ratio:.0} times as far as its wheels say: the clock runs too slowly."
        );
        let fix = "Write `t_s` in seconds, and state its unit in columns.toml only once.";
        Fault::of(run, "wrong_time_unit", "t_s", true).says(sentence, fix)
    })
}

/// The pose's motion over the wheels', where the two go together.
fn ratio(stretches: &[Stretch], of: impl Fn(&Stretch) -> (f64, f64)) -> Option<f64> {
    let sums = stretches.iter().map(of).fold((0.0, 0.0, 0.0), |s, (p, w)| (s.0 + p * p, s.1 + w * w, s.2 + p * w));
    let (pose, wheels, both) = sums;
    (both > TOGETHER * (pose * wheels).sqrt() && wheels > 0.0 && pose > 0.0).then(|| (pose / wheels).sqrt())
}
