//! The card of a nominal parameter, and the numbers of the robot file that say it.

use crate::effects::card::Stage;
use crate::plant::robot::Nominal;

/// A nominal parameter's page as data.
#[derive(Clone, Copy, Debug)]
pub struct NominalCard {
    /// The cause that a report names.
    pub id: &'static str,
    /// Its name for people.
    pub title: &'static str,
    /// What it is.
    pub summary: &'static str,
    /// How to measure it without a diagnosis.
    pub measured_by: &'static str,
    /// What settles, in a few words, whether it or another cause is to blame.
    pub settled_by: &'static str,
    /// The stage where a report places it.
    pub stage: Stage,
    /// The numbers of the robot file that say it.
    pub numbers: &'static [Number],
}

/// The table of a robot file that holds a number, in the order of the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Table {
    /// `[[wheel]]`, one for each
    Wheel,
    /// `[motor]`
    Motor,
    /// `[body]`
    Body,
    /// `[friction]`
    Friction,
}

impl Table {
    /// Its name in the file.
    pub const fn name(self) -> &'static str {
        match self {
            Table::Wheel => "wheel",
            Table::Motor => "motor",
            Table::Body => "body",
            Table::Friction => "friction",
        }
    }
}

/// A nominal number of a robot file.
#[derive(Clone, Copy, Debug)]
pub struct Number {
    /// Its key, with the unit as suffix.
    pub key: &'static str,
    /// Its symbol in the equations.
    pub symbol: &'static str,
    /// Its SI unit.
    pub unit: &'static str,
    /// The table that holds it.
    pub table: Table,
    /// Its place among the nominal numbers of that table.
    pub line: u8,
    /// The factors of a re-fit that multiply it; the last one is its own.
    pub factors: &'static [Nominal],
    /// The body axis (v, vn, ω: 0, 1, 2) that it belongs to, of a friction.
    pub axis: Option<usize>,
    /// One-sigma relative uncertainty where the file states none [1]
    pub relative_uncertainty: f64,
    /// The least and the most that a robot accepts of it.
    pub within: (f64, f64),
    /// Where a fit begins if the file says zero, from mass [kg] and wheel distance [m]: a factor cannot move a zero.
    pub first_guess: Option<fn(mass: f64, distance: f64) -> f64>,
}

impl Number {
    /// The factor that is its own.
    pub const fn own(&self) -> Nominal {
        self.factors[self.factors.len() - 1]
    }

    /// Its place in the robot file, as a number that can be compared.
    pub(super) const fn place(&self) -> u16 {
        (self.table as u16) << 8 | self.line as u16
    }
}
