//! Modern sensors with one group missing at a time: what can still be told, and what no longer.

use omni_gap::identify::Refused;
use omni_gap::log::Run;
use omni_gap::rehearse::rehearse;
use omni_gap::simulate::{Recorded, Sensing};
use rayon::prelude::*;

use super::asked::{Answer, asked};
use super::believed::Believed;
use super::case::Case;

/// A group of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// Motor currents.
    Currents,
    /// Wheel speeds.
    WheelSpeeds,
    /// The camera's poses.
    Pose,
    /// Motor voltages; the measured currents drive the model in their place.
    Voltages,
}

impl Group {
    /// All of them.
    pub const ALL: [Group; 4] = [Self::Currents, Self::WheelSpeeds, Self::Pose, Self::Voltages];

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
    pub fn taken_from(self, run: &mut Run) {
        match self {
            Self::Currents => run.i = None,
            Self::WheelSpeeds => run.w = None,
            Self::Pose => run.pose = None,
            Self::Voltages => run.u = None,
        }
    }
}

/// Mornings with each group missing.
pub const SEEDS: u64 = 3;

/// What was answered with a group missing.
#[derive(Clone, Debug)]
pub struct Missing {
    /// Wheels of the robot.
    pub wheels: usize,
    /// What is missing.
    pub group: Group,
    /// The answer of each morning.
    pub answers: Vec<Result<Answer, Refused>>,
}

/// Plays mornings of a modern robot, of whose recordings a group is missing.
pub fn missing(wheels: usize, group: Group, seeds: u64) -> Missing {
    let case = Case { wheels, sensing: Sensing::Modern, camera_correlation: 0.0, repeats: 1, seeds };
    let morning = |seed| match wheels {
        3 => morning::<3>(case, group, seed),
        _ => morning::<4>(case, group, seed),
    };
    Missing { wheels, group, answers: (1..=seeds).into_par_iter().map(morning).collect() }
}

fn morning<const N: usize>(case: Case, group: Group, seed: u64) -> Result<Answer, Refused> {
    let truth = case.truth();
    let believed = Believed::drawn(&truth, seed);
    let mut runs = rehearse(&truth, &case.plan(), &case.recording(), seed);
    for run in &mut runs {
        group.taken_from(run);
    }
    let recorded: Vec<Recorded<N>> = runs.iter().filter_map(|run| Recorded::new(run, &believed.file)).collect();
    asked(&believed, case.plan().voltage, &recorded)
}
