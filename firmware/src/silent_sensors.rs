//! # Silent sensors: a gyro or an encoder that is fitted and does not answer
//!
//! A reading that is missing costs nothing but itself ([`crate::drivers::sensors`]), and one alone says nothing of its sensor. A
//! sensor is silent that has given none for [`SILENT_TURNS`], and is not any more with its next.

use model_core::link::record::MOTORS;
use model_core::link::sensor_codes::SensorCodes;

use crate::drivers::sensors::{FittedSensors, RETRY};

/// Turns without a reading after which a sensor is silent, 0.2 s: in them it was begun with anew twice, so that one that comes up
/// with the robot is none.
pub const SILENT_TURNS: u8 = 2 * RETRY;

/// Which sensors are silent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SilentSensors(u8);

impl SilentSensors {
    /// A bit each: the motors' encoders from the lowest on, then the gyro.
    pub const fn bits(self) -> u8 {
        self.0
    }

    /// True if all that are fitted answer.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }
}

/// For how long each sensor has given no reading.
#[derive(Clone, Copy, Debug, Default)]
pub struct SensorSilence {
    /// Turns, up to [`SILENT_TURNS`]; in the order of the bits
    turns: [u8; MOTORS + 1],
}

impl SensorSilence {
    /// A turn: which of the fitted sensors are silent, after these readings.
    pub fn turn(&mut self, fitted: FittedSensors, codes: &SensorCodes) -> SilentSensors {
        let mut silent = 0;
        for (sensor, turns) in self.turns.iter_mut().enumerate() {
            let (is_fitted, has_spoken) = if sensor < MOTORS {
                (sensor < usize::from(fitted.encoders), codes.angle(sensor).is_some())
            } else {
                (fitted.gyro, codes.yaw().is_some())
            };
            *turns = if is_fitted && !has_spoken { SILENT_TURNS.min(*turns + 1) } else { 0 };
            silent |= u8::from(*turns == SILENT_TURNS) << sensor;
        }
        SilentSensors(silent)
    }
}
