//! A pose that is logged more often than the camera sees: its last value repeated on the rows between two frames.
//!
//! All three numbers then stand still together and change together. A coarse pose also repeats itself, but each of its
//! numbers changes on rows of its own.

use super::Fault;
use super::body::{speed_from_pose, speed_from_wheels};
use crate::log::{RobotFile, Run};

/// Slower than this (m/s) a robot may well repeat itself.
const MOVING_M_S: f64 = 0.05;
/// A longer stand is a frozen camera (s).
const LONGEST_S: f64 = 0.4;
/// Of the rows in motion, so many must repeat; of those that change, so many must change all three numbers.
const REPEATED: f64 = 0.1;
const TOGETHER: f64 = 0.8;
const FEWEST: usize = 60;

pub(super) fn check(run: &Run, robot: &RobotFile) -> Option<Fault> {
    let pose = run.pose.as_ref()?;
    let speed = speed_from_wheels(run, robot).or_else(|| speed_from_pose(run, robot, 0.25))?;
    let sample = |row: usize| {
        Some([pose.channels[0].get(row).ok()?, pose.channels[1].get(row).ok()?, pose.channels[2].get(row).ok()?])
    };
    let seen: Vec<(usize, [f64; 3])> = (0..run.rows()).filter_map(|row| Some((row, sample(row)?))).collect();
    let (mut repeated, mut changed, mut together) = (0usize, 0usize, 0usize);
    let (mut first, mut last) = (None, 0);
    let mut from = 0;
    for to in 1..=seen.len() {
        if to < seen.len() && seen[to].1 == seen[from].1 {
            continue;
        }
        // one stand: rows from..to, all of one value
        let moving = (from..to).all(|k| speed[seen[k].0].is_some_and(|v| v > MOVING_M_S));
        let length_s = run.t_s[seen[to - 1].0] - run.t_s[seen[from].0];
        if moving && length_s < LONGEST_S && from > 0 {
            changed += 1;
            together += usize::from((0..3).all(|axis| seen[from].1[axis] != seen[from - 1].1[axis]));
            repeated += to - from - 1;
            if to - from > 1 {
                first = first.or(Some(seen[from].0));
                last = seen[to - 1].0;
            }
        }
        from = to;
    }
    let all = repeated + changed;
    let held = all >= FEWEST && repeated as f64 > REPEATED * all as f64 && together as f64 > TOGETHER * changed as f64;
    let first = first.filter(|_| held)?;
    let sentence = format!(
        "The pose repeats its last value to the last digit on {repeated} of {all} rows on which the robot moves: the camera is slower than the log."
    );
    let fix = "Leave x_m, y_m and theta_rad empty on rows without a new frame.";
    Some(Fault::of(run, "held_pose", "x_m, y_m, theta_rad", true).at(first, last).says(sentence, fix))
}
