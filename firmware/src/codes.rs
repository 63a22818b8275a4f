//! # Codes: what a board hands out once a period, before anything is a number
//!
//! One period is 50 µs, one turn of the PWM. All that a board measures in it is here, as it was measured.

use model_core::control::calibration::AdcCode;
use model_core::control::halls::HallCode;

/// The motors that the board has bridges for; a robot of three wheels leaves the last one asleep.
pub const MOTORS: usize = 4;

/// Periods a second: PWM, currents and halls [Hz].
pub const PERIODS_PER_SECOND: u32 = 20_000;

/// Periods from one motion turn to the next.
pub const PERIODS_PER_TICK: u32 = 20;

/// Length of a motion turn [s].
pub const TICK_SECONDS: f32 = PERIODS_PER_TICK as f32 / PERIODS_PER_SECOND as f32;

/// What was measured in one period.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Codes {
    /// The three phase currents of every motor, each at the top of that motor's timer, where its low sides conduct
    pub phases: [[AdcCode; 3]; MOTORS],
    /// The supply
    pub bus: AdcCode,
    /// The hall lines of every motor
    pub halls: [HallCode; MOTORS],
    /// True while a gate driver pulls the shared fault line
    pub driver_fault: bool,
}
