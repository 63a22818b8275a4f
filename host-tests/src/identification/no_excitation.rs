//! Recordings without excitation: of a robot that stands, and of one that is never driven along an axis.

use model_core::plant::Input;
use omni_gap::identify::Refused;
use omni_gap::log::Run;
use omni_gap::simulate::{AlignedRun, Model, Sensing, record};
use omni_gap::simulate_experiments::simulate_experiments;
use rayon::prelude::*;

use super::case::StudyCase;
use super::joint_fit::{JointAnswer, joint_fit};
use super::prior::PriorRobot;

/// How long the robot stands [s]
pub const STANDS: f64 = 10.0;

/// What the robot does not do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MissingExcitation {
    /// Move: all voltages are zero.
    Motion,
    /// Drive: it only turns.
    Driving,
    /// Drive along vn: v and ω alone.
    Sideways,
}

impl MissingExcitation {
    /// Robots of which this is asked: a standing one may be taken for a moving one by chance, and rarely.
    pub const fn seeds(self) -> u64 {
        match self {
            Self::Motion => 20,
            Self::Driving | Self::Sideways => 2,
        }
    }

    /// What the robot does, in words.
    pub const fn does(self) -> &'static str {
        match self {
            Self::Motion => "stands, all voltages zero",
            Self::Driving => "only turns, no run along v or vn",
            Self::Sideways => "no run along vn",
        }
    }

    /// True if a run of this name is left out.
    fn leaves_out(self, run: &str) -> bool {
        match self {
            Self::Motion => true,
            Self::Driving => run.contains("-v-") || run.contains("-vn-"),
            Self::Sideways => run.contains("-vn-"),
        }
    }
}

/// What was answered.
#[derive(Clone, Debug)]
pub struct NoExcitation {
    /// Wheels of the robot.
    pub wheels: usize,
    /// How it is measured.
    pub sensing: Sensing,
    /// What is lacking.
    pub missing: MissingExcitation,
    /// The answer of each trial.
    pub answers: Vec<Result<JointAnswer, Refused>>,
}

/// All that is asked: standing robots however they are measured, the others with modern sensors.
pub const NO_EXCITATION_CASES: [(MissingExcitation, Sensing); 5] = [
    (MissingExcitation::Motion, Sensing::Paper),
    (MissingExcitation::Motion, Sensing::Modern),
    (MissingExcitation::Motion, Sensing::Halls),
    (MissingExcitation::Driving, Sensing::Modern),
    (MissingExcitation::Sideways, Sensing::Modern),
];

/// Records robots that lack excitation, and asks for their numbers.
pub fn without_excitation(wheels: usize, missing: MissingExcitation, sensing: Sensing, seeds: u64) -> NoExcitation {
    let case = StudyCase { wheels, sensing, camera_correlation: 0.0, repeats: 1, seeds };
    let trial = |seed| match wheels {
        3 => answer::<3>(case, missing, seed),
        _ => answer::<4>(case, missing, seed),
    };
    NoExcitation { wheels, sensing, missing, answers: (1..=seeds).into_par_iter().map(trial).collect() }
}

fn answer<const N: usize>(case: StudyCase, missing: MissingExcitation, seed: u64) -> Result<JointAnswer, Refused> {
    let truth = case.truth();
    let prior = PriorRobot::drawn(&truth, seed);
    let runs = match missing {
        MissingExcitation::Motion => vec![standing::<N>(case, seed)],
        _ => {
            let mut runs = simulate_experiments(&truth, &case.plan(), &case.recording(), seed);
            runs.retain(|run| !missing.leaves_out(&run.name));
            runs
        }
    };
    let recorded: Vec<AlignedRun<N>> = runs.iter().filter_map(|run| AlignedRun::new(run, &prior.file)).collect();
    joint_fit(&prior, case.plan().voltage, &recorded)
}

fn standing<const N: usize>(case: StudyCase, seed: u64) -> Run {
    let rows = (STANDS * case.sensing.rate()).round() as usize;
    let t: Vec<f64> = (0..rows).map(|row| row as f64 / case.sensing.rate()).collect();
    let plant = Model::<N>::nominal(&case.truth(), case.plan().voltage).plant();
    record(&plant, "standing", &t, &vec![Input::Voltage([0.0; N]); rows], &case.recording(), seed)
}
