//! Where a fit begins with friction that a robot file states as zero: factors cannot move a number from zero.
//!
//! ```text
//! B = 0.2 s⁻¹·M,   C = 0.05·M·g;   about ω times d², and times d
//! ```

use serde::Serialize;

use crate::log::RobotFile;
use crate::simulate::NominalKey;

/// Viscous friction over mass [1/s]
const VISCOUS: f64 = 0.2;
/// Coulomb friction over weight [1]
const COULOMB: f64 = 0.05;
/// Gravity [m/s²]
const G: f64 = 9.81;

/// A number that began at a guess.
#[derive(Clone, Debug, PartialEq, Serialize)]
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
    let (viscous, coulomb) = (VISCOUS * mass, COULOMB * mass * G);
    let friction = &mut file.friction;
    let mut all = Vec::new();
    for (key, number, guess) in [
        ("viscous_v_N_s_per_m", &mut friction.viscous_v_n_s_per_m, viscous),
        ("viscous_vn_N_s_per_m", &mut friction.viscous_vn_n_s_per_m, viscous),
        ("viscous_w_Nm_s", &mut friction.viscous_w_nm_s, viscous * distance * distance),
        ("coulomb_v_N", &mut friction.coulomb_v_n, coulomb),
        ("coulomb_vn_N", &mut friction.coulomb_vn_n, coulomb),
        ("coulomb_w_Nm", &mut friction.coulomb_w_nm, coulomb * distance),
    ] {
        if *number == 0.0 {
            *number = guess;
            all.push(Guessed { key, value: guess });
        }
    }
    debug_assert!(all.iter().all(|g| NominalKey::of(g.key).is_some()), "a guess is one of the file's numbers");
    (file, all)
}
