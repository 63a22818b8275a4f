//! Motion that grows while nothing drives the robot: somebody pushed it.
//!
//! After a drive a robot coasts, and slows down; with a delay in the drive or the camera it may speed up for some tenths of
//! a second. A floor that slopes makes it roll, but gently.

use super::Fault;
use super::body::{input, largest, speed_from_pose, speed_from_wheels};
use super::ranked::ranked;
use crate::log::{RobotFile, Run};

/// How long the drive must have been off before growth counts (s).
const SETTLE_S: f64 = 0.5;
/// By how much the speed must grow (m/s).
const GROWTH_M_S: f64 = 0.1;
/// What a slope of three degrees can do (m/s²).
const ROLL_M_S2: f64 = 0.5;

pub(super) fn check(run: &Run, robot: &RobotFile) -> Option<Fault> {
    let (name, drive) = input(run)?;
    let none: Vec<f64> = drive
        .channels
        .iter()
        .map(|channel| match name {
            "u" => (0.02 * largest(channel)).max(0.05),
            "i" => (3.0 * robot.sensors.current_noise_a + drive.quantum.unwrap_or(0.0)).max(0.05 * largest(channel)),
            _ => 0.01 * largest(channel),
        })
        .collect();
    let off = |row: usize| drive.channels.iter().zip(&none).all(|(c, none)| c.get(row).is_ok_and(|v| v.abs() <= *none));
    if name == "i" && run.w.is_none() {
        return None;
    }
    let wheels = speed_from_wheels(run, robot);
    let pose = speed_from_pose(run, robot, 0.25);
    let (mut rows, mut pushed_s, mut top, mut steep): (Vec<(usize, usize)>, f64, f64, bool) =
        (Vec::new(), 0.0, 0.0, false);
    // a tenth of a second in all
    let half = ((0.05 / run.median_step_s()) as usize).max(2);
    let mut from = 0;
    for to in 0..=run.rows() {
        if to < run.rows() && off(to) {
            continue;
        }
        if to > from + 1 && run.t_s[to - 1] - run.t_s[from] > SETTLE_S + 0.2 {
            for speed in [&wheels, &pose].into_iter().flatten() {
                if let Some((first, last, growth, rate)) = growth(run, speed, half, (from, to - 1)) {
                    rows.push((first, last));
                    pushed_s += run.t_s[last] - run.t_s[first];
                    top = f64::max(top, growth);
                    steep |= rate > ROLL_M_S2;
                    break;
                }
            }
        }
        from = to + 1;
    }
    let (first, last) = (rows.first()?.0, rows.last()?.1);
    let share = pushed_s / run.duration_s();
    let sentence = format!(
        "While `{name}` was zero the robot sped up by {top:.2} m/s ({} time(s), {pushed_s:.1} s in all, from {:.1} s on): something pushed it.",
        rows.len(),
        run.t_s[first]
    );
    let fix = "Leave the robot alone while it records, or cut these rows out.";
    Some(Fault::of(run, "pushed", "w", steep && share > 0.2).at(first, last).says(sentence, fix))
}

/// The largest growth of a speed within rows without drive: from the lowest to the highest after it.
fn growth(
    run: &Run,
    speed: &[Option<f64>],
    half: usize,
    (first, last): (usize, usize),
) -> Option<(usize, usize, f64, f64)> {
    let start_s = run.t_s[first] + SETTLE_S;
    let smooth = smoothed(speed, half, (first, last));
    let mut low: Option<(usize, f64)> = None;
    let mut best: Option<(usize, usize, f64)> = None;
    for &(row, now) in smooth.iter().filter(|(row, _)| run.t_s[*row] >= start_s && run.t_s[*row] <= run.t_s[last] - 0.1)
    {
        if low.is_none_or(|(_, least)| now < least) {
            low = Some((row, now));
        }
        let (from, least) = low?;
        if now - least > best.map_or(GROWTH_M_S, |best| best.2) {
            best = Some((from, row, now - least));
        }
    }
    // the motion lasts until the speed has fallen to half again, or the drive is back
    best.map(|(from, at, growth)| {
        let gone = |row: &usize| speed[*row].is_some_and(|s| s < 0.5 * growth);
        let least = smooth.iter().find(|(row, _)| *row == from).map_or(0.0, |(_, least)| *least);
        let begun =
            smooth.iter().rfind(|(row, now)| *row < at && *now < least + 0.2 * growth).map_or(from, |(row, _)| *row);
        let begun = begun.max(from);
        let grown =
            smooth.iter().find(|(row, now)| *row > begun && *now > least + 0.8 * growth).map_or(at, |(row, _)| *row);
        let rate = 0.6 * growth / (run.t_s[grown] - run.t_s[begun]).max(0.05);
        (begun, (at..=last).find(gone).unwrap_or(last), growth, rate)
    })
}

/// Middle values over `half` rows to either side.
fn smoothed(speed: &[Option<f64>], half: usize, (first, last): (usize, usize)) -> Vec<(usize, f64)> {
    let mut near = Vec::with_capacity(2 * half + 1);
    let middle = |row: usize| {
        near.clear();
        near.extend((row.saturating_sub(half).max(first)..=(row + half).min(last)).filter_map(|r| speed[r]));
        let rank = near.len() / 2;
        Some((row, ranked(&mut near, rank)?))
    };
    (first..=last).filter_map(middle).collect()
}
