//! Samples that jump away for one row and come back: a counter that overflowed, a telegram with a wrong bit.
//!
//! A sample counts if it stands far above all that the channel shows elsewhere, its neighbours not; or, where inertia
//! forbids a jump (wheel speeds, pose), if it leaves the line through its neighbours by far more than its noise does.

use super::Fault;
use super::ranked::quantile;
use crate::log::{Channel, RobotFile, Run};

/// Beyond the range: this many times what 98 of 100 samples stay below.
const BEYOND: f64 = 8.0;
/// Off the line: this many times the middle departure, and the stated noise.
const OFF_LINE: f64 = 60.0;
const OFF_NOISE: f64 = 15.0;
/// And this many times the range: a wheel speed that drops to zero for a row is a lost telegram, and no reason to refuse.
const OFF_RANGE_SPEED: f64 = 3.0;
const OFF_RANGE_POSE: f64 = 0.5;
const FEWEST: usize = 30;
/// Samples from which what is usual is taken.
const SAMPLES: usize = 10_000;
/// A pulse of the drive may last one row: its volts stay below this (V), its current below this many times a stalled
/// motor's.
const MOST_V: f64 = 500.0;
const STALLS: f64 = 4.0;
/// Glitches on more rows than this share are something else.
const RARE: f64 = 0.05;

pub(super) fn check(run: &Run, robot: &RobotFile) -> Vec<Fault> {
    let near_s = (10.0 * run.median_step_s()).max(0.1);
    let stall_a = run.supply_v(robot).unwrap_or(0.0) / robot.motor.resistance_ohm;
    let mut faults = Vec::new();
    for (name, channel) in run.signals() {
        let Some(limits) = limits(&name, robot, stall_a) else { continue };
        let Some((rows, value)) = found(run, channel, limits, near_s) else { continue };
        let value = (1e3 * value).round() / 1e3;
        let sentence = format!(
            "`{name}` jumps away and back within one row in {} place(s), the farthest to {value}; no robot moves so.",
            rows.len()
        );
        let fix = "Leave these fields empty, and look for a counter that overflows or a telegram without a checksum.";
        // a telegram that got lost reads zero for a row: among many rows that weighs little
        let fatal = value != 0.0;
        faults.push(Fault::of(run, "glitches", name, fatal).at(rows[0], rows[rows.len() - 1]).says(sentence, fix));
    }
    faults
}

/// What a glitch must exceed.
#[derive(Clone, Copy)]
struct Limits {
    /// No pulse that lasts one row goes beyond this, in the channel's unit.
    pulse: f64,
    /// Of a channel that cannot jump: its noise, and how many of its ranges a jump must go.
    inert: Option<(f64, f64)>,
}

/// The limits of a channel; none where a command may be anything.
fn limits(name: &str, robot: &RobotFile, stall_a: f64) -> Option<Limits> {
    let sensors = &robot.sensors;
    let inert = |noise, ranges| Some(Limits { pulse: 0.0, inert: Some((noise, ranges)) });
    let above = |pulse| Some(Limits { pulse, inert: None });
    match name {
        "enable" => None,
        "x_m" | "y_m" => inert(sensors.position_noise_m, OFF_RANGE_POSE),
        "theta_rad" => inert(sensors.heading_noise_rad, OFF_RANGE_POSE),
        name if name.starts_with("wset") => None,
        name if name.starts_with('w') => inert(sensors.wheel_speed_noise_rad_s, OFF_RANGE_SPEED),
        name if name.starts_with('u') => above(MOST_V),
        name if name.starts_with('i') => above(STALLS * stall_a),
        _ => above(0.0),
    }
}

/// The rows of glitches, and the value of the farthest; `near_s` is how far apart a sample's neighbours may lie (s).
fn found(run: &Run, channel: &Channel, limits: Limits, near_s: f64) -> Option<(Vec<usize>, f64)> {
    let seen: Vec<(usize, f64)> = channel.present().collect();
    if seen.len() < FEWEST {
        return None;
    }
    let off_line = |k: usize| seen[k].1 - 0.5 * (seen[k - 1].1 + seen[k + 1].1);
    // some thousand samples tell what is usual
    let every = 1 + seen.len() / SAMPLES;
    let usual_of = |of: &dyn Fn(usize) -> f64, share| {
        quantile(&mut (1..seen.len() - 1).step_by(every).map(of).collect::<Vec<_>>(), share)
    };
    let middle = usual_of(&|k| seen[k].1, 0.5)?;
    let range = usual_of(&|k| (seen[k].1 - middle).abs(), 0.98)?;
    let usual = usual_of(&|k| off_line(k).abs(), 0.5)?;
    let mut rows = Vec::new();
    let mut farthest = 0.0;
    for k in 1..seen.len() - 1 {
        let [before, now, after] = [k - 1, k, k + 1].map(|k| seen[k].1 - middle);
        let beyond = range > 0.0
            && now.abs() > BEYOND * range
            && seen[k].1.abs() > limits.pulse
            && before.abs().max(after.abs()) < 0.2 * now.abs();
        let jumps = limits.inert.is_some_and(|(noise, ranges)| {
            let off = off_line(k).abs();
            off > OFF_LINE * usual
                && off > OFF_NOISE * noise
                && off > ranges * range
                && (after - before).abs() < 0.2 * off
                && run.t_s[seen[k + 1].0] - run.t_s[seen[k - 1].0] < near_s
        });
        if beyond || jumps {
            rows.push(seen[k].0);
            farthest = if f64::abs(seen[k].1 - middle) > f64::abs(farthest - middle) { seen[k].1 } else { farthest };
        }
    }
    (!rows.is_empty() && (rows.len() as f64) < RARE * seen.len() as f64 + 1.0).then_some((rows, farthest))
}
