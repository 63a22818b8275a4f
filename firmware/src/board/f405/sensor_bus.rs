//! # Sensor bus: SPI1 with a chip select for each device
//!
//! A byte is waited for, 1.5 µs: whoever reads sensors is below the turns of currents and motion, and an interrupt between two
//! bytes only makes a transfer longer, because the clock is this side's. A wait ends after [`spi::MOST_LOOKS`].

use cortex_m::asm;
use embedded_hal::spi::{ErrorKind, ErrorType, Operation, SpiDevice};
use stm32f4xx_hal::gpio::gpiod::PDn;
use stm32f4xx_hal::gpio::{Output, PinExt};
use stm32f4xx_hal::pac::{self, spi1};

use super::typed::{Get, Put};
use crate::drivers::sensors::Sensors;
use crate::registers::spi;
use crate::registers::words::Word;

/// Gyro and encoders.
pub type MotionSensors = Sensors<SensorDevice>;

/// A device on the bus.
pub struct SensorDevice {
    _select: PDn<Output>,
    /// Its pin of port D, a bit
    pin: u32,
    /// CR1 of its mode, off
    mode: Word<spi::Cr1>,
}

impl SensorDevice {
    /// All of them have to go to one owner: each takes the bus for a transfer as if it were its own.
    pub(super) fn new(select: PDn<Output>, mode: Word<spi::Cr1>) -> Self {
        let pin = 1 << (select.pin_id() & 15);
        Self { _select: select, pin, mode }
    }

    fn run(operation: &mut Operation<'_, u8>) -> Result<(), ErrorKind> {
        match operation {
            Operation::Write(out) => out.iter().try_for_each(|byte| exchange(*byte).map(|_| ())),
            Operation::TransferInPlace(both) => {
                both.iter_mut().try_for_each(|byte| exchange(*byte).map(|came| *byte = came))
            }
            // neither device's driver asks for these
            Operation::Read(_) | Operation::Transfer(..) | Operation::DelayNs(_) => Err(ErrorKind::Other),
        }
    }
}

impl ErrorType for SensorDevice {
    type Error = ErrorKind;
}

impl SpiDevice for SensorDevice {
    fn transaction(&mut self, operations: &mut [Operation<'_, u8>]) -> Result<(), ErrorKind> {
        set_mode(self.mode);
        set_levels(self.pin << 16);
        asm::delay(spi::SELECT_CYCLES);
        let done = operations.iter_mut().try_for_each(Self::run);
        asm::delay(spi::SELECT_CYCLES);
        set_levels(self.pin);
        asm::delay(spi::SELECT_CYCLES);
        done
    }
}

fn bus() -> &'static spi1::RegisterBlock {
    // SAFETY: `take` has the one SPI1 and gives it to nobody; its registers are used here alone, by the devices, which have
    // one owner.
    unsafe { &*pac::SPI1::PTR }
}

/// BSRR of port D: ones in the upper half make pins low, in the lower half high; zeros leave theirs.
fn set_levels(bits: u32) {
    // SAFETY: one store that changes no pin but that of the device, which owns it.
    unsafe { (*pac::GPIOD::PTR).bsrr().write(|w| w.bits(bits)) };
}

/// Clock phase and polarity change while the bus is off and nothing is selected.
fn set_mode(mode: Word<spi::Cr1>) {
    bus().cr1().put(mode);
    bus().cr1().put(mode | spi::CR1_ON);
}

/// Sends a byte; the one that came with it.
fn exchange(byte: u8) -> Result<u8, ErrorKind> {
    bus().dr().write(|w| w.dr().set(u16::from(byte)));
    for _ in 0..spi::MOST_LOOKS {
        if bus().sr().get().has(spi::RXNE) {
            return Ok(bus().dr().read().dr().bits() as u8);
        }
    }
    Err(ErrorKind::Other)
}
