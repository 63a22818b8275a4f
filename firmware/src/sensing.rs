//! # Sensing: from the task that asks gyro and encoders to the motion turn
//!
//! The sensors are read [`LEAD_PERIODS`] periods before a motion turn, by a task of their own that nobody waits for. A reading is taken
//! once: one that is not there in time is missing, and none is used twice.

use model_core::link::record::MOTORS;
use model_core::link::sensor_codes::{LEAD_PERIODS, SensorCodes, SensorScales};

use crate::codes::PERIODS_PER_TICK;
use crate::drivers::sensors::FittedSensors;
use crate::silent_sensors::{SensorSilence, SilentSensors};

/// The period of a motion turn's twenty in which the sensors are read: 0.4 ms before the next, in which all five are read beside
/// the current turns (`host-tests/golden/chip.md`).
pub const DUE: u32 = PERIODS_PER_TICK - LEAD_PERIODS;

impl FittedSensors {
    /// Those that a parameter block knows the scale of, of a robot with so many wheels.
    pub fn of(scales: &SensorScales, wheels: u8) -> Self {
        Self { gyro: scales.gyro != 0.0, encoders: if scales.encoder != 0.0 { wheels } else { 0 } }
    }

    /// What these say, of the codes of all.
    pub fn only(self, codes: &SensorCodes) -> SensorCodes {
        let mut angles = [None; MOTORS];
        for (j, angle) in angles.iter_mut().enumerate().take(self.encoders.into()) {
            *angle = codes.angle(j);
        }
        SensorCodes::of(codes.yaw().filter(|_| self.gyro), angles)
    }
}

/// What the two tasks share.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sensing {
    fitted: FittedSensors,
    codes: SensorCodes,
    silence: SensorSilence,
}

impl Sensing {
    /// Which sensors are to be read.
    pub fn fitted(&self) -> FittedSensors {
        self.fitted
    }

    /// They were read.
    pub fn put(&mut self, codes: SensorCodes) {
        self.codes = codes;
    }

    /// Takes what was read since this was called last, and which sensors have not been for long, and says what is to be read from
    /// now on. Called once a motion turn.
    pub fn take(&mut self, fitted: FittedSensors) -> (SensorCodes, SilentSensors) {
        self.fitted = fitted;
        let codes = core::mem::take(&mut self.codes);
        (codes, self.silence.turn(fitted, &codes))
    }
}
