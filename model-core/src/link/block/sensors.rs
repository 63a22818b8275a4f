//! What the counts of gyro and encoders are worth, in a block, and all that stands behind its effects.
//!
//! ```text
//! motors and sensors u8 · wirings, see `wirings.rs` · yaw rate of a count f32 · angle of a count f32
//! ```
//!
//! Bits 0 to 3 name motors that are wired as follows; bit 7 says that gyro and encoders follow behind them. A block without either
//! ends behind its effects. A robot that knows of no sensors refuses one with them.

use super::bounds::BoundedField;
use super::{BlockError, BlockErrorKind, wirings};
use crate::control::wiring::MotorWiring;
use crate::link::bytes::{Reader, Writer};
use crate::link::sensor_codes::SensorScales;

/// In the byte of the motors: sensors follow.
const SENSORS: u8 = 0x80;

/// Of the gyro: from ±16 °/s to ±18,000 °/s of 16 bits [rad/s].
const GYRO: BoundedField = either("gyro_rad_s_per_count", 1e-5, 1e-2);
/// Of an encoder: from 24 bits a turn behind a gear of 10 to 6 counts a turn at the wheel [rad].
const ENCODER: BoundedField = either("encoder_rad_per_count", 3e-8, 1.1);

const fn either(key: &'static str, low: f32, high: f32) -> BoundedField {
    BoundedField { key, within: (low, high), either_sign: true }
}

/// Refuses counts that no sensor has; zero is none.
pub(super) fn check(scales: &SensorScales) -> Result<(), BlockError> {
    for (field, scale) in [(GYRO, scales.gyro), (ENCODER, scales.encoder)] {
        if scale != 0.0 {
            field.check(scale)?;
        }
    }
    Ok(())
}

/// Bytes behind the effects.
pub(super) fn tail_length<const N: usize>(wiring: &[Option<MotorWiring>; N], scales: &SensorScales) -> usize {
    let (wirings, sensors) = (wirings::length(wiring), if scales.are_none() { 0 } else { SensorScales::BYTES });
    wirings + sensors + usize::from(wirings + sensors > 0)
}

/// Writes what stands behind the effects; nothing where nothing does.
pub(super) fn write_tail<const N: usize>(
    wiring: &[Option<MotorWiring>; N],
    scales: &SensorScales,
    writer: &mut Writer,
) {
    if tail_length(wiring, scales) == 0 {
        return;
    }
    let sensors = if scales.are_none() { 0 } else { SENSORS };
    writer.u8(wirings::motors(wiring) | sensors);
    wirings::write(wiring, writer);
    if sensors != 0 {
        scales.write(writer);
    }
}

/// What stands behind the effects.
type Tail<const N: usize> = ([Option<MotorWiring>; N], SensorScales);

/// Reads it to the end of the block; `short` is what is wrong where that is elsewhere.
pub(super) fn read_tail<const N: usize>(reader: &mut Reader, short: BlockError) -> Result<Tail<N>, BlockError> {
    let Some(which) = reader.u8() else { return Ok(([None; N], SensorScales::default())) };
    if which == 0 {
        return Err(short);
    }
    let wiring = wirings::read(which & !SENSORS, reader, short)?;
    let mut sensors = SensorScales::default();
    if which & SENSORS != 0 {
        sensors = SensorScales::read(reader).ok_or(short)?;
        if sensors.are_none() {
            return Err(BlockError::because(BlockErrorKind::OutOfBounds, GYRO.key));
        }
    }
    if reader.rest().is_empty() { Ok((wiring, sensors)) } else { Err(short) }
}
