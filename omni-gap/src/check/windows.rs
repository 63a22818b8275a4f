//! Stretches of a run over which wheels and pose are compared.

use super::body::{BodyFromWheels, MOST_CHANNELS, row_of};
use crate::log::{RobotFile, Run};

/// Length of a window (s), and from the start of one to the start of the next.
const WINDOW_S: f64 = 0.25;
const APART_S: f64 = 0.1;
/// Delays of a camera that are tried (s).
pub(super) const DELAYS_S: [f64; 5] = [0.0, 0.03, 0.06, 0.09, 0.12];

/// One window: rim speeds (m/s) and the twist they make, and the pose's step as world speed (m/s), yaw rate (rad/s) and
/// middle heading (rad).
#[derive(Clone)]
pub(super) struct Window {
    pub rims: Vec<f64>,
    pub twist: [f64; 3],
    pub world: [f64; 2],
    pub yaw: f64,
    pub heading: f64,
}

type Row = [f64; MOST_CHANNELS];

/// How far each wheel has turned (rad) by each row that has all speeds.
fn turned(run: &Run) -> Option<Vec<(f64, Row)>> {
    let speed = run.w.as_ref().filter(|w| !w.unsigned)?;
    let mut at = [0.0; MOST_CHANNELS];
    let mut last: Option<(f64, Row)> = None;
    let mut all = Vec::with_capacity(run.rows());
    for (row, &t) in run.t_s.iter().enumerate() {
        let Some(now) = row_of(speed, row) else { continue };
        if let Some((before_t, before)) = &last {
            for j in 0..at.len() {
                at[j] += 0.5 * (now[j] + before[j]) * (t - before_t);
            }
        }
        all.push((t, at));
        last = Some((t, now));
    }
    Some(all)
}

/// The wheels' angles at a time, on a straight line between the rows around it; none across a gap.
fn angles_at(turned: &[(f64, Row)], t: f64) -> Option<Row> {
    let after = turned.partition_point(|(at, _)| *at < t);
    let (next_t, next) = turned.get(after)?;
    if *next_t == t {
        return Some(*next);
    }
    let (last_t, last) = &turned[after.checked_sub(1)?];
    let share = (t - last_t) / (next_t - last_t);
    (next_t - last_t < WINDOW_S).then(|| std::array::from_fn(|j| last[j] + share * (next[j] - last[j])))
}

/// The windows of a run if its camera is late by `delay_s`.
pub(super) fn windows(run: &Run, robot: &RobotFile, delay_s: f64) -> Option<Vec<Window>> {
    let (turned, pose, body) = (turned(run)?, run.pose.as_ref()?, BodyFromWheels::new(robot)?);
    let seen: Vec<(f64, Row)> = (0..run.rows()).filter_map(|row| Some((run.t_s[row], row_of(pose, row)?))).collect();
    let mut all = Vec::new();
    let mut next = f64::MIN;
    // every delay is tried on the same windows
    let first = run.t_s.first()? + DELAYS_S[DELAYS_S.len() - 1];
    for (k, (start, before)) in seen.iter().enumerate() {
        if *start < next || *start < first {
            continue;
        }
        let Some((end, after)) = seen[k..].iter().find(|(t, _)| t - start >= WINDOW_S) else { break };
        let length = end - start;
        let angles = angles_at(&turned, start - delay_s).zip(angles_at(&turned, end - delay_s));
        let Some((from, to)) = angles.filter(|_| length < 2.0 * WINDOW_S) else { continue };
        next = start + APART_S;
        let speeds: Vec<f64> = from.iter().zip(&to).map(|(a, b)| (b - a) / length).collect();
        all.push(Window {
            rims: speeds.iter().zip(&robot.wheel).map(|(w, wheel)| wheel.radius_m * w).collect(),
            twist: body.twist(&speeds),
            world: [(after[0] - before[0]) / length, (after[1] - before[1]) / length],
            yaw: (after[2] - before[2]) / length,
            heading: 0.5 * (after[2] + before[2]),
        });
    }
    Some(all)
}

/// A stretch between two poses: how far the pose went in it, and how far the wheels say, by their clock.
pub(super) struct Stretch {
    /// Steps of x (m), y (m) and heading (rad).
    pub pose: [f64; 3],
    /// ∫v (m), ∫vn (m) and ∫ω (rad) by the wheels.
    pub wheels: [f64; 3],
    /// Heading at its beginning and at its end (rad).
    pub heading: (f64, f64),
}

/// Poses from the beginning of a stretch to its end, and the fewest stretches that tell anything.
const POSES: (usize, usize) = (5, 25);
const STRETCHES: usize = 40;
const FEWEST: usize = 12;

/// A run in stretches of some poses, whatever its clock says of their length.
pub(super) fn stretches(run: &Run, robot: &RobotFile) -> Option<Vec<Stretch>> {
    let (turned, pose, body) = (turned(run)?, run.pose.as_ref()?, BodyFromWheels::new(robot)?);
    let seen: Vec<(f64, Row)> = (0..run.rows()).filter_map(|row| Some((run.t_s[row], row_of(pose, row)?))).collect();
    let each = (seen.len() / STRETCHES).clamp(POSES.0, POSES.1);
    let at = |t: f64| turned.get(turned.partition_point(|(at, _)| *at < t)).map(|(_, angles)| *angles);
    let stretch = |pair: &[usize]| {
        let ((start, before), (end, after)) = (&seen[pair[0]], &seen[pair[1]]);
        let (from, to) = (at(*start)?, at(*end)?);
        let by_wheels: Row = std::array::from_fn(|j| to[j] - from[j]);
        let pose = std::array::from_fn(|axis| after[axis] - before[axis]);
        Some(Stretch { pose, wheels: body.twist(&by_wheels), heading: (before[2], after[2]) })
    };
    let ends: Vec<usize> = (0..seen.len()).step_by(each).collect();
    let all: Vec<Stretch> = ends.windows(2).filter_map(stretch).collect();
    (all.len() >= FEWEST).then_some(all)
}
