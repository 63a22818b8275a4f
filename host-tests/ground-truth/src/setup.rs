//! A robot that is watched, and how finely it has to be simulated.

use crate::robot::{Robot, Wheel};
use crate::sensors::Sensors;
use crate::shaft::Shaft;

/// A robot and what watches it.
#[derive(Clone, Debug, PartialEq)]
pub struct Setup {
    /// What moves.
    pub robot: Robot,
    /// What is read of it.
    pub sensors: Sensors,
}

/// Steps of the simulator [s], at the most: half of it moves no robot otherwise (`tests/causes.rs`).
const STEP: f64 = 100e-6;

/// The same, where parts of a drive hit each other.
const STEP_OF_IMPACTS: f64 = 20e-6;

impl Setup {
    /// How long a step of the simulator may last [s].
    pub fn step(&self) -> f64 {
        let hits = |wheel: &Wheel| matches!(wheel.shaft, Shaft::Elastic { play, .. } if play > 0.0);
        if self.robot.wheels.iter().any(hits) { STEP_OF_IMPACTS } else { STEP }
    }
}
