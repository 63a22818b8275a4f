//! # Hello: how to read a robot's records
//!
//! Sent about once a second, so that a file of frames explains itself: what a code is worth, where the zeros of the
//! current sensors lie, which parameter block the robot runs with.
//!
//! ```text
//! at  bytes  field
//!  0      2  version of the firmware u16
//!  2      2  version of the block's form u16
//!  4      4  CRC-32 of the parameter block u32
//!  8      1  wheels u8
//!  9      1  commutation u8 (0 field-oriented, 1 six-step)
//! 10      1  pole pairs u8
//! 11      4  current of one count f32 [A]
//! 15      4  bus voltage of one count f32 [V]
//! 19      4  gear ratio f32 [1]
//! 23      4  period of the current turn f32 [s]
//! 27     24  zeros of the current sensors 4 × (a, b, c) u16 [1/16 count]
//! 51      4  yaw rate of one count of the gyro f32 [rad/s], 0 without one
//! 55      4  angle of one count of an encoder f32 [rad of the wheel], 0 without them
//! ```
//!
//! A hello of a robot without gyro and encoders ends before them, as all did before there were any.

use crate::control::calibration::Calibration;
use crate::link::bytes::Reader;
use crate::link::payload::Payload;
use crate::link::record::MOTORS;
use crate::link::sensor_codes::SensorScales;

/// How a motor's phases are driven.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u8)]
pub enum Commutation {
    /// Sinusoidal, by the angle of the rotor.
    #[default]
    FieldOriented,
    /// Two phases at a time, by the sector of the halls.
    SixStep,
}

impl Commutation {
    /// Its number on the wire.
    pub const fn code(self) -> u8 {
        self as u8
    }

    /// The one of this number.
    pub const fn from_code(code: u8) -> Option<Commutation> {
        match code {
            0 => Some(Commutation::FieldOriented),
            1 => Some(Commutation::SixStep),
            _ => None,
        }
    }
}

/// How to read a robot's records.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hello {
    /// Version of the firmware.
    pub firmware: u16,
    /// Version of the block's form, see [`crate::link::block::VERSION`].
    pub block_version: u16,
    /// CRC-32 of the parameter block that the robot runs with: its last four bytes.
    pub block_check: u32,
    /// Three or four.
    pub wheels: u8,
    /// How the motors are driven.
    pub commutation: Commutation,
    /// What the codes mean.
    pub calibration: Calibration<f32>,
    /// l, motor speed over wheel speed [1]
    pub gear_ratio: f32,
    /// Zeros of the current sensors (a, b, c) of every motor [1/16 count]
    pub offsets: [[u16; 3]; MOTORS],
    /// What counts of gyro and encoders are worth
    pub sensors: SensorScales,
}

/// Parts of a count in which zeros are told.
pub const OFFSET_PARTS: u16 = 16;

impl Hello {
    /// Length of its payload, of a robot without gyro and encoders.
    pub const BYTES: usize = 51;

    /// Length of its payload, of a robot with them.
    pub const MOST_BYTES: usize = Self::BYTES + SensorScales::BYTES;

    /// Its payload.
    pub fn to_bytes(&self) -> Payload<{ Self::MOST_BYTES }> {
        Payload::of(|writer| {
            writer.u16(self.firmware);
            writer.u16(self.block_version);
            writer.u32(self.block_check);
            writer.u8(self.wheels);
            writer.u8(self.commutation.code());
            writer.u8(self.calibration.pole_pairs);
            writer.f32(self.calibration.amps_per_count);
            writer.f32(self.calibration.bus_volts_per_count);
            writer.f32(self.gear_ratio);
            writer.f32(self.calibration.period);
            self.offsets.iter().flatten().for_each(|x| writer.u16(*x));
            if !self.sensors.are_none() {
                self.sensors.write(writer);
            }
        })
    }

    /// Reads a payload; `None` where it is not one, or says what no robot has.
    pub fn from_bytes(payload: &[u8]) -> Option<Hello> {
        let (payload, behind) = payload.split_first_chunk::<{ Self::BYTES }>()?;
        let sensors = match behind {
            [] => SensorScales::default(),
            behind if behind.len() == SensorScales::BYTES => SensorScales::read(&mut Reader::new(behind))?,
            _ => return None,
        };
        let sound = sensors.gyro.is_finite() && sensors.encoder.is_finite();
        let mut reader = Reader::new(payload);
        let (firmware, block_version, block_check) = (reader.u16()?, reader.u16()?, reader.u32()?);
        let (wheels, commutation, pole_pairs) =
            (reader.u8()?, Commutation::from_code(reader.u8()?)?, reader.u8().filter(|p| *p > 0)?);
        let positive = |reader: &mut Reader| reader.f32().filter(|x| x.is_finite() && *x > 0.0);
        // below zero where the code falls with the current
        let amps_per_count = reader.f32().filter(|x| x.is_finite() && *x != 0.0)?;
        let bus_volts_per_count = positive(&mut reader)?;
        let (gear_ratio, period) = (positive(&mut reader)?, positive(&mut reader)?);
        Some(Hello {
            firmware,
            block_version,
            block_check,
            wheels: Some(wheels).filter(|n| (3..=4).contains(n))?,
            commutation,
            calibration: Calibration { amps_per_count, bus_volts_per_count, pole_pairs, period },
            gear_ratio,
            offsets: reader.each(|reader| reader.each(Reader::u16))?,
            sensors: Some(sensors).filter(|_| sound)?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HELLO: Hello = Hello {
        firmware: 0x0102,
        block_version: 1,
        block_check: 0xdead_beef,
        wheels: 4,
        commutation: Commutation::SixStep,
        calibration: Calibration { amps_per_count: 0.0049, bus_volts_per_count: 0.00886, pole_pairs: 8, period: 50e-6 },
        gear_ratio: 5.0,
        offsets: [[32768, 32700, 32800], [1, 2, 3], [4, 5, 6], [7, 8, 0xffff]],
        sensors: SensorScales { gyro: 0.0, encoder: 0.0 },
    };

    #[test]
    fn it_is_read_as_it_was_written() {
        assert_eq!(Hello::from_bytes(&HELLO.to_bytes()), Some(HELLO));
        let turned = Calibration { amps_per_count: -0.0049, ..HELLO.calibration };
        let turned = Hello { calibration: turned, ..HELLO };
        assert_eq!(Hello::from_bytes(&turned.to_bytes()), Some(turned));
        let three = Hello { wheels: 3, commutation: Commutation::FieldOriented, ..HELLO };
        assert_eq!(Hello::from_bytes(&three.to_bytes()), Some(three));
        let sees = Hello { sensors: SensorScales { gyro: -0.001, encoder: 0.0 }, ..HELLO };
        assert_eq!((Hello::from_bytes(&sees.to_bytes()), sees.to_bytes().len()), (Some(sees), 59));
        assert_eq!((Hello::from_bytes(&sees.to_bytes()[..51]), HELLO.to_bytes().len()), (Some(HELLO), 51));
    }

    #[test]
    fn what_no_robot_has_is_refused() {
        for (at, value) in [(8, 2), (8, 5), (9, 2), (10, 0)] {
            let mut bytes: [u8; Hello::BYTES] = (*HELLO.to_bytes()).try_into().expect("51 bytes");
            bytes[at] = value;
            assert_eq!(Hello::from_bytes(&bytes), None, "byte {at} = {value}");
        }
        for at in [11, 15, 19, 23] {
            for x in [0.0, -1.0, f32::NAN, f32::INFINITY].into_iter().filter(|x| at != 11 || *x != -1.0) {
                let mut bytes: [u8; Hello::BYTES] = (*HELLO.to_bytes()).try_into().expect("51 bytes");
                bytes[at..at + 4].copy_from_slice(&x.to_le_bytes());
                assert_eq!(Hello::from_bytes(&bytes), None, "{x} at {at}");
            }
        }
        let sees = Hello { sensors: SensorScales { gyro: f32::NAN, encoder: 1.0 }, ..HELLO }.to_bytes();
        for len in (0..=Hello::MOST_BYTES).filter(|len| *len != Hello::BYTES) {
            assert_eq!(Hello::from_bytes(&sees[..len]), None);
        }
    }
}
