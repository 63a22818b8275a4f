//! # Instants: when the board samples currents and looks at its halls
//!
//! ```text
//! duties in force        sampled                          next duties in force
//!       0 ──────────────── s ─────── s + h ───────────────────── 1 ──────► periods
//! s = 1 − (t_duties − t_sample),   h = t_halls − t_sample
//! ```
//!
//! A program is told of the sample in a period, and what it decides holds over the next period. So the time from a sample
//! to the middle of what it leads to is 1½ periods less s.
//!
//! Source: `firmware::registers::timing`, the only place that says when these are. A test may give a board others, to see
//! what they would break.

use firmware::registers::timing;

/// One PWM period [s].
pub const PERIOD: f64 = 50e-6;

/// When currents are sampled and halls are read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instants {
    /// s, from the moment at which duties come into force to the sample of the currents [periods], 0 to 1
    pub sample: f64,
    /// h, from there to the reading of the hall lines [periods]
    pub halls: f64,
}

impl Default for Instants {
    /// Those of the firmware's board.
    fn default() -> Self {
        let [sample, halls, duties] = [timing::SAMPLE, timing::HALLS_READ, timing::DUTIES].map(f64::from);
        // s = 1 − (t_duties − t_sample),  h = t_halls − t_sample
        Self { sample: 1.0 - (duties - sample), halls: halls - sample }
    }
}
