//! Many mornings of experiments with a robot whose truth is known.
//!
//! Each seed draws the robot file (resistance, K_t = K_v, inertia and friction wrong by what is stated of them; mass and
//! geometry right) and the noise, plays all experiments, and asks the paper's estimators and the joint one.

use std::path::Path;

use model_core::robot::Nominal;
use omni_gap::identify::experiments::{Estimate, classic};
use omni_gap::identify::{IDENTIFIED, Shots, Windows, joint, linearise};
use omni_gap::log::RobotFile;
use omni_gap::simulate::{Experiment, Model, NOMINAL_KEYS, NominalKey, Plan, Recorded, Recording, Sensing, Slot};
use omni_gap::{known_effects, rehearse};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;

use crate::catalogue::sessions::truth;

/// How many numbers are identified.
pub const NUMBERS: usize = IDENTIFIED.len();

/// What is measured with, and what on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// Wheels of the robot.
    pub wheels: usize,
    /// How it is measured.
    pub sensing: Sensing,
    /// Time over which the camera's errors stay alike [s]
    pub camera_correlation: f64,
    /// Mornings.
    pub seeds: u64,
}

impl Case {
    /// What is played: largest voltage 8 V of a supply of 12 V, on a free floor of 3 m.
    pub fn plan(&self) -> Plan {
        let repeats = if self.sensing == Sensing::Paper { 3 } else { 1 };
        Plan { rate: self.sensing.rate(), voltage: 8.0, field: 3.0, repeats, loads: 4 }
    }

    /// How it is recorded.
    pub fn recording(&self) -> Recording {
        Recording { camera_correlation: self.camera_correlation, ..self.sensing.recording() }
    }
}

/// An estimate of each number as a factor of the truth, with its one-sigma uncertainty; `None` where there is none.
pub type Estimates = [Option<(f64, f64)>; NUMBERS];

/// What one morning gave.
#[derive(Clone, Debug)]
pub struct Morning {
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

/// All mornings of a case.
#[derive(Clone, Debug)]
pub struct Studied {
    /// The case.
    pub case: Case,
    /// The mornings.
    pub mornings: Vec<Morning>,
    /// The Cramér–Rao bound of each number, relative.
    pub bound: [f64; NUMBERS],
    /// Runs of a morning, how long they are together [s], and their rows.
    pub size: (usize, f64, usize),
}

/// Plays the mornings of a case.
pub fn studied(case: Case) -> Studied {
    match case.wheels {
        3 => of_wheels::<3>(case),
        _ => of_wheels::<4>(case),
    }
}

fn of_wheels<const N: usize>(case: Case) -> Studied {
    let mut file = RobotFile::parse(truth(N), Path::new("robot.toml"), &known_effects()).expect("the example is sound");
    file.sensors = case.recording().sensors;
    let played = rehearse::rehearse(&file, &case.plan(), &case.recording(), 0);
    let size = (played.len(), played.iter().map(|r| r.duration_s()).sum(), played.iter().map(|r| r.rows()).sum());
    let recorded: Vec<Recorded<N>> = played.iter().filter_map(|run| Recorded::new(run, &file)).collect();
    let bound = bound(&Model::nominal(&file, case.plan().voltage), &recorded);
    let mornings = (1..=case.seeds).into_par_iter().map(|seed| morning::<N>(&file, case, seed)).collect();
    Studied { case, mornings, bound, size }
}

/// The least standard deviation that any unbiased estimator can have of each number, relative: the inverse of Fisher's
/// information at the truth, for white noise of the stated sizes, each run's start unknown.
pub fn bound<const N: usize>(truth: &Model<N>, runs: &[Recorded<N>]) -> [f64; NUMBERS] {
    let runs: Vec<&Recorded<N>> = runs.iter().filter(|r| Experiment::of(&r.name) != Some(Experiment::Motor)).collect();
    let windows: Vec<Windows> = runs.iter().map(|run| Windows::whole(run)).collect();
    let at_rest = vec![vec![[0.0; 6]]; runs.len()];
    let slots = IDENTIFIED.map(Slot::Nominal);
    let shots = Shots { runs: &runs, windows: &windows };
    let information = linearise(truth, shots, &at_rest, &slots, false).reduced().hess;
    let covariance = information.try_inverse().expect("the experiments tell all numbers");
    std::array::from_fn(|k| covariance[(k, k)].sqrt())
}

fn morning<const N: usize>(truth: &RobotFile, case: Case, seed: u64) -> Morning {
    let (file, off) = wrong(truth, seed);
    let runs = rehearse::rehearse(truth, &case.plan(), &case.recording(), seed);
    let recorded: Vec<Recorded<N>> = runs.iter().filter_map(|run| Recorded::new(run, &file)).collect();
    let model = Model::<N>::nominal(&file, case.plan().voltage);
    // the paper's regressions take K_t from the motor experiment
    let classic = classic(&model, &recorded);
    let of_truth = |k: usize, e: Estimate| {
        let true_value = nominal_value(truth, IDENTIFIED[k]);
        (e.value / true_value, e.std / true_value)
    };
    let table = |pick: &dyn Fn(Nominal) -> Option<Estimate>| -> Estimates {
        std::array::from_fn(|k| pick(IDENTIFIED[k]).map(|e| of_truth(k, e)))
    };
    let fitted: Vec<&Recorded<N>> =
        recorded.iter().filter(|r| Experiment::of(&r.name) != Some(Experiment::Motor)).collect();
    let joint = joint(&model, &file, &fitted);
    let (joined, follows) = match &joint {
        Ok(found) => {
            let number = |k: usize| found.of(IDENTIFIED[k]).map(|n| (n.factor * off[k], n.std * off[k]));
            (std::array::from_fn(number), found.follows)
        }
        Err(_) => ([None; NUMBERS], false),
    };
    Morning {
        first: table(&|p| classic.first(p)),
        least_squares: table(&|p| classic.least_squares.and_then(|s| s.of(p))),
        instrumental: table(&|p| classic.instrumental.and_then(|s| s.of(p))),
        table: table(&|p| classic.table(p)),
        joint: joined,
        follows,
    }
}

/// A robot file that is wrong in what is identified, by what is stated of it; and its numbers over the truth.
fn wrong(truth: &RobotFile, seed: u64) -> (RobotFile, [f64; NUMBERS]) {
    let mut random = ChaCha8Rng::seed_from_u64(seed ^ 0x1de_a11);
    let mut file = truth.clone();
    let off = IDENTIFIED.map(|p| {
        let key = key_of(p);
        let draw: f64 = StandardNormal.sample(&mut random);
        (draw * truth.relative_uncertainty(key.key).unwrap_or(0.0)).exp()
    });
    let [r, k, j, bv, bvn, bw, cv, cvn, cw] = off;
    file.motor.resistance_ohm *= r;
    file.motor.emf_constant_v_s *= k;
    file.motor.torque_constant_nm_per_a *= k;
    file.body.inertia_kg_m2 *= j;
    file.friction.viscous_v_n_s_per_m *= bv;
    file.friction.viscous_vn_n_s_per_m *= bvn;
    file.friction.viscous_w_nm_s *= bw;
    file.friction.coulomb_v_n *= cv;
    file.friction.coulomb_vn_n *= cvn;
    file.friction.coulomb_w_nm *= cw;
    (file, off)
}

/// A number of a robot file.
fn nominal_value(file: &RobotFile, p: Nominal) -> f64 {
    key_of(p).value(file)
}

fn key_of(p: Nominal) -> &'static NominalKey {
    NOMINAL_KEYS.iter().find(|key| key.factors == [p]).expect("every number has a key")
}
