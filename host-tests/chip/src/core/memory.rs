//! # Memory: what is at which address

use unicorn_engine::Unicorn;

use super::error::ChipError;
use super::machine::{FLASH_AT, Machine};
use super::nvic::{PRIVATE, PRIVATE_LEN};
use crate::peripherals::bus::Bus;
use crate::peripherals::flash;
use crate::peripherals::link::Move;
use crate::peripherals::map::{PERIPHERALS, PERIPHERALS_LEN};

/// Where every bit of the peripherals is a word.
const BIT_BAND: u32 = 0x4200_0000;

/// The word in memory.
pub fn word(unicorn: &Unicorn<'_, Machine>, address: u32) -> u32 {
    let mut word = [0; 4];
    let _read = unicorn.mem_read(u64::from(address), &mut word);
    u32::from_le_bytes(word)
}

/// Lets the DMA move its bytes.
pub fn move_bytes(unicorn: &mut Unicorn<'_, Machine>) {
    for what in std::mem::take(&mut unicorn.get_data_mut().bus.moves) {
        match what {
            Move::Store { address, byte } => {
                let _stored = unicorn.mem_write(u64::from(address), &[byte]);
            }
            Move::Send { address } => {
                let mut byte = [0];
                let _read = unicorn.mem_read(u64::from(address), &mut byte);
                unicorn.get_data_mut().bus.link.outward.extend(byte);
            }
        }
    }
}

/// A word of the bit band is a bit of a register: (its address, the bit).
fn bit_band(offset: u64) -> (u32, u32) {
    let bit = offset as u32 / 4;
    (PERIPHERALS + bit / 32 * 4, bit % 32)
}

/// Maps registers, and the flash behind the bytes that are reserved for the image.
///
/// # Errors
/// Where the emulator refuses.
pub fn map_registers(unicorn: &mut Unicorn<'static, Machine>, reserved: usize) -> Result<(), ChipError> {
    unicorn.mmio_map(
        u64::from(PERIPHERALS),
        PERIPHERALS_LEN as usize,
        Some(|unicorn: &mut Unicorn<'_, Machine>, offset: u64, size: usize| {
            let machine = unicorn.get_data_mut();
            let address = PERIPHERALS + offset as u32;
            machine.time += machine.pace.access(address);
            u64::from(machine.bus.read(address & !3) >> (8 * (address & 3))) & ((1 << (8 * size)) - 1)
        }),
        Some(|unicorn: &mut Unicorn<'_, Machine>, offset: u64, size: usize, value: u64| {
            let machine = unicorn.get_data_mut();
            let address = PERIPHERALS + offset as u32;
            machine.time += machine.pace.access(address);
            let (shift, mask) = (8 * (address & 3), ((1u64 << (8 * size)) - 1) as u32);
            let word = if size == 4 {
                value as u32
            } else {
                machine.bus.words.get(address & !3) & !(mask << shift) | (value as u32 & mask) << shift
            };
            machine.bus.write(address & !3, word);
            machine.settle();
        }),
    )?;
    unicorn.mmio_map(
        u64::from(BIT_BAND),
        PERIPHERALS_LEN as usize * 32,
        Some(|unicorn: &mut Unicorn<'_, Machine>, offset: u64, _: usize| {
            let (address, bit) = bit_band(offset);
            u64::from(unicorn.get_data_mut().bus.read(address) >> bit & 1)
        }),
        Some(|unicorn: &mut Unicorn<'_, Machine>, offset: u64, _: usize, value: u64| {
            let (address, bit) = bit_band(offset);
            let machine = unicorn.get_data_mut();
            let word = machine.bus.read(address) & !(1 << bit) | (value as u32 & 1) << bit;
            machine.bus.write(address, word);
            machine.settle();
        }),
    )?;
    unicorn.mmio_map(
        u64::from(PRIVATE),
        PRIVATE_LEN as usize,
        Some(|unicorn: &mut Unicorn<'_, Machine>, offset: u64, size: usize| {
            let machine = unicorn.get_data_mut();
            u64::from(machine.nvic.read(PRIVATE + offset as u32, size, machine.time / 4))
        }),
        Some(|unicorn: &mut Unicorn<'_, Machine>, offset: u64, size: usize, value: u64| {
            unicorn.get_data_mut().nvic.write(PRIVATE + offset as u32, size, value as u32);
        }),
    )?;
    unicorn.mmio_map(
        FLASH_AT + reserved as u64,
        flash::LEN - reserved,
        Some(move |unicorn: &mut Unicorn<'_, Machine>, offset: u64, size: usize| {
            unicorn.get_data_mut().bus.flash.read(reserved + offset as usize, size)
        }),
        Some(move |unicorn: &mut Unicorn<'_, Machine>, offset: u64, size: usize, value: u64| {
            let machine = unicorn.get_data_mut();
            let Bus { flash, words, log, .. } = &mut machine.bus;
            flash.program(words, log, reserved + offset as usize, size, value);
            machine.settle();
        }),
    )?;
    Ok(())
}
