//! What the joint fit answers, held against the truth.

use omni_gap::identify::{IDENTIFIED, Refused, TradeOff, Word, joint};
use omni_gap::simulate::{Experiment, Model, Recorded};

use super::believed::{Believed, NUMBERS};

/// The answer about one number.
#[derive(Clone, Copy, Debug)]
pub struct Told {
    /// What the runs say of it.
    pub word: Word,
    /// Found over true.
    pub factor: f64,
    /// One sigma of it.
    pub std: f64,
}

impl Told {
    /// How far off it is [σ of its own]
    pub fn off(&self) -> f64 {
        (self.factor - 1.0).abs() / self.std
    }
}

/// The answer about all.
#[derive(Clone, Debug)]
pub struct Answer {
    /// The numbers, in the order of [`IDENTIFIED`].
    pub numbers: [Told; NUMBERS],
    /// Numbers that could move together.
    pub trade_offs: Vec<TradeOff>,
    /// True if the fit predicts whole runs to within noise.
    pub follows: bool,
}

impl Answer {
    /// Those that are called identified.
    pub fn identified(&self) -> impl Iterator<Item = &Told> {
        self.numbers.iter().filter(|told| told.word == Word::Identified)
    }
}

/// Fits all runs but those of the motor experiment, in which the robot drags a load that nobody weighed.
///
/// # Errors
/// Where the runs tell nothing.
pub fn asked<const N: usize>(believed: &Believed, supply: f64, recorded: &[Recorded<N>]) -> Result<Answer, Refused> {
    let model = Model::<N>::nominal(&believed.file, supply);
    let found = joint(&model, &believed.file, &freely_driven(recorded))?;
    let numbers = std::array::from_fn(|k| {
        let number = found.of(IDENTIFIED[k]).expect("the fit answers about every number");
        Told { word: number.word, factor: number.factor * believed.off[k], std: number.std * believed.off[k] }
    });
    Ok(Answer { numbers, trade_offs: found.trade_offs, follows: found.follows })
}

/// The runs without those of the motor experiment.
pub fn freely_driven<const N: usize>(recorded: &[Recorded<N>]) -> Vec<&Recorded<N>> {
    recorded.iter().filter(|run| Experiment::of(&run.name) != Some(Experiment::Motor)).collect()
}
