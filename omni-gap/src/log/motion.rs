//! # How the robot moved, as one file tells it: for comparing clocks
//!
//! Whatever a file has, wheel speeds, a gyro or a pose, becomes the same curves: how far the body went along v, along vn
//! and in heading since the file began, ∫v dt, ∫vn dt and ∫ω dt.

use super::body_from_wheels::{BodyFromWheels, row_of};
use super::median_step::median_step;
use super::robot_file::RobotFile;
use super::run::{Group, Run};

/// A gap of this many usual steps breaks a curve: nobody knows what was in it.
const GAP_STEPS: f64 = 5.0;

/// How far the body went, by one file.
#[derive(Debug)]
pub(super) struct Motion {
    /// What tells it, for messages.
    pub told_by: &'static str,
    /// Times of its points (s).
    pub t_s: Vec<f64>,
    /// By axis: ∫v dt (m), ∫vn dt (m), ∫ω dt (rad); none where the file does not tell.
    pub way: [Option<Vec<f64>>; 3],
    /// How many gaps came before each point.
    gaps: Vec<u32>,
}

impl Motion {
    /// What a run of one file tells, its times as they stand; none where it tells nothing.
    pub fn of(run: &Run, robot: &RobotFile) -> Option<Motion> {
        let signed = |group: &Option<Group>| group.clone().filter(|group| !group.unsigned);
        if let Some(pose) = &run.pose {
            return by_pose(run, pose);
        }
        if let Some(w) = signed(&run.w) {
            return by_wheels(run, &w, robot, "the wheel speeds");
        }
        if let Some(gyro) = &run.gyro {
            let rates: Vec<(usize, f64)> = gyro.present().collect();
            let t_s: Vec<f64> = rates.iter().map(|(row, _)| run.t_s[*row]).collect();
            let [turned] = integrals(&t_s, rates.iter().map(|(_, rate)| [*rate]));
            return Motion::new("the gyro", t_s, [None, None, Some(turned)]);
        }
        by_wheels(run, &signed(&run.wset)?, robot, "the commanded wheel speeds")
    }

    fn new(told_by: &'static str, t_s: Vec<f64>, way: [Option<Vec<f64>>; 3]) -> Option<Motion> {
        if t_s.len() < 2 {
            return None;
        }
        let mut motion = Motion { told_by, t_s, way, gaps: Vec::new() };
        let longest = GAP_STEPS * motion.median_step_s();
        let mut gaps = 0;
        motion.gaps = vec![0];
        for pair in motion.t_s.windows(2) {
            gaps += u32::from(pair[1] - pair[0] > longest);
            motion.gaps.push(gaps);
        }
        Some(motion)
    }

    /// The same on a clock that says so much more (s).
    pub fn later(mut self, by_s: f64) -> Motion {
        self.t_s.iter_mut().for_each(|t| *t += by_s);
        self
    }

    /// How many axes it tells of.
    pub fn axes(&self) -> usize {
        self.way.iter().flatten().count()
    }

    /// The middle one of the steps between points (s).
    pub fn median_step_s(&self) -> f64 {
        median_step(self.t_s.iter().copied()).unwrap_or_default()
    }

    /// How far the body went along an axis between two times (s); none beyond the ends or across a gap.
    pub fn between(&self, axis: usize, from_s: f64, to_s: f64) -> Option<f64> {
        let way = self.way[axis].as_ref()?;
        let ((a, from), (b, to)) = (self.at(way, from_s)?, self.at(way, to_s)?);
        (self.gaps[a] == self.gaps[b]).then_some(to - from)
    }

    /// The point at or after a time (s), and the curve's value on a straight line to it.
    fn at(&self, way: &[f64], time_s: f64) -> Option<(usize, f64)> {
        let after = self.t_s.partition_point(|t| *t < time_s);
        let next_s = *self.t_s.get(after)?;
        if after == 0 {
            return (next_s == time_s).then(|| (0, way[0]));
        }
        let share = (time_s - self.t_s[after - 1]) / (next_s - self.t_s[after - 1]);
        Some((after, way[after - 1] + share * (way[after] - way[after - 1])))
    }
}

fn by_wheels(run: &Run, speeds: &Group, robot: &RobotFile, told_by: &'static str) -> Option<Motion> {
    let body = BodyFromWheels::new(robot)?;
    let rows: Vec<usize> = (0..run.rows()).filter(|row| row_of(speeds, *row).is_some()).collect();
    let t_s: Vec<f64> = rows.iter().map(|row| run.t_s[*row]).collect();
    let twists = rows.iter().filter_map(|row| row_of(speeds, *row)).map(|speeds| body.twist(&speeds));
    let ways = integrals(&t_s, twists).map(Some);
    Motion::new(told_by, t_s, ways)
}

fn by_pose(run: &Run, pose: &Group) -> Option<Motion> {
    let seen: Vec<(f64, [f64; 3])> = (0..run.rows())
        .filter_map(|row| row_of(pose, row).map(|[x, y, heading, _]| (run.t_s[row], [x, y, heading])))
        .collect();
    let mut ways: [Vec<f64>; 3] = [vec![0.0], vec![0.0], vec![0.0]];
    for pair in seen.windows(2) {
        let ([(_, before), (_, after)], last) = ([pair[0], pair[1]], ways[0].len() - 1);
        let (sin, cos) = (0.5 * (before[2] + after[2])).sin_cos();
        let (dx, dy) = (after[0] - before[0], after[1] - before[1]);
        let steps = [cos * dx + sin * dy, cos * dy - sin * dx, after[2] - before[2]];
        ways.iter_mut().zip(steps).for_each(|(way, step)| way.push(way[last] + step));
    }
    Motion::new("the pose", seen.into_iter().map(|(t, _)| t).collect(), ways.map(Some))
}

/// The integrals of rates over time, by trapezoids.
fn integrals<const K: usize>(t_s: &[f64], rates: impl Iterator<Item = [f64; K]>) -> [Vec<f64>; K] {
    let mut ways: [Vec<f64>; K] = std::array::from_fn(|_| Vec::with_capacity(t_s.len()));
    let mut last: Option<[f64; K]> = None;
    for (k, rate) in rates.enumerate() {
        for (axis, way) in ways.iter_mut().enumerate() {
            let step = last.map_or(0.0, |before| 0.5 * (before[axis] + rate[axis]) * (t_s[k] - t_s[k - 1]));
            way.push(way.last().copied().unwrap_or(0.0) + step);
        }
        last = Some(rate);
    }
    ways
}
