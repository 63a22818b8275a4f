//! # Watch: is the gap still at its floor, while the robot drives
//!
//! [`Watch`] is shown rows as they come and gives a [`Reading`] for every window of them: by how much measurement and model
//! are apart, per signal group and per stage, beside what noise alone would leave. It remembers no more than the plant does.
//!
//! **A stage by itself.** Each stage is driven by its own measured input, so that an error before it does not come through:
//! the winding by the measured speeds (restarted on every row), drivetrain and body by the measured currents, the contact by
//! the measured wheel speeds. A stage whose input is not measured has the stages before it in its error.
//!
//! **The alarm.** A window is simulated K times from the model itself with the sensors' noise. If the model is right, the
//! measured window is one of K + 1 that look alike, so its error is the largest of all in one of K + 1 windows. A stage is
//! above its floor where its error is the largest, and larger than the floor by what anybody would care about. Such a window
//! adds g to the stage's score, any other takes one off, down to zero; a score of h is an alarm ([`Rule`]). A robot that rests
//! now and then shows a fault in some windows only, so they need not follow each other. With p = 1/(K + 1):
//!
//! ```text
//! P(false alarm begins at a window) ≤ z^−h,   p·z^(g + 1) − z + 1 − p = 0, z > 1
//! ```
//!
//! of each stage, as windows do not share their noise. With K = 19, g = 3, h = 18 that is 4.1·10⁻⁷: with windows of 1 s and
//! three stages one in 226 h. A change that every window shows is told after seven at the latest, one that more than a quarter
//! of them show, in the end.

mod alarms;
mod errors;
mod reading;
mod rule;
mod state;
mod window;

pub use reading::{Alarm, GroupError, Reading, StageError};
pub use rule::Rule;
pub use state::Watch;

#[cfg(test)]
mod tests;
