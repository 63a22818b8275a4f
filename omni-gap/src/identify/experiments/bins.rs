//! Motion in steps of a camera frame or more: what was driven and how the body moved, averaged from frame to frame.
//!
//! The mean velocity between two frames is exact however the robot moved: it is the way over the time. Where wheels are
//! measured they tell it better; their samples are averaged over the same stretches.

use model_core::geometry::frames::{BodyTwist, Pose, WorldTwist};
use model_core::geometry::kinematics::Wheels;

use crate::simulate::{AlignedRun, SignalGroup};

/// A stretch of a run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bin<const N: usize> {
    /// Rows: first, and the first of the next
    pub rows: (usize, usize),
    /// Length [s]
    pub dt: f64,
    /// Mean twist [m/s, m/s, rad/s]
    pub twist: [f64; 3],
    /// Mean voltages [V]
    pub volts: [f64; N],
    /// Bridges open all the time, or driven all the time; `None`: some of both.
    pub open: Option<bool>,
}

/// The run in stretches of `length` [s] or the next longer that ends with a camera frame.
pub(super) fn bins<const N: usize>(run: &AlignedRun<N>, wheels: &Wheels<N, f64>, length: f64) -> Vec<Bin<N>> {
    let channels = AlignedRun::<N>::channels();
    let by_wheels = run.has_group(SignalGroup::WheelSpeed);
    let seen = |row: usize| by_wheels || channels.pose().into_iter().all(|c| run.saw(row, c));
    let mut bins = Vec::new();
    let mut from = match (0..run.rows()).find(|row| seen(*row)) {
        Some(row) => row,
        None => return bins,
    };
    for to in (from + 1..run.rows()).filter(|row| seen(*row)) {
        if run.t[to] - run.t[from] < length - 1e-9 {
            continue;
        }
        let twist = if by_wheels { of_wheels(run, wheels, from, to) } else { Some(of_frames(run, from, to)) };
        if let Some(twist) = twist {
            bins.push(bin(run, (from, to), twist));
        }
        from = to;
    }
    bins
}

fn bin<const N: usize>(run: &AlignedRun<N>, rows: (usize, usize), twist: [f64; 3]) -> Bin<N> {
    let dt = run.t[rows.1] - run.t[rows.0];
    let mut volts = [0.0; N];
    for row in rows.0..rows.1 {
        for (mean, u) in volts.iter_mut().zip(run.input[row]) {
            *mean += u * run.dt[row] / dt;
        }
    }
    let bridges = &run.open[rows.0..rows.1];
    let all = |state: bool| bridges.iter().all(|open| *open == [state; N]).then_some(state);
    let open = all(true).or(all(false));
    Bin { rows, dt, twist, volts, open }
}

/// Way over time between two frames, in the axes of the heading in between.
fn of_frames<const N: usize>(run: &AlignedRun<N>, from: usize, to: usize) -> [f64; 3] {
    let channels = AlignedRun::<N>::channels();
    let (pose, theta) = (|row: usize| channels.pose().map(|c| run.measured[row][c]), channels.heading());
    let (a, b, dt) = (pose(from), pose(to), run.t[to] - run.t[from]);
    let mut headings = (from..=to).filter(|row| run.saw(*row, theta)).map(|row| run.measured[row][theta]);
    let first = headings.next().unwrap_or(a[2]);
    let (sum, count) = headings.fold((first, 1.0), |(sum, n), theta| (sum + theta, n + 1.0));
    let world = WorldTwist { x: (b[0] - a[0]) / dt, y: (b[1] - a[1]) / dt, w: (b[2] - a[2]) / dt };
    Pose { x: 0.0, y: 0.0, theta: sum / count }.to_body(world).to_array()
}

/// A wheel that nothing was heard of for so long before and after stands still: hall sensors have no edge to tell [s]
const SILENCE: f64 = 0.1;

/// The least-squares twist of the wheels' mean speeds; `None` where a wheel's speed was lost.
fn of_wheels<const N: usize>(run: &AlignedRun<N>, wheels: &Wheels<N, f64>, from: usize, to: usize) -> Option<[f64; 3]> {
    let mut speed = [0.0; N];
    for (j, mean) in speed.iter_mut().enumerate() {
        let w = AlignedRun::<N>::channels().wheel_speed(j);
        // a sample on the border belongs half to each side
        let share = |row: usize| if row == from || row == to { 0.5 } else { 1.0 };
        let told = (from..=to).filter(|row| run.saw(*row, w));
        let (sum, n) = told.fold((0.0, 0.0), |(sum, n), row| (sum + share(row) * run.measured[row][w], n + share(row)));
        *mean = match n {
            0.0 => {
                let first = run.t.partition_point(|t| *t < run.t[from] - SILENCE);
                let end = run.t.partition_point(|t| *t < run.t[to] + SILENCE);
                if (first..end).any(|row| run.saw(row, w)) {
                    return None;
                }
                0.0
            }
            n => sum / n,
        };
    }
    let BodyTwist { v, vn, w } = wheels.twist_of_wheel_speeds(speed);
    Some([v, vn, w])
}

/// Mean of a measured channel over rows; `None` where it was not measured.
pub(super) fn mean_of<const N: usize>(run: &AlignedRun<N>, channel: usize, rows: (usize, usize)) -> Option<f64> {
    let told = (rows.0..rows.1).filter(|row| run.saw(*row, channel));
    let (sum, n) = told.fold((0.0, 0.0), |(sum, n), row| (sum + run.measured[row][channel], n + 1.0));
    (n > 0.0).then(|| sum / n)
}
