//! # SPI: SPI1, one gyro and an encoder a wheel
//!
//! Eight bits a frame, high bit first, chip selects by software. Every device sets the mode that it needs before it is selected.
//! A byte takes 1.5 µs: 84 MHz by 16 is 5.25 MHz, the fastest that is not above the 10 MHz that both devices bear (by 8 it
//! were 10.5).
//!
//! Sources: RM0090, SPI (clock phase and polarity, slave select management, registers; CPOL and CPHA change while SPE is off); BMI088,
//! Bosch BST-BMI088-DS001 revision 1.4, SPI timing; AS5047P, ams datasheet v1-01, SPI timing.

use super::timing::{APB2_HZ, CORE_HZ};
use super::words::{Field, Word};

/// Control register 1
pub enum Cr1 {}
/// Status register
pub enum Sr {}

const CPHA: Field<Cr1> = Field::at(0, 1);
const MSTR: Field<Cr1> = Field::at(2, 1);
const BR: Field<Cr1> = Field::at(3, 3);
const SPE: Field<Cr1> = Field::at(6, 1);
const SSI: Field<Cr1> = Field::at(8, 1);
const SSM: Field<Cr1> = Field::at(9, 1);
/// BR: the second bus by 16.
const BY_16: u32 = 0b011;
/// CR1 of the gyro, off: mode 0.
pub const CR1_GYRO: Word<Cr1> = Word::ones([MSTR, SSI, SSM]).with(BR, BY_16);
/// CR1 of an encoder, off: mode 1.
pub const CR1_ENCODER: Word<Cr1> = CR1_GYRO.with(CPHA, 1);
/// CR1, added: on.
pub const CR1_ON: Word<Cr1> = Word::ZERO.with(SPE, 1);

/// SR: a byte has come.
pub const RXNE: Field<Sr> = Field::at(0, 1);

/// The clock [Hz].
pub const HZ: u32 = APB2_HZ / 16;

/// From the selection of a device to the first edge, from the last edge to its release, and from there to the next selection
/// [core cycles]: 350 ns for an encoder (tL, tCSn), 40 ns for the gyro.
pub const SELECT_CYCLES: u32 = (CORE_HZ / 1_000_000 * 350).div_ceil(1_000);

/// Core cycles of a byte on the wire.
pub const BYTE_CYCLES: u32 = 8 * (CORE_HZ / HZ);

/// Looks for a byte after which the bus is taken to be broken: each takes some cycles, interrupts only make them longer.
pub const MOST_LOOKS: u32 = BYTE_CYCLES;
