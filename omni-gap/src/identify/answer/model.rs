//! The answer itself: numbers in the unit that their key ends with.

use schemars::JsonSchema;
use serde::Serialize;

use super::super::guess::Guessed;
use super::super::identifiability::Identifiability;
use crate::simulate::Experiment;

/// Version of the form of an answer in a file.
pub const SCHEMA: u32 = 1;

/// Which experiments are asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asked {
    /// One of them alone.
    One(Experiment),
    /// All of them.
    All,
}

/// A number and its one-sigma uncertainty, in the unit of the number's key.
#[derive(Clone, Copy, Debug, PartialEq, JsonSchema, Serialize)]
pub struct Value {
    /// The number.
    pub value: f64,
    /// One sigma; `None` where a single run cannot tell it, or where nothing is known.
    pub std: Option<f64>,
}

/// What was found of one number; all values are in the unit that the key ends with.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct Number {
    /// Its key in the robot file.
    pub key: &'static str,
    /// The number of the robot file.
    pub file: f64,
    /// The paper's experiments 1 and 2 and the motor's (its Table 1).
    pub first: Option<Value>,
    /// Experiment 3 by least squares.
    pub least_squares: Option<Value>,
    /// Experiment 3 by instrumental variables.
    pub instrumental: Option<Value>,
    /// The paper's final number, an average (its Table 3); only where all experiments are asked.
    pub average: Option<Value>,
    /// Of the runs together.
    pub together: Value,
    /// One sigma more, from what is stated of mass and geometry.
    pub std_given: f64,
    /// What the runs say of it.
    pub word: Identifiability,
}

/// Numbers that could move together without being noticed.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct Together {
    /// The numbers, the one that moves most first.
    pub moves: Vec<Moved>,
    /// Relative uncertainty of the first along this direction, one sigma [1]
    pub std_relative: f64,
    /// The product of powers that is known all the same.
    pub known: Option<Product>,
}

/// How a number moves.
#[derive(Clone, Copy, Debug, PartialEq, JsonSchema, Serialize)]
pub struct Moved {
    /// Its key.
    pub key: &'static str,
    /// By how much it moves when the first moves by one, both relative [1]
    pub relative: f64,
}

/// A product of powers of two numbers.
#[derive(Clone, Copy, Debug, PartialEq, JsonSchema, Serialize)]
pub struct Product {
    /// The two.
    pub powers: [Power; 2],
    /// Relative uncertainty of the product, one sigma [1]
    pub std_relative: f64,
}

/// A power of a number.
#[derive(Clone, Copy, Debug, PartialEq, JsonSchema, Serialize)]
pub struct Power {
    /// The number's key.
    pub key: &'static str,
    /// The power.
    pub power: f64,
}

/// The runs of an experiment.
#[derive(Clone, Copy, Debug, PartialEq, JsonSchema, Serialize)]
pub struct Counted {
    /// Its title.
    pub experiment: &'static str,
    /// How many there are.
    pub runs: usize,
}

/// The noise of a sensor, as the recordings show it.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct SensorNoise {
    /// Its key in `[sensors]`, which ends with the unit.
    pub key: &'static str,
    /// One sigma, in the key's unit.
    pub found: f64,
    /// What the robot file states, in the key's unit.
    pub stated: f64,
    /// How long it remembers itself [s]; zero: not at all
    pub correlation_time_s: f64,
}

/// What one experiment says of a number that another says otherwise.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct Side {
    /// Which experiment.
    pub by: &'static str,
    /// The number and its uncertainty, in the unit of its key.
    #[serde(flatten)]
    pub value: Value,
}

/// Two experiments that disagree.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct Apart {
    /// About which number.
    pub key: &'static str,
    /// What each says.
    pub sides: [Side; 2],
    /// How far they are apart, in sigmas of their difference.
    pub sigmas: f64,
}

/// Runs that the fit of all runs together leaves out.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct LeftOut {
    /// Their names.
    pub runs: Vec<String>,
    /// Why.
    pub why: &'static str,
}

/// All that experiments tell.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct Answer {
    /// Version of this form.
    pub schema: u32,
    /// The robot's name.
    pub robot: String,
    /// Which experiments were asked: by the word of one, or `all`.
    pub asked: &'static str,
    /// How many runs there are of each experiment asked.
    pub runs: Vec<Counted>,
    /// Runs that were fitted together.
    pub fitted_runs: usize,
    /// Runs that were left out of that.
    pub left_out: Vec<LeftOut>,
    /// Signals that no run has.
    pub not_logged: Vec<&'static str>,
    /// Friction that the file states as zero.
    pub guessed: Vec<Guessed>,
    /// What was found of each number.
    pub numbers: Vec<Number>,
    /// What is known only together.
    pub trade_offs: Vec<Together>,
    /// Noise of each sensor that there is.
    pub noise: Vec<SensorNoise>,
    /// True if whole runs are predicted to within that noise.
    pub follows: bool,
    /// RMS error of whole runs over that noise [1]
    pub misfit: f64,
    /// Measured numbers that were compared.
    pub samples: usize,
    /// Experiments that disagree.
    pub disagreements: Vec<Apart>,
}

impl Asked {
    /// Its name on the command line.
    pub const fn word(self) -> &'static str {
        match self {
            Self::One(experiment) => experiment.word(),
            Self::All => "all",
        }
    }

    /// Whether a run of this name is asked.
    pub fn takes(self, name: &str) -> bool {
        match (self, Experiment::of(name)) {
            (Self::One(wanted), of) => of == Some(wanted),
            (Self::All, of) => of.is_some(),
        }
    }
}
