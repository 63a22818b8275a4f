//! How well the wheels' speeds of a shifted time explain how the pose moves.
//!
//! ```text
//! Δ(x, y)/Δt = p·R(θ)·(v, vn) of the wheels at t − d,     Δθ/Δt = q·ω of the wheels at t − d
//! ```
//!
//! p and q are whatever fits: slip and a wrong radius change them.

use super::integral::{Between, means};
use super::shifts::{FEWEST_WINDOWS, LeftByShift, MOST_WINDOWS, shifts};
use crate::check::body::{BodyFromWheels, row_of};
use crate::log::{RobotFile, Run};

/// Length of a window [s].
const WINDOW_S: f64 = 0.15;

/// A step of the pose: from when to when [s], its speed in the world [m/s], [rad/s], and the heading in its middle [rad].
struct Step {
    from_s: f64,
    to_s: f64,
    speed: [f64; 3],
    heading: f64,
}

/// Sums of products of what the pose does and what the wheels say.
#[derive(Default)]
struct Products {
    both: f64,
    wheels: f64,
}

impl Products {
    fn add(&mut self, pose: f64, wheels: f64) {
        self.both += pose * wheels;
        self.wheels += wheels * wheels;
    }

    /// Σ pose² that the wheels explain.
    fn explained(&self) -> f64 {
        if self.wheels > 0.0 { self.both.powi(2) / self.wheels } else { 0.0 }
    }
}

/// The share of the pose's speed that the wheels leave, by the shift of the pose.
pub(super) fn left_by_shift(run: &Run, robot: &RobotFile) -> Option<LeftByShift> {
    let speed = run.w.as_ref().filter(|group| !group.unsigned)?;
    let body = BodyFromWheels::new(robot)?;
    let lever_m = robot.wheel[0].distance_m;
    let shifts = shifts(run.duration_s());
    let steps = steps(run, *shifts.last()?);
    if steps.len() < FEWEST_WINDOWS {
        return None;
    }
    let spans: Vec<(f64, f64)> = steps.iter().map(|step| (step.from_s, step.to_s)).collect();
    let turned: Vec<Vec<Vec<f64>>> =
        speed.channels.iter().map(|channel| means(run, channel, Between::Line, &spans, &shifts)).collect();
    let all: f64 = steps.iter().map(|s| s.speed[0].powi(2) + s.speed[1].powi(2) + (lever_m * s.speed[2]).powi(2)).sum();
    let left = |(at, shift): (usize, f64)| {
        let (mut going, mut turning) = (Products::default(), Products::default());
        for (k, Step { speed, heading, .. }) in steps.iter().enumerate() {
            let means: Vec<f64> = turned.iter().map(|wheel| wheel[at][k]).collect();
            let [v, vn, w] = body.twist(&means);
            let (sin, cos) = heading.sin_cos();
            going.add(speed[0], cos * v - sin * vn);
            going.add(speed[1], sin * v + cos * vn);
            turning.add(lever_m * speed[2], lever_m * w);
        }
        (shift, 1.0 - (going.explained() + turning.explained()) / all)
    };
    (all > 0.0).then(|| shifts.into_iter().enumerate().map(left).collect())
}

/// Steps of the pose spread over a run, so far from its ends that every shift stays within it.
fn steps(run: &Run, farthest_s: f64) -> Vec<Step> {
    let (Some(pose), Some(first), Some(last)) = (&run.pose, run.t_s.first(), run.t_s.last()) else { return Vec::new() };
    let seen: Vec<usize> = (0..run.rows()).filter(|row| row_of(pose, *row).is_some()).collect();
    let every = (seen.len() / MOST_WINDOWS).max(1);
    let of = |k: usize| {
        let from_s = run.t_s[seen[k]];
        let end = k + seen[k..].partition_point(|row| run.t_s[*row] < from_s + WINDOW_S);
        let to_s = run.t_s[*seen.get(end)?];
        let length_s = to_s - from_s;
        let sound = from_s - farthest_s >= *first && to_s + farthest_s <= *last && length_s < 2.0 * WINDOW_S;
        let (before, after) = row_of(pose, seen[k]).zip(row_of(pose, seen[end])).filter(|_| sound)?;
        let speed = std::array::from_fn(|axis| (after[axis] - before[axis]) / length_s);
        Some(Step { from_s, to_s, speed, heading: 0.5 * (before[2] + after[2]) })
    };
    (0..seen.len()).step_by(every).filter_map(of).collect()
}
