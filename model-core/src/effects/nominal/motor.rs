//! The motor: R, K_v and K_t.

use super::card::{NominalCard, Number, Table};
use crate::effects::card::Stage;
use crate::plant::robot::Nominal;

/// R.
pub const RESISTANCE: NominalCard = NominalCard {
    id: "resistance",
    title: "Winding resistance",
    summary: "Volts per ampere of a motor at standstill, with cables and switches. It rises by 0.4 % for every kelvin.",
    measured_by: "Lock a wheel, apply a small voltage, and divide it by the current.",
    settled_by: "measure the winding with a multimeter",
    stage: Stage::Electrical,
    numbers: &[Number {
        key: "resistance_ohm",
        symbol: "R",
        unit: "Ω",
        table: Table::Motor,
        line: 0,
        factors: &[Nominal::Resistance],
        axis: None,
        relative_uncertainty: 0.10,
        within: (1e-3, 1000.0),
        first_guess: None,
    }],
};

/// K_v and K_t, wrong by the same factor; its own number is K_v.
pub const TORQUE_CONSTANT: NominalCard = NominalCard {
    id: "torque_constant",
    title: "Torque and back-EMF constant",
    summary: "Torque per ampere and volts per speed of a motor, both wrong by the same factor, as weak magnets make them.",
    measured_by: "Turn the motor at a known speed with open terminals and read its voltage.",
    settled_by: "pull the robot with a spring scale at a known current",
    stage: Stage::Electrical,
    numbers: &[Number {
        key: "emf_constant_V_s",
        symbol: "K_v",
        unit: "V·s",
        table: Table::Motor,
        line: 1,
        factors: &[Nominal::TorqueConstant],
        axis: None,
        relative_uncertainty: 0.03,
        within: (1e-5, 10.0),
        first_guess: None,
    }],
};

/// K_t alone.
pub const KT_OVER_KV: NominalCard = NominalCard {
    id: "kt_over_kv",
    title: "Torque constant over back-EMF constant",
    summary: "The torque constant alone, the back-EMF constant being right. In SI units the two are equal for an ideal motor; losses in iron and gear, or a conversion between phase and line values, set them apart.",
    measured_by: "Pull the robot with a spring scale at a known current, and compare with the back-EMF of a free motor.",
    settled_by: "pull the robot with a spring scale at a known current",
    stage: Stage::Electrical,
    numbers: &[Number {
        key: "torque_constant_Nm_per_A",
        symbol: "K_t",
        unit: "N·m/A",
        table: Table::Motor,
        line: 2,
        factors: &[Nominal::TorqueConstant, Nominal::KtOverKv],
        axis: None,
        relative_uncertainty: 0.03,
        within: (1e-5, 10.0),
        first_guess: None,
    }],
};
