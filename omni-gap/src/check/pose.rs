//! Wheels against the pose: over windows of a quarter of a second, the wheels' speeds and the pose's steps must agree.
//!
//! A common factor is free (slip, a wrong radius), and the camera may be late. What remains to see: a wrong unit, a
//! mirrored or turned frame, and wheels in another order.

use super::Fault;
use super::agree;
use super::frame::{self, Seen};
use super::ranked::ranked;
use super::units;
use super::windows::Window;
use crate::log::{RobotFile, Run};

pub(super) fn check<'a>(runs: &[&'a Run], robot: &RobotFile) -> Vec<Fault> {
    let seen = |&run: &&'a Run| Some((run, Seen::new(run, robot)?));
    let (seen_runs, evidence): (Vec<&Run>, Vec<Seen>) = runs.iter().filter_map(seen).unzip();
    let mut faults: Vec<Fault> = runs
        .iter()
        .filter_map(|run| match seen_runs.iter().position(|seen| std::ptr::eq(*seen, *run)) {
            Some(k) => wrong_unit(run, robot, evidence[k].windows()),
            None => heading_alone(run),
        })
        .collect();
    if faults.is_empty() {
        faults.extend(agree::guesses(&evidence).into_iter().map(|(guess, which)| {
            let fault = frame::describe(seen_runs[which[0]], &guess);
            let sentence = fault.sentence.clone() + &agree::in_which(which.len(), seen_runs.len());
            Fault { sentence, ..fault }
        }));
    }
    faults
}

/// Without wheel speeds: a robot does not spin eight turns a second for long.
fn heading_alone(run: &Run) -> Option<Fault> {
    let heading = run.pose.as_ref()?.channels.get(2)?;
    let seen: Vec<(usize, f64)> = heading.present().collect();
    let mut rates: Vec<f64> =
        seen.windows(2).map(|p| ((p[1].1 - p[0].1) / (run.t_s[p[1].0] - run.t_s[p[0].0])).abs()).collect();
    let rank = rates.len() * 4 / 5;
    let high = ranked(&mut rates, rank)?;
    let (low, top) = seen.iter().fold((f64::MAX, f64::MIN), |(l, h), (_, v)| (l.min(*v), h.max(*v)));
    if high < 50.0 || top - low < 30.0 || run.w.is_some() {
        return None;
    }
    Some(frame::degrees(run, format!("The heading turns at {high:.0} rad/s for a fifth of the run.")))
}

/// How well two numbers must go together (0 to 1) before their ratio says anything.
const TOGETHER: f64 = 0.5;
/// How well for a heading, which may hardly turn.
const TURNS: f64 = 0.85;
/// How well for a body that is too slow for its wheels.
const CLOSELY: f64 = 0.9;
/// Slip makes the body slower than its wheels, up to this many times; nothing makes it faster than half as fast again.
const SLIP: f64 = 6.0;

fn wrong_unit(run: &Run, robot: &RobotFile, windows: &[Window]) -> Option<Fault> {
    let pairs = |f: &dyn Fn(&Window) -> Pair| windows.iter().map(f).collect::<Vec<_>>();
    let turn = ratio(&pairs(&|w| (w.yaw, w.twist[2])));
    let go = ratio(&pairs(&|w| (w.world[0].hypot(w.world[1]), w.twist[0].hypot(w.twist[1]))));
    let wrong_unit = |signal: &str, name: &str, times: f64| {
        let sentence =
            format!("The `{signal}` columns look like {name}: pose and wheel speeds differ by a factor of {times:.1}.");
        let fix = "Convert the columns to SI units, or state `unit` in columns.toml.";
        Some(Fault::of(run, "wrong_unit", signal, true).says(sentence, fix))
    };
    // against the rims, lest a robot that spins on the spot be taken for one that is too fast for its wheels
    let rims = windows.iter().map(|w| w.rims.iter().map(|v| v * v).sum::<f64>() / w.rims.len() as f64).sum::<f64>();
    let world = windows.iter().map(|w| w.world[0].powi(2) + w.world[1].powi(2)).sum::<f64>();
    let travelling = go.as_ref().filter(|go| go.fit > TOGETHER).map(|_| (world / rims).sqrt());
    // a pose that is too fast for its wheels: slip cannot make that
    let too_fast = |unit: &units::WrongUnit, ratio: f64| ratio > unit.per_unit / SLIP && ratio < 1.6 * unit.per_unit;
    let going = go.as_ref().filter(|go| go.fit > TOGETHER).map(|go| go.times);
    let yaw = windows.iter().map(|w| (robot.wheel[0].distance_m * w.yaw).powi(2)).sum::<f64>();
    let spinning = turn.as_ref().filter(|turn| turn.fit > TOGETHER).map(|_| (yaw / rims).sqrt());
    let turning = turn.filter(|turn| turn.fit > TURNS).map(|turn| turn.times);
    let lengths = travelling.and_then(|go| units::LENGTHS.into_iter().rev().find(|unit| too_fast(unit, go)));
    let degrees = |times: &f64| lengths.is_none() && units::ANGLES.iter().any(|unit| too_fast(unit, *times));
    if let Some(times) = turning.filter(degrees).or(spinning.filter(degrees)) {
        return Some(frame::degrees(run, format!("The heading turns {times:.0} times as fast as the wheels say.")));
    }
    if let Some(unit) = lengths {
        return wrong_unit("x_m, y_m", unit.name, unit.per_unit);
    }
    // a body that is too slow for its wheels may slip; speeds that the motors confirm, or could reach, are no fault
    if super::motor::knows_speeds(run) || !out_of_reach(run, robot) {
        return None;
    }
    if go.is_none_or(|go| go.fit < CLOSELY) {
        return None;
    }
    let unit = units::explains(&units::SPEEDS, 1.0 / going?)?;
    let turns = turning.is_none_or(|turn| units::explains(&units::SPEEDS, 1.0 / turn).is_some());
    if turns { wrong_unit("w", unit.name, unit.per_unit) } else { None }
}

/// Whether the wheels turn faster than the supply could drive them; where no supply is known they may.
fn out_of_reach(run: &Run, robot: &RobotFile) -> bool {
    let (Some(speed), Some(supply)) = (&run.w, run.supply_v(robot)) else {
        return run.w.is_some();
    };
    let mut all: Vec<f64> = speed.channels.iter().flat_map(|c| c.present()).map(|(_, w)| w.abs()).collect();
    let rank = all.len() * 9 / 10;
    let high = ranked(&mut all, rank).unwrap_or(0.0);
    high > 1.3 * supply / robot.volts_per_wheel_speed()
}

/// Two numbers that should be equal: by the pose, and by the wheels.
type Pair = (f64, f64);

struct Ratio {
    /// The first over the second, in RMS.
    times: f64,
    /// How well they go together, whatever the sign.
    fit: f64,
}

fn ratio(pairs: &[Pair]) -> Option<Ratio> {
    let sums = pairs.iter().fold((0.0, 0.0, 0.0), |s, (y, x)| (s.0 + y * x, s.1 + x * x, s.2 + y * y));
    let fit = f64::abs(sums.0) / (sums.1 * sums.2).sqrt();
    (sums.1 > 0.0 && sums.2 > 0.0).then(|| Ratio { times: (sums.2 / sums.1).sqrt(), fit })
}
