//! # Semihosting: what a program on a board asks its probe
//!
//! The tests that are written for a board ask which of them is to run, and say how it ended. Source: Arm semihosting
//! specification, `SYS_GET_CMDLINE`, `SYS_EXIT` and `SYS_EXIT_EXTENDED`; everything else is answered with success.

use unicorn_engine::{RegisterARM as Reg, Unicorn};

use super::error::ChipError;
use super::machine::Machine;
use super::memory::word;

/// The instruction that asks.
pub const BREAKPOINT: u16 = 0xBEAB;

const GET_CMDLINE: u64 = 0x15;
const EXIT: u64 = 0x18;
const EXIT_EXTENDED: u64 = 0x20;
/// The reason of an exit as it should be.
const APPLICATION_EXIT: u32 = 0x2_0026;

/// Answers what the core stands at.
///
/// # Errors
/// Where the emulator refuses.
pub fn answer(unicorn: &mut Unicorn<'static, Machine>) -> Result<(), ChipError> {
    let argument = unicorn.reg_read(Reg::R1)? as u32;
    match unicorn.reg_read(Reg::R0)? {
        GET_CMDLINE => {
            let line = unicorn.get_data().command_line.clone();
            let buffer = word(unicorn, argument);
            unicorn.mem_write(u64::from(buffer), &[line.as_bytes(), &[0]].concat())?;
            unicorn.mem_write(u64::from(argument) + 4, &(line.len() as u32).to_le_bytes())?;
        }
        EXIT => unicorn.get_data_mut().ended = Some(argument == APPLICATION_EXIT),
        EXIT_EXTENDED => {
            let well = word(unicorn, argument) == APPLICATION_EXIT && word(unicorn, argument + 4) == 0;
            unicorn.get_data_mut().ended = Some(well);
        }
        _ => {}
    }
    unicorn.reg_write(Reg::R0, 0)?;
    let pc = unicorn.reg_read(Reg::PC)?;
    Ok(unicorn.reg_write(Reg::PC, (pc + 2) | 1)?)
}
