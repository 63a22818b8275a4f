//! A window of a recording, and what three models leave of it.

use super::circumstances::Circumstances;
use super::residual::Residuals;

/// How many models there are.
pub(super) const MODELS: usize = 3;

/// The model that is there before a cause is taken up.
pub(super) const BEFORE: usize = 0;

/// What the robot file says.
pub(super) const NOMINAL: usize = 1;

/// What the findings stand by.
pub(super) const CORRECTED: usize = 2;

/// A window of a recording.
#[derive(Clone, Debug)]
pub(super) struct Window {
    /// Windows with the same number are not independent.
    pub cluster: usize,
    /// When it was.
    pub when: Circumstances,
    /// What each model leaves of it.
    pub residuals: [Residuals; MODELS],
}
