//! Where two experiments say different things of one number.
//!
//! Each experiment asks the model something else: a spin for the steady state, a coast-down for friction alone, a step
//! for everything that moves. A model that is right gives them all the same numbers. Where two disagree by more than
//! their noise, the model lacks something that weighs differently in the one than in the other.
//!
//! The paper's own robot is the example: its steady motors say R = 3.70 Ω, its driven steps 4.31 Ω, and the inertia of
//! four wheels is 0.016 kg·m² by coasting and 0.0288 by steps. One number cannot be both.

use model_core::plant::robot::Nominal;

use super::experiments::classic;
use super::identifiability::Identifiability;
use super::joint::{IDENTIFIED, joint};
use crate::log::RobotFile;
use crate::simulate::{AlignedRun, Experiment, Model};

/// Two statements further apart than this disagree [σ]
const APART: f64 = 4.0;
/// Two statements closer than this are of one opinion, however sure each is: a relative difference.
const ALIKE: f64 = 0.01;

/// What one experiment says of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IndependentEstimate {
    /// Which experiment.
    pub by: &'static str,
    /// Factor on the robot file's value.
    pub factor: f64,
    /// One sigma of it.
    pub std: f64,
}

/// Two experiments that disagree about a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disagreement {
    /// The number.
    pub nominal: Nominal,
    /// What the one says.
    pub one: IndependentEstimate,
    /// What the other says.
    pub other: IndependentEstimate,
    /// How far they are apart, in sigmas of their difference.
    pub sigmas: f64,
}

/// All pairs of experiments that disagree about a number, the worst of each number alone, worst first.
pub fn disagreements<const N: usize>(model: &Model<N>, file: &RobotFile, runs: &[&AlignedRun<N>]) -> Vec<Disagreement> {
    let mut told: Vec<Vec<IndependentEstimate>> = vec![Vec::new(); IDENTIFIED.len()];
    for experiment in [Experiment::Spin, Experiment::Coast, Experiment::Step] {
        let own: Vec<&AlignedRun<N>> =
            runs.iter().copied().filter(|run| Experiment::of(&run.name) == Some(experiment)).collect();
        let Ok(found) = joint(model, file, &own) else { continue };
        for (told, n) in told.iter_mut().zip(&found.numbers).filter(|(_, n)| n.word == Identifiability::Identified) {
            told.push(IndependentEstimate { by: experiment.title(), factor: n.factor, std: n.std });
        }
    }
    let motors: Vec<AlignedRun<N>> = runs
        .iter()
        .filter(|run| Experiment::of(&run.name) == Some(Experiment::Motor))
        .map(|run| (*run).clone())
        .collect();
    if let Some(motor) = classic(model, &motors).motor {
        let nominal = model.robot().motor;
        let of = [(Nominal::Resistance, nominal.resistance), (Nominal::TorqueConstant, nominal.emf_constant)];
        for ((p, known), e) in of.into_iter().zip(motor) {
            let at = IDENTIFIED.iter().position(|q| *q == p).expect("both are identified");
            told[at].push(IndependentEstimate {
                by: Experiment::Motor.title(),
                factor: e.value / known,
                std: e.std / known,
            });
        }
    }
    let worst = |(k, told): (usize, &Vec<IndependentEstimate>)| worst_pair(IDENTIFIED[k], told);
    let mut all: Vec<Disagreement> = told.iter().enumerate().filter_map(worst).collect();
    all.sort_by(|a, b| b.sigmas.total_cmp(&a.sigmas));
    all
}

fn worst_pair(nominal: Nominal, told: &[IndependentEstimate]) -> Option<Disagreement> {
    let pairs = told.iter().enumerate().flat_map(|(k, one)| told[k + 1..].iter().map(move |other| (one, other)));
    let apart = |(one, other): (&IndependentEstimate, &IndependentEstimate)| Disagreement {
        nominal,
        one: *one,
        other: *other,
        sigmas: (one.factor - other.factor).abs() / one.std.hypot(other.std),
    };
    let alike = |d: &Disagreement| (d.one.factor - d.other.factor).abs() < ALIKE * d.one.factor.abs();
    pairs.map(apart).filter(|d| d.sigmas > APART && !alike(d)).max_by(|a, b| a.sigmas.total_cmp(&b.sigmas))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn estimate(by: &'static str, factor: f64, std: f64) -> IndependentEstimate {
        IndependentEstimate { by, factor, std }
    }

    #[test]
    fn the_papers_own_resistance_is_a_disagreement() {
        // 3.7007 Ω by the motor, 4.3111 Ω by the steps, each good to 2 %
        let both = [estimate("motor", 3.7007 / 4.3111, 0.02), estimate("step", 1.0, 0.02)];
        let found = worst_pair(Nominal::Resistance, &both).unwrap();
        assert!((found.sigmas - (1.0 - 3.7007 / 4.3111) / (0.02 * 2f64.sqrt())).abs() < 1e-12);
    }

    #[test]
    fn what_noise_can_make_is_none_and_neither_is_what_does_not_matter() {
        assert_eq!(worst_pair(Nominal::Mass, &[estimate("a", 1.0, 0.1), estimate("b", 1.3, 0.1)]), None);
        assert_eq!(worst_pair(Nominal::Mass, &[estimate("a", 1.0, 1e-6), estimate("b", 1.005, 1e-6)]), None);
        assert_eq!(worst_pair(Nominal::Mass, &[estimate("a", 1.0, 1e-6)]), None);
    }
}
