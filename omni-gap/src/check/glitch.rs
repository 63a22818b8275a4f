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
/// Glitches on more rows than this share are something else.
const RARE: f64 = 0.05;

pub(super) fn check(run: &Run, robot: &RobotFile) -> Vec<Fault> {
    let sensors = &robot.sensors;
    let mut faults = Vec::new();
    for (name, channel) in run.signals() {
        let inert = match name.as_str() {
            "enable" => continue,
            "x_m" | "y_m" => Some((sensors.position_noise_m, OFF_RANGE_POSE)),
            "theta_rad" => Some((sensors.heading_noise_rad, OFF_RANGE_POSE)),
            name if name.starts_with('w') && !name.starts_with("wset") => {
                Some((sensors.wheel_speed_noise_rad_s, OFF_RANGE_SPEED))
            }
            _ => None,
        };
        let Some((rows, value)) = found(run, channel, inert) else { continue };
        let value = (1e3 * value).round() / 1e3;
        let sentence = format!(
            "`{name}` jumps away and back within one row in {} place(s), the farthest to {value}; no robot moves so.",
            rows.len()
        );
        let mend = "Leave these fields empty, and look for a counter that overflows or a telegram without a checksum.";
        faults.push(Fault::of(run, "glitches", name, true).at(rows[0], rows[rows.len() - 1]).says(sentence, mend));
    }
    faults
}

/// The rows of glitches, and the value of the farthest. `inert` is the noise of a channel that cannot jump, and how many
/// of its ranges a jump must go.
fn found(run: &Run, channel: &Channel, inert: Option<(f64, f64)>) -> Option<(Vec<usize>, f64)> {
    let seen: Vec<(usize, f64)> = channel.present().collect();
    if seen.len() < FEWEST {
        return None;
    }
    let middle = quantile(&mut seen.iter().map(|(_, v)| *v).collect::<Vec<_>>(), 0.5)?;
    // a channel that drifts far, such as a pose, is judged by its steps alone
    let range = quantile(&mut seen.iter().map(|(_, v)| (v - middle).abs()).collect::<Vec<_>>(), 0.98)?;
    let off_line = |k: usize| seen[k].1 - 0.5 * (seen[k - 1].1 + seen[k + 1].1);
    let usual = quantile(&mut (1..seen.len() - 1).map(|k| off_line(k).abs()).collect::<Vec<_>>(), 0.5)?;
    let step = run.median_step_s();
    let mut rows = Vec::new();
    let mut farthest = 0.0;
    for k in 1..seen.len() - 1 {
        let [before, now, after] = [k - 1, k, k + 1].map(|k| seen[k].1 - middle);
        let beyond = range > 0.0 && now.abs() > BEYOND * range && before.abs().max(after.abs()) < 0.2 * now.abs();
        let jumps = inert.is_some_and(|(noise, ranges)| {
            let off = off_line(k).abs();
            off > OFF_LINE * usual
                && off > OFF_NOISE * noise
                && off > ranges * range
                && (after - before).abs() < 0.2 * off
                && run.t_s[seen[k + 1].0] - run.t_s[seen[k - 1].0] < (10.0 * step).max(0.1)
        });
        if beyond || jumps {
            rows.push(seen[k].0);
            farthest = if f64::abs(seen[k].1 - middle) > f64::abs(farthest - middle) { seen[k].1 } else { farthest };
        }
    }
    (!rows.is_empty() && (rows.len() as f64) < RARE * seen.len() as f64 + 1.0).then_some((rows, farthest))
}
