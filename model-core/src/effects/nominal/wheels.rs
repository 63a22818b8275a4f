//! The wheels: r and d, common to all of them. What sets one wheel apart is an effect.

use super::card::{NominalCard, Number, Table};
use crate::effects::card::Stage;
use crate::plant::robot::Nominal;

/// r.
pub const RADIUS: NominalCard = NominalCard {
    id: "wheel_radius",
    title: "Wheel radius",
    summary: "The radius at which the wheels roll, common to all of them: loaded, and at the middle of the rollers.",
    measured_by: "Drive a straight line along a tape measure and count turns of the wheels.",
    settled_by: "drive a straight line along a tape measure and count turns on the spot",
    stage: Stage::Contact,
    numbers: &[Number {
        key: "radius_m",
        symbol: "r",
        unit: "m",
        table: Table::Wheel,
        line: 1,
        factors: &[Nominal::WheelRadius],
        axis: None,
        relative_uncertainty: 0.01,
        within: (0.002, 0.5),
        first_guess: None,
    }],
};

/// d.
pub const CENTER_DISTANCE: NominalCard = NominalCard {
    id: "center_distance",
    title: "Distance of the wheels from the centre",
    summary: "The lever of every wheel about the robot's centre, common to all of them.",
    measured_by: "Turn on the spot ten times and count turns of the wheels.",
    settled_by: "drive a straight line along a tape measure and count turns on the spot",
    stage: Stage::Contact,
    numbers: &[Number {
        key: "distance_m",
        symbol: "d",
        unit: "m",
        table: Table::Wheel,
        line: 0,
        factors: &[Nominal::CenterDistance],
        axis: None,
        relative_uncertainty: 0.01,
        within: (0.005, 2.0),
        first_guess: None,
    }],
};
