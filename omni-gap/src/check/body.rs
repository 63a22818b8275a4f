//! Wheel speeds as body speed, and which wheel speeds a run has to offer.

use crate::log::{Group, RobotFile, Run};

pub(super) use crate::log::{BodyFromWheels, MOST_CHANNELS, row_of};

/// The input that moves the robot: voltages, or set speeds, or currents.
pub(super) fn input(run: &Run) -> Option<(&'static str, &Group)> {
    let named = [("u", &run.u), ("wset", &run.wset), ("i", &run.i)];
    named.into_iter().find_map(|(name, group)| group.as_ref().map(|group| (name, group)))
}

/// Body speed on each row as one number (m/s): √(v² + vn² + (d ω)²), from the measured wheel speeds.
pub(super) fn speed_from_wheels(run: &Run, robot: &RobotFile) -> Option<Vec<Option<f64>>> {
    let (group, body) = (run.w.as_ref()?, BodyFromWheels::new(robot)?);
    let lever = robot.wheel[0].distance_m;
    let speed = |row| {
        let [v, vn, w] = body.twist(&row_of(group, row)?);
        Some((v * v + vn * vn + lever * lever * w * w).sqrt())
    };
    Some((0..run.rows()).map(speed).collect())
}

/// The same from the pose, by differences over at least `span_s`; each row holds the speed up to it.
pub(super) fn speed_from_pose(run: &Run, robot: &RobotFile, span_s: f64) -> Option<Vec<Option<f64>>> {
    let group = run.pose.as_ref()?;
    let lever = robot.wheel[0].distance_m;
    let mut speeds = vec![None; run.rows()];
    let seen: Vec<(usize, [f64; MOST_CHANNELS])> =
        (0..run.rows()).filter_map(|row| Some((row, row_of(group, row)?))).collect();
    let mut from = 0;
    for to in 1..seen.len() {
        let (row, pose) = &seen[to];
        while from + 1 < to && run.t_s[*row] - run.t_s[seen[from + 1].0] >= span_s {
            from += 1;
        }
        let (earlier, before) = &seen[from];
        let length_s = run.t_s[*row] - run.t_s[*earlier];
        if length_s < span_s || length_s > 4.0 * span_s {
            continue;
        }
        let step: Vec<f64> = pose.iter().zip(before).map(|(a, b)| (a - b) / length_s).collect();
        let turn = lever * step[2];
        speeds[*row] = Some((step[0] * step[0] + step[1] * step[1] + turn * turn).sqrt());
    }
    Some(speeds)
}

/// Largest magnitude in a channel.
pub(super) fn largest(channel: &crate::log::Channel) -> f64 {
    channel.present().map(|(_, value)| value.abs()).fold(0.0, f64::max)
}
