//! The body: M and J.

use super::card::{NominalCard, Number, Table};
use crate::effects::card::Stage;
use crate::plant::robot::Nominal;

/// M.
pub const MASS: NominalCard = NominalCard {
    id: "mass",
    title: "Mass",
    summary: "The mass of the robot with everything it carries. It is seen only against a known torque: with K_t wrong by the same share, the motion is the same.",
    measured_by: "Weigh the robot, battery included.",
    settled_by: "add a known mass and repeat the runs",
    stage: Stage::Body,
    numbers: &[Number {
        key: "mass_kg",
        symbol: "M",
        unit: "kg",
        table: Table::Body,
        line: 0,
        factors: &[Nominal::Mass],
        axis: None,
        relative_uncertainty: 0.01,
        within: (0.05, 500.0),
        first_guess: None,
    }],
};

/// J.
pub const INERTIA: NominalCard = NominalCard {
    id: "inertia",
    title: "Inertia about the vertical axis",
    summary: "How hard the robot is to spin up. The rotors of the motors add to it as the square of the gear ratio.",
    measured_by: "Hang the robot on three strings and time its turning oscillation.",
    settled_by: "add a known mass and repeat the runs",
    stage: Stage::Body,
    numbers: &[Number {
        key: "inertia_kg_m2",
        symbol: "J",
        unit: "kg·m²",
        table: Table::Body,
        line: 1,
        factors: &[Nominal::Inertia],
        axis: None,
        relative_uncertainty: 0.10,
        within: (1e-6, 500.0),
        first_guess: None,
    }],
};
