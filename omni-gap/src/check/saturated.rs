//! A channel that stands at one extreme value, to the last digit, while what it measures goes on.

use super::Fault;
use super::body::largest;
use super::frozen::LONG_S;
use crate::log::{Channel, Group, RobotFile, Run};

pub(super) fn check(run: &Run, robot: &RobotFile) -> Vec<Fault> {
    let Some(u) = &run.u else { return Vec::new() };
    let per_speed = robot.volts_per_wheel_speed();
    let mut faults = Vec::new();
    if let (Some(i), Some(w)) = (&run.i, &run.w) {
        for (j, channel) in i.channels.iter().enumerate() {
            let asked = |row| {
                Some(
                    (u.channels[j].get(row).ok()? - per_speed * w.channels[j].get(row).ok()?)
                        / robot.motor.resistance_ohm,
                )
            };
            let step = robot.sensors.current_noise_a;
            faults.extend(extremes(run, i, channel, step, asked).map(|found| describe(run, &format!("i{j}_A"), found)));
        }
    }
    if let Some(w) = &run.w {
        for (j, channel) in w.channels.iter().enumerate() {
            let asked = |row| Some(u.channels[j].get(row).ok()? / per_speed);
            let step = robot.sensors.wheel_speed_noise_rad_s;
            faults.extend(
                extremes(run, w, channel, step, asked).map(|found| describe(run, &format!("w{j}_rad_s"), found)),
            );
        }
    }
    faults
}

struct Found {
    rows: (usize, usize),
    value: f64,
    count: usize,
    share: f64,
    coarse: bool,
}

/// The rows at an extreme, where they are many, more than next to it, and what drives the channel differs among them.
fn extremes(
    run: &Run,
    group: &Group,
    channel: &Channel,
    noise: f64,
    asked: impl Fn(usize) -> Option<f64>,
) -> Option<Found> {
    let top = largest(channel);
    let first = channel.present().next()?.1;
    if channel.present().all(|(_, value)| value == first) {
        return None; // that is frozen
    }
    let moving = channel.present().filter(|(_, v)| v.abs() > 5.0 * noise).count();
    if top <= 5.0 * noise || moving < 20 {
        return None;
    }
    let mut rows = Vec::new();
    for extreme in [1.0, -1.0] {
        let (mut at, mut near) = (Vec::new(), 0);
        let limit = channel.present().map(|(_, v)| extreme * v).fold(f64::MIN, f64::max);
        if limit < 0.5 * top {
            continue;
        }
        for (row, value) in channel.present() {
            let value = extreme * value;
            if value == limit {
                at.push(row);
            } else if value > 0.95 * limit {
                near += 1;
            }
        }
        let asked: Vec<f64> = at.iter().filter_map(|&row| asked(row)).map(|a| a * extreme).collect();
        let (low, high) = asked.iter().fold((f64::MAX, f64::MIN), |(l, h), a| (l.min(*a), h.max(*a)));
        // a plateau under a constant drive is no limit: what is asked must differ, and go beyond
        if at.len() >= 10 && at.len() > 3 * near && high - low > (0.15 * limit).max(6.0 * noise) && high > 1.1 * limit {
            rows.extend(at);
        }
    }
    rows.sort_unstable();
    // one long stretch alone is a channel that froze
    let length_s = run.t_s[*rows.last()?] - run.t_s[*rows.first()?];
    if length_s >= LONG_S && rows.windows(2).all(|pair| pair[1] == pair[0] + 1) {
        return None;
    }
    let (first, last) = (*rows.first()?, *rows.last()?);
    let share = rows.len() as f64 / moving as f64;
    (share > 0.02).then_some(Found {
        rows: (first, last),
        value: top,
        count: rows.len(),
        share,
        coarse: group.quantum.is_some(),
    })
}

fn describe(run: &Run, signal: &str, found: Found) -> Fault {
    let fatal = found.share > 0.05 && !found.coarse;
    let sentence = format!(
        "`{signal}` stands at {:.4} on {} rows, {:.0} % of those in which it moves, while it should go beyond.",
        found.value,
        found.count,
        100.0 * found.share
    );
    let fix = "Widen the sensor's range, or drive more gently; leave saturated fields empty.";
    Fault::of(run, "saturated", signal, fatal).at(found.rows.0, found.rows.1).says(sentence, fix)
}
