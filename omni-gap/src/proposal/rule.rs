//! A rule of a mapping, and everything that speaks for it.

use super::doubt::Found;
use super::groups::Place;
use super::units::Conversion;
use crate::log::target::Target;

/// One column of the contract, and where it comes from.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Rule {
    pub target: Target,
    pub place: Place,
    pub conversion: Conversion,
    pub sign: f64,
    pub offset: f64,
    /// Everything that speaks for it.
    pub found: Found,
}

impl Rule {
    pub fn new(target: Target, place: Place, conversion: Conversion) -> Rule {
        let found = conversion.found.clone();
        Rule { target, place, conversion, sign: 1.0, offset: 0.0, found }
    }
}
