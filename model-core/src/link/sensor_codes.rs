//! # Sensor codes: what a gyro and magnetic encoders said, as they said it
//!
//! ```text
//! at  bytes  field
//!  0      2  yaw rate i16 [counts of the gyro]; −32,768: no reading
//!  2      8  angle 4 × u16 [counts of the encoder]; 65,535: no reading
//! ```
//!
//! What a count is worth stands in the parameter block and in the hello ([`SensorScales`]).

use crate::link::bytes::{Reader, Writer};
use crate::link::motors::MOTORS;

/// Current turns before the codes of a record at which its sensors are read: 0.4 ms.
pub const LEAD_PERIODS: u32 = 8;

/// Angles in a turn of an encoder; those of fewer bits tell theirs in these.
pub const ENCODER_COUNTS: u16 = 1 << 14;

/// A rate that no gyro tells.
const NO_RATE: i16 = i16::MIN;
/// An angle that no encoder tells.
const NO_ANGLE: u16 = u16::MAX;

/// What gyro and encoders said; the default is that nobody said anything.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SensorCodes {
    yaw: i16,
    angle: [u16; MOTORS],
}

impl Default for SensorCodes {
    fn default() -> Self {
        Self { yaw: NO_RATE, angle: [NO_ANGLE; MOTORS] }
    }
}

impl SensorCodes {
    /// Length of their bytes.
    pub const BYTES: usize = 2 + 2 * MOTORS;

    /// The codes of readings [counts]; `None` where there is none.
    pub fn of(yaw: Option<i16>, angle: [Option<u16>; MOTORS]) -> Self {
        Self { yaw: yaw.unwrap_or(NO_RATE), angle: angle.map(|angle| angle.unwrap_or(NO_ANGLE)) }
    }

    /// Yaw rate [counts of the gyro].
    pub fn yaw(&self) -> Option<i16> {
        Some(self.yaw).filter(|yaw| *yaw != NO_RATE)
    }

    /// Angle of a motor's encoder [counts of the encoder].
    pub fn angle(&self, motor: usize) -> Option<u16> {
        self.angle.get(motor).copied().filter(|angle| *angle != NO_ANGLE)
    }

    /// Their bytes.
    pub fn to_bytes(&self) -> [u8; Self::BYTES] {
        let mut bytes = [0; Self::BYTES];
        let mut writer = Writer::new(&mut bytes);
        writer.u16(self.yaw.cast_unsigned());
        self.angle.iter().for_each(|angle| writer.u16(*angle));
        bytes
    }

    /// The codes of these bytes.
    pub fn from_bytes(bytes: &[u8; Self::BYTES]) -> Self {
        let mut reader = Reader::new(bytes);
        let mut next = || reader.u16().unwrap_or(NO_ANGLE);
        Self { yaw: next().cast_signed(), angle: [(); MOTORS].map(|()| next()) }
    }
}

/// What the counts of gyro and encoders are worth; zero where there is none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SensorScales {
    /// Yaw rate of one count, below zero where the gyro is mounted upside down [rad/s]
    pub gyro: f32,
    /// Angle at the wheel's shaft of one count of an encoder, below zero where it counts backwards [rad]
    pub encoder: f32,
}

impl SensorScales {
    /// Length of their bytes.
    pub const BYTES: usize = 8;

    /// True if the robot has neither.
    pub fn are_none(&self) -> bool {
        self.gyro == 0.0 && self.encoder == 0.0
    }

    /// Yaw rate that the gyro tells [rad/s]; `None` without one, or without a reading.
    pub fn yaw_rate(&self, codes: &SensorCodes) -> Option<f32> {
        codes.yaw().filter(|_| self.gyro != 0.0).map(|yaw| self.gyro * f32::from(yaw))
    }

    /// Puts them behind what was written.
    pub(crate) fn write(&self, writer: &mut Writer) {
        writer.f32(self.gyro);
        writer.f32(self.encoder);
    }

    /// Reads them; `None` where there are too few bytes.
    pub(crate) fn read(reader: &mut Reader) -> Option<Self> {
        Some(Self { gyro: reader.f32()?, encoder: reader.f32()? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readings_come_back_and_those_that_are_missing_stay_missing() {
        let codes = SensorCodes::of(Some(-2), [Some(0), None, Some(16_383), None]);
        let bytes = codes.to_bytes();
        assert_eq!(bytes, [0xFE, 0xFF, 0, 0, 0xFF, 0xFF, 0xFF, 0x3F, 0xFF, 0xFF]);
        let back = SensorCodes::from_bytes(&bytes);
        assert_eq!((back.yaw(), [0, 1, 2, 3].map(|j| back.angle(j))), (Some(-2), [Some(0), None, Some(16_383), None]));
        assert_eq!(back.angle(4), None);
        assert_eq!(SensorCodes::default(), SensorCodes::of(None, [None; MOTORS]));
    }

    #[test]
    fn a_rate_needs_a_gyro_and_a_reading() {
        let codes = SensorCodes::of(Some(-100), [None; MOTORS]);
        let scales = SensorScales { gyro: -0.001, encoder: 0.0 };
        assert!((scales.yaw_rate(&codes).expect("both") - 0.1).abs() < 1e-7);
        assert_eq!((scales.yaw_rate(&SensorCodes::default()), SensorScales::default().yaw_rate(&codes)), (None, None));
        assert!(SensorScales::default().are_none() && !scales.are_none());
    }
}
