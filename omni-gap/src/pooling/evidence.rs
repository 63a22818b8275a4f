//! What pooling needs of a session.

use crate::engine::findings::SessionEquations;

/// A session of a robot: its labels and its equations.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SessionEvidence {
    /// Where it lies.
    pub session: String,
    /// Which robot.
    pub robot: String,
    /// The day, as YYYY-MM-DD.
    pub date: String,
    /// The firmware's version, where it is known.
    pub firmware: Option<String>,
    /// The floor, where it is known.
    pub floor: Option<String>,
    /// The causes that it named alone.
    pub named: Vec<String>,
    /// What it says of every cause; none where no model was fitted.
    pub equations: Option<SessionEquations>,
}
