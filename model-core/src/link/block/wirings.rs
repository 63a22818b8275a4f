//! What a commissioning found of the motors, in a block: behind the effects, where there is anything to tell (`sensors.rs`).
//!
//! ```text
//! for each motor with a bit: outputs 3 × u8 · converters 3 × u8, + 128 where inverted
//!                           · hall codes of the sectors 6 × u8 · edges 6 × u16 [2⁻¹⁶ turn]
//! ```

use super::{BlockError, BlockErrorKind};
use crate::control::halls::HallCode;
use crate::control::wiring::MotorWiring;
use crate::link::bytes::{Reader, Writer};

/// Bytes of one motor's wiring.
pub(super) const BYTES: usize = 3 + 3 + 6 + 12;

/// In the byte of a converter: its code falls with the current.
const INVERTED: u8 = 0x80;

const WRONG: BlockError = BlockError::because(BlockErrorKind::Wiring, "wiring");

/// Bytes that are written for these motors.
pub(super) fn length<const N: usize>(wirings: &[Option<MotorWiring>; N]) -> usize {
    wirings.iter().flatten().count() * BYTES
}

/// Refuses what no motor is wired like.
pub(super) fn check<const N: usize>(wirings: &[Option<MotorWiring>; N]) -> Result<(), BlockError> {
    if wirings.iter().flatten().all(MotorWiring::is_possible) { Ok(()) } else { Err(WRONG) }
}

/// One bit a motor that was commissioned.
pub(super) fn motors<const N: usize>(wirings: &[Option<MotorWiring>; N]) -> u8 {
    wirings.iter().enumerate().fold(0, |motors, (j, wiring)| motors | u8::from(wiring.is_some()) << j)
}

/// Writes them.
pub(super) fn write<const N: usize>(wirings: &[Option<MotorWiring>; N], writer: &mut Writer) {
    for wiring in wirings.iter().flatten() {
        writer.bytes(&wiring.outputs);
        for (converter, inverted) in wiring.converters.iter().zip(wiring.inverted) {
            writer.u8(converter | if inverted { INVERTED } else { 0 });
        }
        wiring.codes.iter().for_each(|code| writer.u8(code.0));
        wiring.edges.iter().for_each(|edge| writer.u16(*edge));
    }
}

/// Reads those of these motors; `short` is what is wrong where there are fewer.
pub(super) fn read<const N: usize>(
    motors: u8,
    reader: &mut Reader,
    short: BlockError,
) -> Result<[Option<MotorWiring>; N], BlockError> {
    let mut wirings = [None; N];
    if u32::from(motors) >> N != 0 {
        return Err(short);
    }
    for (_, slot) in wirings.iter_mut().enumerate().filter(|(j, _)| motors >> j & 1 != 0) {
        *slot = Some(one(reader).ok_or(short)?);
    }
    Ok(wirings)
}

fn one(reader: &mut Reader) -> Option<MotorWiring> {
    let (outputs, converters): ([u8; 3], [u8; 3]) = (reader.array()?, reader.array()?);
    Some(MotorWiring {
        outputs,
        converters: converters.map(|byte| byte & !INVERTED),
        inverted: converters.map(|byte| byte & INVERTED != 0),
        codes: reader.array()?.map(HallCode),
        edges: reader.each(Reader::u16)?,
    })
}
