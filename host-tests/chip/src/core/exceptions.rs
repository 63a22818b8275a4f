//! # Exceptions: how they begin and end
//!
//! Source: ARMv7-M architecture reference manual, exception entry and return; the frame is the extended one every time.

use unicorn_engine::{RegisterARM as Reg, Unicorn};

use super::error::ChipError;
use super::machine::Machine;
use super::memory::word;
use crate::events::Event;

/// Where exceptions return to, and above.
pub const RETURNS: u32 = 0xFFFF_F000;
/// Thread or handler, main stack, with the floating-point frame.
const EXC_RETURN: u32 = 0xFFFF_FFE9;
/// Entry and return [core cycles].
const LATENCY: u64 = 12;

/// BASEPRI and PRIMASK.
pub fn masks(unicorn: &Unicorn<'_, Machine>) -> (u8, bool) {
    let read = |reg: Reg| unicorn.reg_read(reg).unwrap_or(0);
    (read(Reg::BASEPRI) as u8, read(Reg::PRIMASK) != 0)
}

/// An exception begins.
///
/// # Errors
/// Where the emulator refuses.
pub fn enter(unicorn: &mut Unicorn<'static, Machine>, exception: u16) -> Result<(), ChipError> {
    let read = |reg: Reg| unicorn.reg_read(reg).map(|value| value as u32);
    let mut frame = Vec::with_capacity(26);
    for reg in [Reg::R0, Reg::R1, Reg::R2, Reg::R3, Reg::R12, Reg::LR, Reg::PC, Reg::XPSR] {
        frame.push(read(reg)?);
    }
    for k in 0..16 {
        frame.push(unicorn.reg_read(Reg::S0 as i32 + k)? as u32);
    }
    frame.extend([read(Reg::FPSCR)?, 0]);
    let stack = read(Reg::SP)?;
    // aligned to eight bytes, with a bit in the status word that says so
    let aligned = (stack - 4 * 26) & !7;
    frame[7] = frame[7] & !(1 << 9) | (stack & 4) << 7;
    let bytes: Vec<u8> = frame.iter().flat_map(|word| word.to_le_bytes()).collect();
    // a stack that leads nowhere: the handlers of faults do not need the frame
    let _written = unicorn.mem_write(u64::from(aligned), &bytes);
    let vector = word(unicorn, unicorn.get_data().nvic.vector_table() + 4 * u32::from(exception));
    unicorn.reg_write(Reg::SP, u64::from(aligned))?;
    unicorn.reg_write(Reg::LR, u64::from(EXC_RETURN))?;
    unicorn.reg_write(Reg::PC, u64::from(vector))?;
    let machine = unicorn.get_data_mut();
    machine.conditional = 0;
    machine.nvic.begin(exception);
    let now = machine.spent();
    machine.profile.enter(exception, now);
    machine.bus.log.note(machine.time / 4, Event::Exception { number: exception });
    machine.time += 4 * LATENCY;
    Ok(())
}

/// An exception ends.
///
/// # Errors
/// Where the emulator refuses.
pub fn leave(unicorn: &mut Unicorn<'static, Machine>) -> Result<(), ChipError> {
    let stack = unicorn.reg_read(Reg::SP)? as u32;
    let mut bytes = [0; 4 * 26];
    unicorn.mem_read(u64::from(stack), &mut bytes)?;
    let saved =
        |k: usize| u64::from(u32::from_le_bytes([bytes[4 * k], bytes[4 * k + 1], bytes[4 * k + 2], bytes[4 * k + 3]]));
    for (k, reg) in [Reg::R0, Reg::R1, Reg::R2, Reg::R3, Reg::R12, Reg::LR].into_iter().enumerate() {
        unicorn.reg_write(reg, saved(k))?;
    }
    for k in 0..16 {
        unicorn.reg_write(Reg::S0 as i32 + k as i32, saved(8 + k))?;
    }
    unicorn.reg_write(Reg::FPSCR, saved(24))?;
    let status = saved(7);
    unicorn.reg_write(Reg::SP, u64::from(stack) + 4 * 26 + (status >> 7 & 4))?;
    unicorn.reg_write(Reg::XPSR_NZCVQG, status & 0xF80F_0000)?;
    unicorn.reg_write(Reg::PC, saved(6) | 1)?;
    let machine = unicorn.get_data_mut();
    machine.nvic.end();
    machine.time += 4 * LATENCY;
    let now = machine.spent();
    machine.profile.leave(now);
    Ok(())
}
