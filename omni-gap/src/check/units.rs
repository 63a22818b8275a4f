//! Factors that a wrong unit makes.

use std::f64::consts::PI;

/// Wrong units: what the log was written in, and how many of it make one contract unit.
#[derive(Debug, Clone, Copy)]
pub(super) struct WrongUnit {
    pub name: &'static str,
    pub per_unit: f64,
}

pub(super) const VOLTS: [WrongUnit; 1] = [WrongUnit { name: "millivolts", per_unit: 1000.0 }];
pub(super) const AMPERES: [WrongUnit; 1] = [WrongUnit { name: "milliamperes", per_unit: 1000.0 }];
pub(super) const SPEEDS: [WrongUnit; 2] =
    [WrongUnit { name: "rpm", per_unit: 30.0 / PI }, WrongUnit { name: "degrees per second", per_unit: 180.0 / PI }];
pub(super) const LENGTHS: [WrongUnit; 2] =
    [WrongUnit { name: "millimetres", per_unit: 1000.0 }, WrongUnit { name: "centimetres", per_unit: 100.0 }];
pub(super) const ANGLES: [WrongUnit; 1] = [WrongUnit { name: "degrees", per_unit: 180.0 / PI }];

/// The unit that explains why the log's numbers are `ratio` times what they should be.
///
/// Parameters may be wrong by 30 % and effects add to it: within a factor of 1.6 either way.
pub(super) fn explains(units: &[WrongUnit], ratio: f64) -> Option<WrongUnit> {
    units.iter().copied().find(|unit| (ratio / unit.per_unit).ln().abs() < 0.47)
}
