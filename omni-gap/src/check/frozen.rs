//! A channel that repeats one value while what drives it moves.
//!
//! Or one that shows noise elsewhere and none there. A robot at rest, a stuck wheel under little voltage, and a coarse signal under a constant drive are not frozen.

use super::Fault;
use super::body::{BodyFromWheels, input, largest, row_of};
use crate::log::{Channel, RobotFile, Run};

/// A stretch of one value must last as long as this (s), and over as many rows, to count.
pub(super) const LONG_S: f64 = 0.5;
const LONG_ROWS: usize = 20;
/// What the wheels must have travelled (m), or turned (rad), while the pose stood.
const TRAVEL_M: f64 = 0.15;
const TURN_RAD: f64 = 0.5;
/// With fewer volts (RMS) a bridge's losses may be all of them.
const LEAST_V: f64 = 1.5;

pub(super) fn check(run: &Run, robot: &RobotFile) -> Vec<Fault> {
    let mut faults: Vec<Fault> = Vec::new();
    if let (Some(speed), Some((name, drive))) = (&run.w, input(run)) {
        for (j, channel) in speed.channels.iter().enumerate() {
            let (noisy, dead) = (noisy(channel), dead(&speed.channels, j));
            let moved = |a, b| {
                dead || noisy && alive(&speed.channels, j, (a, b))
                    || others_move(&speed.channels, j, (a, b))
                        && (drive_moves(robot, (name, &drive.channels[j]), channel.get(a) == Ok(0.0), (a, b))
                            || turned(run, j, (a, b)))
            };
            faults.extend(stretches(run, channel, moved).map(|s| describe(run, &format!("w{j}_rad_s"), s)));
        }
    }
    if let (Some(current), Some(_), Some(_)) = (&run.i, &run.u, &run.w) {
        for (j, channel) in current.channels.iter().enumerate() {
            let step = robot.sensors.current_noise_a + current.quantum.unwrap_or(0.0);
            let (noisy, dead) = (noisy(channel), dead(&current.channels, j));
            let moved = |a, b| {
                dead || noisy && alive(&current.channels, j, (a, b))
                    || current_asked(run, robot, j, (a, b)).is_some_and(|asked| asked > 10.0 * step)
            };
            faults.extend(stretches(run, channel, moved).map(|s| describe(run, &format!("i{j}_A"), s)));
        }
    }
    if let Some(pose) = &run.pose {
        for (axis, name) in ["x_m", "y_m", "theta_rad"].iter().enumerate() {
            let noisy = noisy(&pose.channels[axis]);
            let moved = |a, b| {
                noisy && alive(&pose.channels, axis, (a, b))
                    || travelled(run, robot, (a, b))
                        .is_some_and(|by| by[axis].abs() > if axis < 2 { TRAVEL_M } else { TURN_RAD })
            };
            faults.extend(stretches(run, &pose.channels[axis], moved).map(|s| describe(run, name, s)));
        }
    }
    faults
}

/// The stretches of one value that count, as one: first row, last row, and their length altogether (s).
fn stretches(
    run: &Run,
    channel: &Channel,
    moved: impl Fn(usize, usize) -> bool,
) -> std::option::IntoIter<(usize, usize, f64)> {
    let seen: Vec<(usize, f64)> = channel.present().collect();
    let mut found: Option<(usize, usize, f64)> = None;
    let mut from = 0;
    for to in 1..=seen.len() {
        if to < seen.len() && seen[to].1 == seen[from].1 {
            continue;
        }
        let (first, last) = (seen[from].0, seen[to - 1].0);
        let length_s = run.t_s[last] - run.t_s[first];
        if to - from >= LONG_ROWS && length_s >= LONG_S && moved(first, last) {
            found = Some(found.map_or((first, last, length_s), |f| (f.0, last, f.2 + length_s)));
        }
        from = to;
    }
    found.into_iter()
}

/// Whether a channel's last digits never stand still where it lives: then a stretch of one value is frozen, whatever the
/// robot does.
///
/// Noise turns the channel's way at two rows of three; motion without noise hardly ever.
fn noisy(channel: &Channel) -> bool {
    let values: Vec<f64> = channel.present().map(|(_, value)| value).collect();
    let (mut same, mut steps, mut turns, mut stretch) = (0usize, 0usize, 0usize, 1usize);
    for k in 1..values.len() {
        if values[k] == values[k - 1] {
            stretch += 1;
            // a long stretch is what is in question
            same = if stretch == LONG_ROWS { same + 2 - LONG_ROWS } else { same + usize::from(stretch < LONG_ROWS) };
            continue;
        }
        stretch = 1;
        steps += 1;
        turns += usize::from(k > 1 && (values[k] - values[k - 1]) * (values[k - 1] - values[k - 2]) < 0.0);
    }
    steps >= LONG_ROWS && (same as f64) < 0.02 * steps as f64 && turns as f64 > 0.2 * steps as f64
}

fn describe(run: &Run, signal: &str, (first, last, length_s): (usize, usize, f64)) -> Fault {
    let fatal = length_s > 0.1 * run.duration_s();
    let sentence =
        format!("`{signal}` repeats one value to the last digit for {length_s:.1} s while the robot is driven.");
    let fix = "Check the sensor and its cable; leave fields empty where nothing was measured.";
    Fault::of(run, "frozen", signal, fatal).at(first, last).says(sentence, fix)
}

fn range(channel: &Channel, (first, last): (usize, usize)) -> Option<(f64, f64, f64)> {
    let mut all = (f64::MAX, f64::MIN, 0.0);
    let mut rows = 0;
    for value in (first..=last).filter_map(|row| channel.get(row).ok()) {
        all = (f64::min(all.0, value), f64::max(all.1, value), all.2 + value * value);
        rows += 1;
    }
    (rows > 0).then(|| (all.0, all.1, (all.2 / rows as f64).sqrt()))
}

/// Whether the drive of a wheel changes enough to turn it, well above what friction can hold.
fn drive_moves(robot: &RobotFile, (name, drive): (&str, &Channel), stands: bool, rows: (usize, usize)) -> bool {
    let Some((low, high, rms)) = range(drive, rows) else {
        return false;
    };
    let top = largest(drive);
    let f = &robot.friction;
    // at least half of the wheels share what holds the body
    let sharing = robot.wheel.len() as f64 / 2.0;
    let held_nm = f.coulomb_v_n.hypot(f.coulomb_vn_n) / sharing * robot.wheel[0].radius_m;
    let held_a = held_nm / (robot.motor.gear_ratio * robot.motor.torque_constant_nm_per_a);
    let least = match name {
        "u" => held_a * robot.motor.resistance_ohm + 0.5,
        "i" => 1.5 * held_a,
        _ => 3.0 * robot.sensors.wheel_speed_noise_rad_s,
    };
    high - low > 0.4 * top && rms > 0.2 * top && (rms > least || !stands)
}

/// Whether a channel stands at something else than zero while another of its group goes on changing.
fn alive(channels: &[Channel], this: usize, rows: (usize, usize)) -> bool {
    let changes = |channel: &Channel| range(channel, rows).is_some_and(|(low, high, _)| high > low);
    channels[this].get(rows.0) != Ok(0.0) && channels.iter().enumerate().any(|(j, c)| j != this && changes(c))
}

/// Whether a channel is zero all along while all others of its group show noise, at rest as well.
fn dead(channels: &[Channel], this: usize) -> bool {
    let awake = |channel: &Channel| {
        let slow = 0.05 * largest(channel);
        let near = channel.present().filter(|(_, value)| *value != 0.0 && value.abs() < slow).count();
        noisy(channel) && near >= LONG_ROWS && !channel.present().any(|(_, value)| value == 0.0)
    };
    largest(&channels[this]) == 0.0 && channels.iter().enumerate().all(|(j, c)| j == this || awake(c))
}

/// Whether volts and current say that a wheel turns: held still, its volts are its current's.
fn turned(run: &Run, wheel: usize, (first, last): (usize, usize)) -> bool {
    let (Some(u), Some(i)) = (&run.u, &run.i) else { return false };
    let pairs =
        (first..=last).filter_map(|row| Some((u.channels[wheel].get(row).ok()?, i.channels[wheel].get(row).ok()?)));
    let (mut uu, mut ui, mut ii, mut rows) = (0.0, 0.0, 0.0, 0.0);
    for (u, i) in pairs {
        (uu, ui, ii, rows) = (uu + u * u, ui + u * i, ii + i * i, rows + 1.0);
    }
    let left = if ii > 0.0 { uu - ui * ui / ii } else { 0.0 };
    left > 0.3 * uu && uu > rows * LEAST_V * LEAST_V
}

/// Whether another channel of the group changes over these rows.
fn others_move(channels: &[Channel], this: usize, rows: (usize, usize)) -> bool {
    let moves = |channel: &Channel| {
        range(channel, rows).is_some_and(|(low, high, _)| high - low > 0.1 * largest(channel) && high > low)
    };
    channels.iter().enumerate().any(|(j, channel)| j != this && moves(channel))
        || channels.iter().all(|channel| largest(channel) == 0.0)
}

/// By how much volts and speed say the current of a wheel changed (A), in RMS about its mean.
fn current_asked(run: &Run, robot: &RobotFile, wheel: usize, (first, last): (usize, usize)) -> Option<f64> {
    let (u, w) = (&run.u.as_ref()?.channels[wheel], &run.w.as_ref()?.channels[wheel]);
    let asked = |row| {
        let volts = u.get(row).ok()? - robot.volts_per_wheel_speed() * w.get(row).ok()?;
        Some(volts / robot.motor.resistance_ohm)
    };
    let all: Vec<f64> = (first..=last).filter_map(asked).collect();
    let mean = all.iter().sum::<f64>() / all.len().max(1) as f64;
    Some((all.iter().map(|i| (i - mean) * (i - mean)).sum::<f64>() / all.len().max(1) as f64).sqrt())
}

/// How far the wheels say the robot went in the world: x (m), y (m), heading (rad).
fn travelled(run: &Run, robot: &RobotFile, (first, last): (usize, usize)) -> Option<[f64; 3]> {
    let speeds = run.w.as_ref().filter(|w| !w.unsigned)?;
    let body = BodyFromWheels::new(robot)?;
    let mut at = [0.0, 0.0, run.pose.as_ref()?.channels[2].get(first).unwrap_or(0.0)];
    let start = at;
    for row in first + 1..=last {
        let Some(w) = row_of(speeds, row) else { continue };
        let ([v, vn, yaw], length_s) = (body.twist(&w), run.t_s[row] - run.t_s[row - 1]);
        let (sin, cos) = at[2].sin_cos();
        at = [at[0] + (cos * v - sin * vn) * length_s, at[1] + (sin * v + cos * vn) * length_s, at[2] + yaw * length_s];
    }
    Some(std::array::from_fn(|axis| at[axis] - start[axis]))
}
