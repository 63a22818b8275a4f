//! # Figure-eight: a path with curves to both sides at a constant speed
//!
//! ```text
//! p(θ) = A·cos θ/(1 + sin²θ)·(1, sin θ),   |dp/dθ| = A/√(1 + sin²θ),   dθ/dt = s/|dp/dθ|
//! curvature 3·cos θ/(A·√(1 + sin²θ))
//! ```
//!
//! The speed s grows from rest over half a second, stays at 1 m/s, and after a lap falls again; the robot keeps its
//! heading. Commands are speeds, a hundred a second; each is the speed that the path has when the next one comes.
//! Nobody corrects positions: what is compared is what the robot makes of its commands. Errors are those of the true motion
//! over the lap at full speed.

use std::f64::consts::{FRAC_PI_2, TAU};

use model_core::geometry::frames::BodyTwist;

use super::{ClosedLoopRun, TruthSample};
use crate::emulator::{BoardProgram, RunError};

/// A, half the length [m]
const SIZE: f64 = 1.2;

/// Speed on the path [m/s]
pub const SPEED: f64 = 1.0;

/// Time in which it is reached [s]
const STARTING: f64 = 0.5;

/// From one command to the next [s]
const AHEAD: f64 = 0.01;

/// Largest acceleration that the robot is given for this [m/s²]: the path takes 2.5
pub const ACCELERATION: f32 = 3.0;

/// The path, sampled every millisecond.
#[derive(Clone, Debug)]
pub struct FigureEight {
    /// Position [m] and velocity [m/s]
    points: Vec<[[f64; 2]; 2]>,
    /// Time at which the lap at full speed begins and ends [s]
    lap: [f64; 2],
}

/// How far a robot was from the path, root mean square over the lap.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TrackingError {
    /// [m/s]
    pub velocity: f64,
    /// [m]
    pub position: f64,
}

impl Default for FigureEight {
    fn default() -> Self {
        let dt = 1e-3;
        let (mut theta, mut time, mut points, mut end) = (FRAC_PI_2, 0.0, Vec::new(), f64::INFINITY);
        let mut began = theta;
        while time < end + STARTING {
            let share = (time / STARTING).min((end + STARTING - time) / STARTING).min(1.0);
            let (sin, cos) = theta.sin_cos();
            let below = 1.0 + sin * sin;
            // dθ/dt = s/|dp/dθ|
            let rate = SPEED * share * below.sqrt() / SIZE;
            // p = A·cos θ/(1 + sin²θ)·(1, sin θ), and its derivative
            let place = [cos, cos * sin].map(|x| SIZE * x / below);
            let slope = [-sin * (2.0 + cos * cos), 1.0 - 3.0 * sin * sin].map(|x| SIZE * x / (below * below));
            points.push([place, slope.map(|x| x * rate)]);
            if time < STARTING {
                began = theta;
            } else if theta >= began + TAU && end.is_infinite() {
                end = time;
            }
            theta += rate * dt;
            time += dt;
        }
        Self { points, lap: [STARTING, end] }
    }
}

impl FigureEight {
    /// How long it takes [s].
    pub fn duration(&self) -> f64 {
        1e-3 * self.points.len() as f64
    }

    /// Position [m] and velocity [m/s] at a time [s].
    fn at(&self, time: f64) -> [[f64; 2]; 2] {
        let last = self.points.len() - 1;
        self.points[((1e3 * time).round().max(0.0) as usize).min(last)]
    }

    /// Lets a robot follow it, and says how well it did.
    ///
    /// # Errors
    /// [`RunError`] says what became of the program.
    pub fn track<B: BoardProgram, const N: usize>(
        &self,
        run: &mut ClosedLoopRun<B, N>,
    ) -> Result<TrackingError, RunError> {
        let began = run.time();
        run.follow(self.duration(), |time| {
            let [_, [v, vn]] = self.at(time + AHEAD);
            BodyTwist { v, vn, w: 0.0 }
        })?;
        Ok(self.tracked(&run.log.truth, began))
    }

    fn tracked(&self, truth: &[TruthSample], began: f64) -> TrackingError {
        let Some(first) = truth.iter().find(|m| m.time >= began) else { return TrackingError::default() };
        let (mut sum, mut n) = (TrackingError::default(), 0.0);
        for moment in truth.iter().filter(|m| (self.lap[0]..self.lap[1]).contains(&(m.time - began))) {
            let [place, velocity] = self.at(moment.time - began);
            let (sin, cos) = moment.pose.theta.sin_cos();
            let BodyTwist { v, vn, .. } = moment.twist;
            let (vx, vy) = (cos * v - sin * vn, sin * v + cos * vn);
            sum.velocity += (vx - velocity[0]).powi(2) + (vy - velocity[1]).powi(2);
            let (x, y) = (moment.pose.x - first.pose.x, moment.pose.y - first.pose.y);
            sum.position += (x - place[0]).powi(2) + (y - place[1]).powi(2);
            n += 1.0;
        }
        TrackingError { velocity: (sum.velocity / n).sqrt(), position: (sum.position / n).sqrt() }
    }
}
