//! Samples that jump away for one row and come back: a counter that overflowed, a telegram with a wrong bit, something else
//! that the camera took for the robot. They are set aside before anything else is looked at: a hole with its reason.
//!
//! A sample counts if it stands far above all that the channel shows elsewhere, its neighbours not; or, where inertia
//! forbids a jump (wheel speeds, pose), if it leaves the line through its neighbours by far more than other samples do, than
//! noise does, and than a robot could in that time or does in all of its drive. Of a pose the whole frame goes: what was seen was something else.
//!
//! ```text
//! d_k = x_k − (x_{k−1} + x_{k+1})/2,   |d_k| ≤ a·Δt²/2 of a motion with acceleration a, Δt from neighbour to neighbour
//! ```

use std::borrow::Cow;

use super::Fault;
use super::ranked::quantile;
use crate::log::{Channel, Missing, RobotFile, Run, Session};

/// Beyond the range: this many times what 98 of 100 samples stay below.
const BEYOND: f64 = 8.0;
/// Off the line: this many times what 95 of 100 samples stay below, …
const OFF_USUAL: f64 = 4.0;
/// … so many stated sigmas, …
const OFF_NOISE: f64 = 12.0;
/// … and so many times as far as its neighbours are, which one jump alone leaves off by half of it.
const OFF_NEIGHBOURS: f64 = 1.4;
/// No robot of this kind accelerates more, four times what rubber holds [m/s²] [rad/s²], and no rim of a wheel that slips.
const MOST_M_S2: f64 = 40.0;
const MOST_RAD_S2: f64 = 400.0;
const MOST_RIM_M_S2: f64 = 80.0;
/// Of a channel's range, what is no motion even where rows lie far apart [1].
const OFF_RANGE_SPEED: f64 = 3.0;
const OFF_RANGE_POSE: f64 = 0.5;
const FEWEST: usize = 30;
/// Samples from which what is usual is taken.
const SAMPLES: usize = 10_000;
/// A pulse of the drive may last one row: its volts stay below this (V), its current below this many times a stalled
/// motor's.
const MOST_V: f64 = 500.0;
const STALLS: f64 = 4.0;
/// Jumps on more rows than this share are something else.
const RARE: f64 = 0.05;
/// What stands beside a jump may be seen once that is gone.
const PASSES: usize = 4;

const POSE: [&str; 3] = ["x_m", "y_m", "theta_rad"];

/// A session without the samples that are to be set aside; itself, where there are none.
pub(super) fn set_aside_in(session: &Session) -> Cow<'_, Session> {
    let without = |runs: &[Run]| -> Vec<Option<Run>> {
        runs.iter()
            .map(|run| match set_aside(run, &session.robot) {
                Cow::Borrowed(_) => None,
                Cow::Owned(run) => Some(run),
            })
            .collect()
    };
    let (runs, heldout) = (without(&session.runs), without(&session.heldout));
    if runs.iter().chain(&heldout).all(Option::is_none) {
        return Cow::Borrowed(session);
    }
    let mut session = session.clone();
    let put = |run: &mut Run, without: Option<Run>| *run = without.unwrap_or_else(|| std::mem::take(run));
    session.runs.iter_mut().zip(runs).for_each(|(run, without)| put(run, without));
    session.heldout.iter_mut().zip(heldout).for_each(|(run, without)| put(run, without));
    Cow::Owned(session)
}

/// A run without the samples that are to be set aside; itself, where there are none.
pub(super) fn set_aside<'a>(run: &'a Run, robot: &RobotFile) -> Cow<'a, Run> {
    let stall_a = run.supply_v(robot).unwrap_or(0.0) / robot.motor.resistance_ohm;
    let found: Vec<(String, Vec<usize>)> = run
        .signals()
        .into_iter()
        .filter_map(|(name, channel)| {
            let limits = limits(&name, robot, stall_a)?;
            let rows = rows_of_jumps(run, channel, limits);
            (!rows.is_empty()).then_some((name, rows))
        })
        .collect();
    if found.is_empty() {
        return Cow::Borrowed(run);
    }
    let is_pose = |name: &str| POSE.contains(&name);
    Cow::Owned(run.with_channels(|name, channel| {
        let here = found.iter().filter(|(other, _)| name == other || (is_pose(name) && is_pose(other)));
        let mut jumps = vec![false; channel.len()];
        here.flat_map(|(_, rows)| rows).for_each(|row| jumps[*row] = true);
        let sample = |row: usize| channel.get(row).and_then(|x| if jumps[row] { Err(Missing::Outlier) } else { Ok(x) });
        Some((0..channel.len()).map(sample).collect())
    }))
}

/// What was set aside of a run, as slight faults: of a pose once, since its frame went whole.
pub(super) fn told(run: &Run) -> Vec<Fault> {
    let mut faults: Vec<Fault> = Vec::new();
    for (name, channel) in run.signals() {
        let rows: Vec<usize> = (0..channel.len()).filter(|row| channel.get(*row) == Err(Missing::Outlier)).collect();
        let (Some(first), Some(last)) = (rows.first(), rows.last()) else { continue };
        let is_pose = POSE.contains(&name.as_str());
        if is_pose && faults.iter().any(|fault| fault.signal == POSE.join(", ")) {
            continue;
        }
        let signal = if is_pose { POSE.join(", ") } else { name };
        let what = if is_pose { "The pose" } else { &format!("`{signal}`") };
        let sentence = format!(
            "{what} jumps away and back within one row in {} place(s); no robot moves so. These samples are left out.",
            rows.len()
        );
        let fix = "Nothing has to be done; look for a counter that overflows, a telegram without a checksum, or something else that the camera takes for the robot.";
        faults.push(Fault::of(run, "glitches", signal, false).at(*first, *last).says(sentence, fix));
    }
    faults
}

/// What a jump must exceed.
#[derive(Clone, Copy)]
struct Limits {
    /// No pulse that lasts one row goes beyond this, in the channel's unit.
    pulse: f64,
    /// Of a channel that cannot jump.
    inert: Option<Inert>,
}

/// A channel that cannot jump.
#[derive(Clone, Copy)]
struct Inert {
    /// Its noise, in its unit.
    noise: f64,
    /// How far off the line a robot gets in Δt from neighbour to neighbour: in its unit by seconds, seconds to this power.
    most: (f64, i32),
    /// What is no motion, of its range [1].
    ranges: f64,
}

/// The limits of a channel; none where a command may be anything.
fn limits(name: &str, robot: &RobotFile, stall_a: f64) -> Option<Limits> {
    let sensors = &robot.sensors;
    let inert = |noise, most, ranges| Some(Limits { pulse: 0.0, inert: Some(Inert { noise, most, ranges }) });
    let above = |pulse| Some(Limits { pulse, inert: None });
    match name {
        "enable" => None,
        "x_m" | "y_m" => inert(sensors.position_noise_m, (0.125 * MOST_M_S2, 2), OFF_RANGE_POSE),
        "theta_rad" => inert(sensors.heading_noise_rad, (0.125 * MOST_RAD_S2, 2), OFF_RANGE_POSE),
        name if name.starts_with("wset") => None,
        name if name.starts_with('w') => {
            let radius_m = robot.wheel.iter().map(|wheel| wheel.radius_m).fold(f64::INFINITY, f64::min);
            inert(sensors.wheel_speed_noise_rad_s, (MOST_RIM_M_S2 / radius_m, 1), OFF_RANGE_SPEED)
        }
        name if name.starts_with('u') => above(MOST_V),
        name if name.starts_with('i') => above(STALLS * stall_a),
        _ => above(0.0),
    }
}

/// The rows on which a channel jumps; none where it does so too often.
fn rows_of_jumps(run: &Run, channel: &Channel, limits: Limits) -> Vec<usize> {
    let mut seen: Vec<(usize, f64)> = channel.present().collect();
    let all = seen.len();
    let mut rows = Vec::new();
    for _ in 0..PASSES {
        let found = jumps(run, &seen, limits);
        if found.is_empty() {
            break;
        }
        rows.extend(found.iter().map(|k| seen[*k].0));
        let mut k = 0;
        seen.retain(|_| {
            k += 1;
            found.binary_search(&(k - 1)).is_err()
        });
    }
    if rows.len() as f64 >= RARE * all as f64 + 1.0 { Vec::new() } else { rows }
}

/// Which of the samples jump, in order.
fn jumps(run: &Run, seen: &[(usize, f64)], limits: Limits) -> Vec<usize> {
    if seen.len() < FEWEST {
        return Vec::new();
    }
    let inner = 1..seen.len() - 1;
    let off = |k: usize| seen[k].1 - 0.5 * (seen[k - 1].1 + seen[k + 1].1);
    let every = 1 + seen.len() / SAMPLES;
    let usual_of = |of: &dyn Fn(usize) -> f64, share| {
        quantile(&mut inner.clone().step_by(every).map(of).collect::<Vec<_>>(), share).unwrap_or(0.0)
    };
    let middle = usual_of(&|k| seen[k].1, 0.5);
    let range = usual_of(&|k| (seen[k].1 - middle).abs(), 0.98);
    let usual = usual_of(&|k| off(k).abs(), 0.95);
    let is_beyond = |k: usize| {
        let [before, now, after] = [k - 1, k, k + 1].map(|k| seen[k].1 - middle);
        range > 0.0
            && now.abs() > BEYOND * range
            && seen[k].1.abs() > limits.pulse
            && before.abs().max(after.abs()) < 0.2 * now.abs()
    };
    let leaves_the_line = |k: usize, inert: Inert| {
        let here = off(k).abs();
        if here < OFF_NOISE * inert.noise || here < OFF_USUAL * usual {
            return false;
        }
        let elapsed = run.t_s[seen[k + 1].0] - run.t_s[seen[k - 1].0];
        let beside = [k - 1, k + 1].into_iter().filter(|k| inner.contains(k)).map(|k| off(k).abs()).fold(0.0, f64::max);
        let most = (inert.most.0 * elapsed.powi(inert.most.1)).min(inert.ranges * range);
        here > most && here > OFF_NEIGHBOURS * beside
    };
    inner.clone().filter(|k| is_beyond(*k) || limits.inert.is_some_and(|inert| leaves_the_line(*k, inert))).collect()
}
