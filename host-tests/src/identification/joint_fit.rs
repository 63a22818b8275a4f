//! What the joint fit answers, held against the truth.

use omni_gap::identify::{IDENTIFIED, Identifiability, Refused, TradeOff, joint};
use omni_gap::simulate::{AlignedRun, Experiment, Model};

use super::prior::{NUMBERS, PriorRobot};

/// The answer about one number.
#[derive(Clone, Copy, Debug)]
pub struct FittedNumber {
    /// What the runs say of it.
    pub word: Identifiability,
    /// Found over true.
    pub factor: f64,
    /// One sigma of it.
    pub std: f64,
}

impl FittedNumber {
    /// How far off it is [σ of its own]
    pub fn off(&self) -> f64 {
        (self.factor - 1.0).abs() / self.std
    }
}

/// The answer about all.
#[derive(Clone, Debug)]
pub struct JointAnswer {
    /// The numbers, in the order of [`IDENTIFIED`].
    pub numbers: [FittedNumber; NUMBERS],
    /// Numbers that could move together.
    pub trade_offs: Vec<TradeOff>,
    /// True if the fit predicts whole runs to within noise.
    pub follows: bool,
}

impl JointAnswer {
    /// Those that are called identified.
    pub fn identified(&self) -> impl Iterator<Item = &FittedNumber> {
        self.numbers.iter().filter(|number| number.word == Identifiability::Identified)
    }
}

/// Fits all runs but those of the motor experiment, in which the robot drags a load that nobody weighed.
///
/// # Errors
/// Where the runs tell nothing.
pub fn joint_fit<const N: usize>(
    prior: &PriorRobot,
    supply: f64,
    recorded: &[AlignedRun<N>],
) -> Result<JointAnswer, Refused> {
    let model = Model::<N>::nominal(&prior.file, supply);
    let found = joint(&model, &prior.file, &freely_driven(recorded))?;
    let numbers = std::array::from_fn(|k| {
        let number = found.of(IDENTIFIED[k]).expect("the fit answers about every number");
        FittedNumber { word: number.word, factor: number.factor * prior.off[k], std: number.std * prior.off[k] }
    });
    Ok(JointAnswer { numbers, trade_offs: found.trade_offs, follows: found.follows })
}

/// The runs without those of the motor experiment.
pub fn freely_driven<const N: usize>(recorded: &[AlignedRun<N>]) -> Vec<&AlignedRun<N>> {
    recorded.iter().filter(|run| Experiment::of(&run.name) != Some(Experiment::Motor)).collect()
}
