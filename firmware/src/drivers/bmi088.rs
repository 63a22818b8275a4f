//! # BMI088: the gyro half of Bosch's inertial sensor, over SPI
//!
//! A read begins with the register's address, bit 7 set, and the bytes of the registers from there on follow; a write is
//! address and byte. The gyro sends no empty byte before its data (the accelerometer, a device of its own, does).
//!
//! | register | address | here |
//! |---|---|---|
//! | GYRO_CHIP_ID | 0x00 | 0x0F |
//! | RATE_X, Y, Z | 0x02 … 0x07 | low byte first, two's complement |
//! | GYRO_RANGE | 0x0F | 0: ±2000 °/s, 16.384 counts to 1 °/s |
//! | GYRO_BANDWIDTH | 0x10 | 2: a sample each ms, filtered at 116 Hz; bit 7 reads as one |
//!
//! A gyro at rest may read 0, and one count below that all ones, so that a rate alone cannot show that anything answers:
//! every reading is a burst from the identifier on, nine bytes, and only one that begins with 0x0F is believed.
//!
//! Clock: 10 MHz at most, mode 0 or 3. It answers 30 ms after its supply is there; who asks earlier gets an error and asks
//! again. Mounted flat with its z axis up, turning left is positive, as in the body's frame.
//!
//! The BMI085's gyro is the same device. Source: Bosch BST-BMI088-DS001, revision 1.4: gyroscope specification, register
//! descriptions 5.5.1 to 5.5.5, serial peripheral interface 6.

use embedded_hal::spi::SpiDevice;

use super::sensor_error::SensorError;

/// Rate of one count [rad/s]: 2000 °/s are 32,768 counts (16.384 to 1 °/s).
pub const RAD_S_PER_COUNT: f32 = core::f32::consts::PI * 2000.0 / 180.0 / 32_768.0;

const READ: u8 = 0x80;
const CHIP_ID: u8 = 0x00;
const RANGE: u8 = 0x0F;
const BANDWIDTH: u8 = 0x10;

/// GYRO_CHIP_ID of this gyro.
const IDENTITY: u8 = 0x0F;
/// GYRO_RANGE: ±2000 °/s.
const RANGE_2000: u8 = 0x00;
/// GYRO_BANDWIDTH: 1000 samples a second, 116 Hz.
const BANDWIDTH_116: u8 = 0x02;
/// The bits of GYRO_BANDWIDTH that can be written.
const BANDWIDTH_BITS: u8 = 0x0F;

/// The gyro.
#[derive(Debug)]
pub struct Bmi088Gyro<S>(S);

impl<S: SpiDevice> Bmi088Gyro<S> {
    /// A gyro that was not spoken to yet.
    pub fn new(spi: S) -> Self {
        Self(spi)
    }

    /// Sets range and bandwidth, and sees that they are set.
    ///
    /// # Errors
    /// [`SensorError`] says what came in place of the right answer.
    pub fn begin(&mut self) -> Result<(), SensorError> {
        self.expect("GYRO_CHIP_ID", CHIP_ID, 0xFF, IDENTITY)?;
        self.write(RANGE, RANGE_2000)?;
        self.write(BANDWIDTH, BANDWIDTH_116)?;
        self.expect("GYRO_RANGE", RANGE, 0xFF, RANGE_2000)?;
        self.expect("GYRO_BANDWIDTH", BANDWIDTH, BANDWIDTH_BITS, BANDWIDTH_116)
    }

    /// Rate about the z axis [counts of [`RAD_S_PER_COUNT`]].
    ///
    /// # Errors
    /// [`SensorError`] where what came does not begin with the gyro's identifier.
    pub fn rate_z(&mut self) -> Result<i16, SensorError> {
        // address, 0x00 to 0x07
        let mut bytes = [READ | CHIP_ID, 0, 0, 0, 0, 0, 0, 0, 0];
        self.0.transfer_in_place(&mut bytes).map_err(|_| SensorError::Bus)?;
        let [_, identity, _, _, _, _, _, low, high] = bytes;
        check("GYRO_CHIP_ID", identity, IDENTITY)?;
        Ok(i16::from_le_bytes([low, high]))
    }

    /// The bits of `mask` in a register are to be these.
    fn expect(&mut self, field: &'static str, address: u8, mask: u8, value: u8) -> Result<(), SensorError> {
        let mut bytes = [READ | address, 0];
        self.0.transfer_in_place(&mut bytes).map_err(|_| SensorError::Bus)?;
        let [_, is] = bytes;
        check(field, is & mask, value)
    }

    fn write(&mut self, address: u8, value: u8) -> Result<(), SensorError> {
        self.0.write(&[address, value]).map_err(|_| SensorError::Bus)
    }
}

fn check(field: &'static str, is: u8, should: u8) -> Result<(), SensorError> {
    if is == should { Ok(()) } else { Err(SensorError::Field { field, is: u16::from(is) }) }
}
