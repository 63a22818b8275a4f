//! Modern sensors with one group missing at a time: what can still be told, and what no longer.

use omni_gap::identify::Refused;
use omni_gap::log::Run;
use omni_gap::simulate::{AlignedRun, Sensing};
use omni_gap::simulate_experiments::simulate_experiments;
use rayon::prelude::*;

use super::case::StudyCase;
use super::joint_fit::{JointAnswer, joint_fit};
use super::prior::PriorRobot;

/// A group of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SensorGroup {
    /// Motor currents.
    Currents,
    /// Wheel speeds.
    WheelSpeeds,
    /// The camera's poses.
    Pose,
    /// Motor voltages; the measured currents drive the model in their place.
    Voltages,
}

impl SensorGroup {
    /// All of them.
    pub const ALL: [SensorGroup; 4] = [Self::Currents, Self::WheelSpeeds, Self::Pose, Self::Voltages];

    /// Its name.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Currents => "currents",
            Self::WheelSpeeds => "wheel speeds",
            Self::Pose => "pose",
            Self::Voltages => "voltages",
        }
    }

    /// Takes it out of a recording.
    pub fn remove_from(self, run: &mut Run) {
        match self {
            Self::Currents => run.i = None,
            Self::WheelSpeeds => run.w = None,
            Self::Pose => run.pose = None,
            Self::Voltages => run.u = None,
        }
    }
}

/// Trials with each group missing.
pub const SEEDS: u64 = 3;

/// What was answered with a group missing.
#[derive(Clone, Debug)]
pub struct MissingGroup {
    /// Wheels of the robot.
    pub wheels: usize,
    /// What is missing.
    pub group: SensorGroup,
    /// The answer of each trial.
    pub answers: Vec<Result<JointAnswer, Refused>>,
}

/// Plays trials of a modern robot, of whose recordings a group is missing.
pub fn without_group(wheels: usize, group: SensorGroup, seeds: u64) -> MissingGroup {
    let case = StudyCase { wheels, sensing: Sensing::Modern, camera_correlation: 0.0, repeats: 1, seeds };
    let trial = |seed| match wheels {
        3 => trial::<3>(case, group, seed),
        _ => trial::<4>(case, group, seed),
    };
    MissingGroup { wheels, group, answers: (1..=seeds).into_par_iter().map(trial).collect() }
}

fn trial<const N: usize>(case: StudyCase, group: SensorGroup, seed: u64) -> Result<JointAnswer, Refused> {
    let truth = case.truth();
    let prior = PriorRobot::drawn(&truth, seed);
    let mut runs = simulate_experiments(&truth, &case.plan(), &case.recording(), seed);
    for run in &mut runs {
        group.remove_from(run);
    }
    let recorded: Vec<AlignedRun<N>> = runs.iter().filter_map(|run| AlignedRun::new(run, &prior.file)).collect();
    joint_fit(&prior, case.plan().voltage, &recorded)
}
