//! What is learned with: how flexibly, and functions of which knots.

use super::basis::Basis;
use super::features::Part;
use super::settings::FlexibleSettings;

/// What is learned with.
pub(super) struct Teacher<'a> {
    pub settings: &'a FlexibleSettings,
    pub horizon_s: f64,
    pub wheel: Basis,
    pub body: Basis,
}

impl Teacher<'_> {
    pub fn basis(&self, part: Part) -> &Basis {
        match part {
            Part::Wheel(_) => &self.wheel,
            Part::Body => &self.body,
        }
    }
}
