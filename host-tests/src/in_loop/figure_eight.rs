//! # Figure-eight: a path with curves to both sides at a constant speed
//!
//! ```text
//! p(θ) = A·cos θ/(1 + sin²θ)·(1, sin θ),   |dp/dθ| = A/√(1 + sin²θ),   dθ/dt = s/|dp/dθ|
//! curvature 3·cos θ/(A·√(1 + sin²θ))
//! ```
//!
//! The speed s grows from rest over half a second, stays what it is, and after a lap falls again; the robot keeps its
//! heading. Commands come a hundred times a second. Those of a twist alone are the speed that the path has when the next one
//! comes; those that tell their change are the speed that it has when they are taken, and the slope to the next one.
//! Nobody corrects positions: what is compared is what the robot makes of its commands. Errors are those of the true motion
//! over the lap at full speed. A wheel that is larger than believed carries the robot faster, in the same proportion always,
//! which no feedback from wheels can see: the velocity error is told without that too.

use std::f64::consts::{FRAC_PI_2, TAU};

use model_core::geometry::frames::BodyTwist;

use super::robots::FEEDBACK_INTEGRAL;
use super::{ClosedLoopRun, TruthSample};
use crate::emulator::{BoardProgram, RunError};

/// A, half the length [m], and s [m/s], of the paper's robots
const USUAL: [f64; 2] = [1.2, 1.0];

/// Time in which it is reached [s]
const STARTING: f64 = 0.5;

/// From one command to the next [s]
const AHEAD: f64 = 0.01;

/// Largest acceleration that the paper's robots are given for this [m/s²]: the path takes 2.5
pub const ACCELERATION: f32 = 3.0;

/// What a command tells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Commands {
    /// A twist alone
    Twist,
    /// How it changes, too
    Ramp,
}

/// A way to command it, and what the robot is set to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Way {
    /// What a command tells
    pub commands: Commands,
    /// Largest acceleration [m/s²]; one that is hardly more than the path's smooths the stairs of twists by itself
    pub acceleration: f32,
    /// k_i [A/rad]
    pub integral: f32,
}

/// The ways that are compared; the first one is what the robots are set to for everything else.
pub const WAYS: [Way; 6] = [
    Way { commands: Commands::Twist, acceleration: ACCELERATION, integral: FEEDBACK_INTEGRAL },
    Way { commands: Commands::Twist, acceleration: 8.0, integral: FEEDBACK_INTEGRAL },
    Way { commands: Commands::Ramp, acceleration: ACCELERATION, integral: FEEDBACK_INTEGRAL },
    Way { commands: Commands::Ramp, acceleration: 8.0, integral: FEEDBACK_INTEGRAL },
    Way { commands: Commands::Twist, acceleration: ACCELERATION, integral: 3.0 },
    Way { commands: Commands::Ramp, acceleration: 8.0, integral: 3.0 },
];

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
    /// The same without what wheels of another radius than believed do to the speed [m/s]
    pub apart: f64,
    /// [m]
    pub position: f64,
}

impl Default for FigureEight {
    fn default() -> Self {
        Self::new(USUAL)
    }
}

impl FigureEight {
    /// The path of a half length [m] at a speed [m/s].
    pub fn new([size, speed]: [f64; 2]) -> Self {
        let dt = 1e-3;
        let (mut theta, mut time, mut points, mut end) = (FRAC_PI_2, 0.0, Vec::new(), f64::INFINITY);
        let mut began = theta;
        while time < end + STARTING {
            let share = (time / STARTING).min((end + STARTING - time) / STARTING).min(1.0);
            let (sin, cos) = theta.sin_cos();
            let below = 1.0 + sin * sin;
            // dθ/dt = s/|dp/dθ|
            let rate = speed * share * below.sqrt() / size;
            // p = A·cos θ/(1 + sin²θ)·(1, sin θ), and its derivative
            let place = [cos, cos * sin].map(|x| size * x / below);
            let slope = [-sin * (2.0 + cos * cos), 1.0 - 3.0 * sin * sin].map(|x| size * x / (below * below));
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

    /// How long it takes [s].
    pub fn duration(&self) -> f64 {
        1e-3 * self.points.len() as f64
    }

    /// The twist that it has at a time [s], of a robot that keeps its heading.
    pub fn twist(&self, time: f64) -> BodyTwist<f64> {
        let [_, [v, vn]] = self.at(time);
        BodyTwist { v, vn, w: 0.0 }
    }

    /// Position [m] and velocity [m/s] at a time [s].
    fn at(&self, time: f64) -> [[f64; 2]; 2] {
        let last = self.points.len() - 1;
        self.points[((1e3 * time).round().max(0.0) as usize).min(last)]
    }

    /// Lets a robot follow it, and says how well it did; `radius` is that of its wheels over what is believed of it [1].
    ///
    /// # Errors
    /// [`RunError`] says what became of the program.
    pub fn track<B: BoardProgram, const N: usize>(
        &self,
        run: &mut ClosedLoopRun<B, N>,
        commands: Commands,
        radius: f64,
    ) -> Result<TrackingError, RunError> {
        let began = run.time();
        match commands {
            Commands::Twist => run.follow(self.duration(), |time| self.twist(time + AHEAD))?,
            Commands::Ramp => run.follow_ramps(self.duration(), |time| self.twist(time))?,
        }
        Ok(self.tracked(&run.log.truth, began, radius))
    }

    /// How far the true motion was off since it began [s].
    pub fn tracked(&self, truth: &[TruthSample], began: f64, radius: f64) -> TrackingError {
        let Some(first) = truth.iter().find(|m| m.time >= began) else { return TrackingError::default() };
        let (mut sum, mut n) = (TrackingError::default(), 0.0);
        for moment in truth.iter().filter(|m| (self.lap[0]..self.lap[1]).contains(&(m.time - began))) {
            let [place, velocity] = self.at(moment.time - began);
            let (sin, cos) = moment.pose.theta.sin_cos();
            let BodyTwist { v, vn, .. } = moment.twist;
            let (vx, vy) = (cos * v - sin * vn, sin * v + cos * vn);
            let off = |share: f64| (share * vx - velocity[0]).powi(2) + (share * vy - velocity[1]).powi(2);
            sum.velocity += off(1.0);
            sum.apart += off(1.0 / radius);
            let (x, y) = (moment.pose.x - first.pose.x, moment.pose.y - first.pose.y);
            sum.position += (x - place[0]).powi(2) + (y - place[1]).powi(2);
            n += 1.0;
        }
        let rms = |sum: f64| (sum / n).sqrt();
        TrackingError { velocity: rms(sum.velocity), apart: rms(sum.apart), position: rms(sum.position) }
    }
}
