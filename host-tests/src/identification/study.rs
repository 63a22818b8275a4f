//! Many trials of experiments with a robot whose truth is known.
//!
//! Each seed draws what is believed beforehand and the noise, plays all experiments, and asks the paper's estimators and
//! the joint one.

use model_core::plant::robot::Nominal;
use omni_gap::identify::IDENTIFIED;
use omni_gap::identify::experiments::{Estimate, classic};
use omni_gap::log::RobotFile;
use omni_gap::simulate::{AlignedRun, Model};
use omni_gap::simulate_experiments::simulate_experiments;
use rayon::prelude::*;

use super::case::StudyCase;
use super::cramer_rao::cramer_rao_bound;
use super::joint_fit::joint_fit;
use super::prior::{NUMBERS, PriorRobot, nominal_value};

/// An estimate of each number as a factor of the truth, with its one-sigma uncertainty; `None` where there is none.
pub type Estimates = [Option<(f64, f64)>; NUMBERS];

/// What one trial gave.
#[derive(Clone, Debug)]
pub struct Trial {
    /// Experiments 1 and 2, R and K_v of the motor experiment.
    pub first: Estimates,
    /// Experiment 3 by least squares.
    pub least_squares: Estimates,
    /// Experiment 3 by instrumental variables.
    pub instrumental: Estimates,
    /// The paper's table: the average of the first and of experiment 3 (eq. 41), as the paper averages.
    pub table: Estimates,
    /// All runs together.
    pub joint: Estimates,
    /// True if the joint fit predicted whole runs to within noise.
    pub follows: bool,
}

/// All trials of a case.
#[derive(Clone, Debug)]
pub struct StudyResult {
    /// The case.
    pub case: StudyCase,
    /// The trials.
    pub trials: Vec<Trial>,
    /// The Cramér–Rao bound of each number, relative.
    pub bound: [f64; NUMBERS],
    /// Runs of a trial, how long they are together [s], and their rows.
    pub size: (usize, f64, usize),
}

/// Plays the trials of a case.
pub fn study(case: StudyCase) -> StudyResult {
    match case.wheels {
        3 => of_wheels::<3>(case),
        _ => of_wheels::<4>(case),
    }
}

fn of_wheels<const N: usize>(case: StudyCase) -> StudyResult {
    let truth = case.truth();
    let played = simulate_experiments(&truth, &case.plan(), &case.recording(), 0);
    let size = (played.len(), played.iter().map(|r| r.duration_s()).sum(), played.iter().map(|r| r.rows()).sum());
    let recorded: Vec<AlignedRun<N>> = played.iter().filter_map(|run| AlignedRun::new(run, &truth)).collect();
    let bound = cramer_rao_bound(&Model::nominal(&truth, case.plan().voltage), &recorded, case.camera_correlation);
    let trials = (1..=case.seeds).into_par_iter().map(|seed| trial::<N>(&truth, case, seed)).collect();
    StudyResult { case, trials, bound, size }
}

fn trial<const N: usize>(truth: &RobotFile, case: StudyCase, seed: u64) -> Trial {
    let prior = PriorRobot::drawn(truth, seed);
    let runs = simulate_experiments(truth, &case.plan(), &case.recording(), seed);
    let recorded: Vec<AlignedRun<N>> = runs.iter().filter_map(|run| AlignedRun::new(run, &prior.file)).collect();
    let supply = case.plan().voltage;
    let classic = classic(&Model::<N>::nominal(&prior.file, supply), &recorded);
    let of_truth = |k: usize, e: Estimate| {
        let true_value = nominal_value(truth, IDENTIFIED[k]);
        (e.value / true_value, e.std / true_value)
    };
    let table = |pick: &dyn Fn(Nominal) -> Option<Estimate>| -> Estimates {
        std::array::from_fn(|k| pick(IDENTIFIED[k]).map(|e| of_truth(k, e)))
    };
    let answer = joint_fit(&prior, supply, &recorded).ok();
    Trial {
        first: table(&|p| classic.first(p)),
        least_squares: table(&|p| classic.least_squares.and_then(|s| s.of(p))),
        instrumental: table(&|p| classic.instrumental.and_then(|s| s.of(p))),
        table: table(&|p| classic.table(p)),
        joint: std::array::from_fn(|k| answer.as_ref().map(|a| (a.numbers[k].factor, a.numbers[k].std))),
        follows: answer.is_some_and(|a| a.follows),
    }
}
