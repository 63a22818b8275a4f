//! A cause that a search has found.

use super::candidate::Cause;

/// A cause of the corrected model.
#[derive(Clone, Debug)]
pub struct Found {
    /// The cause.
    pub cause: Cause,
    /// Causes that the data cannot tell from it.
    pub not_told_apart_from: Vec<Cause>,
    /// The round in which it was found.
    pub round: usize,
    /// How much worse the corrected model does without it [score].
    pub earns: f64,
}

impl Found {
    /// True of a number of the robot file.
    pub fn is_parameter(&self) -> bool {
        matches!(self.cause, Cause::Parameter(_))
    }
}
