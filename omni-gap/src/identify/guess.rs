//! Where a fit begins with friction that a robot file states as zero: factors cannot move a number from zero. Each
//! number's card says where.

use model_core::effects::nominal;
use schemars::JsonSchema;
use serde::Serialize;

use crate::log::RobotFile;

/// A number that began at a guess.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct Guessed {
    /// Its key in the robot file, which ends with its unit.
    pub key: &'static str,
    /// The guess, in the key's unit.
    pub value: f64,
}

/// The robot file with a guess for each friction that is zero, and which these are.
pub(super) fn guessed(file: &RobotFile) -> (RobotFile, Vec<Guessed>) {
    let mut file = file.clone();
    let (mass, distance) = (file.body.mass_kg, file.wheel[0].distance_m);
    let mut all = Vec::new();
    for number in nominal::numbers() {
        let (Some(guess), Some(place)) = (number.first_guess, file.nominal_mut(number.key, 0)) else { continue };
        if *place == 0.0 {
            let value = guess(mass, distance);
            *place = value;
            all.push(Guessed { key: number.key, value });
        }
    }
    (file, all)
}
