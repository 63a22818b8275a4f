//! Friction of the body, axis by axis: B and C of equations 10 to 12.
//!
//! ```text
//! B = 0.2 s⁻¹·M,   C = 0.05·M·g;   about ω times d², and times d        where a fit begins
//! ```

use super::card::{NominalCard, Number, Table};
use crate::effects::card::Stage;
use crate::effects::seams::STANDARD_GRAVITY;
use crate::plant::robot::Nominal;

/// Viscous friction over mass, where a fit begins [1/s]
const VISCOUS_RATE: f64 = 0.2;
/// Coulomb friction over weight, where a fit begins [1]
const COULOMB_SHARE: f64 = 0.05;

/// (B_v, B_vn, B_ω).
pub const VISCOUS: NominalCard = NominalCard {
    id: "viscous_friction",
    title: "Viscous friction of the body",
    summary: "Friction that grows with speed, along the forward, the sideways and the turning axis.",
    measured_by: "Let the robot coast with the bridges open from several speeds.",
    settled_by: "let the robot coast with the bridges open",
    stage: Stage::Body,
    numbers: &[
        Number {
            key: "viscous_v_N_s_per_m",
            symbol: "B_v",
            unit: "N·s/m",
            table: Table::Friction,
            line: 0,
            factors: &[Nominal::ViscousV],
            axis: Some(0),
            relative_uncertainty: 0.20,
            within: (0.0, 1000.0),
            first_guess: Some(|mass, _| VISCOUS_RATE * mass),
        },
        Number {
            key: "viscous_vn_N_s_per_m",
            symbol: "B_vn",
            unit: "N·s/m",
            table: Table::Friction,
            line: 1,
            factors: &[Nominal::ViscousVn],
            axis: Some(1),
            relative_uncertainty: 0.20,
            within: (0.0, 1000.0),
            first_guess: Some(|mass, _| VISCOUS_RATE * mass),
        },
        Number {
            key: "viscous_w_Nm_s",
            symbol: "B_ω",
            unit: "N·m·s",
            table: Table::Friction,
            line: 2,
            factors: &[Nominal::ViscousW],
            axis: Some(2),
            relative_uncertainty: 0.20,
            within: (0.0, 1000.0),
            first_guess: Some(|mass, distance| VISCOUS_RATE * mass * distance * distance),
        },
    ],
};

/// (C_v, C_vn, C_ω).
pub const COULOMB: NominalCard = NominalCard {
    id: "coulomb_friction",
    title: "Coulomb friction of the body",
    summary: "Friction that does not depend on speed, along the forward, the sideways and the turning axis.",
    measured_by: "Drag the robot slowly with a spring scale, motors off; with a lever, turn it.",
    settled_by: "let the robot coast with the bridges open",
    stage: Stage::Body,
    numbers: &[
        Number {
            key: "coulomb_v_N",
            symbol: "C_v",
            unit: "N",
            table: Table::Friction,
            line: 3,
            factors: &[Nominal::CoulombV],
            axis: Some(0),
            relative_uncertainty: 0.20,
            within: (0.0, 1000.0),
            first_guess: Some(|mass, _| COULOMB_SHARE * mass * STANDARD_GRAVITY),
        },
        Number {
            key: "coulomb_vn_N",
            symbol: "C_vn",
            unit: "N",
            table: Table::Friction,
            line: 4,
            factors: &[Nominal::CoulombVn],
            axis: Some(1),
            relative_uncertainty: 0.20,
            within: (0.0, 1000.0),
            first_guess: Some(|mass, _| COULOMB_SHARE * mass * STANDARD_GRAVITY),
        },
        Number {
            key: "coulomb_w_Nm",
            symbol: "C_ω",
            unit: "N·m",
            table: Table::Friction,
            line: 5,
            factors: &[Nominal::CoulombW],
            axis: Some(2),
            relative_uncertainty: 0.20,
            within: (0.0, 1000.0),
            first_guess: Some(|mass, distance| COULOMB_SHARE * mass * STANDARD_GRAVITY * distance),
        },
    ],
};
