//! # AS5047P: a magnetic encoder of 14 bits a turn, over SPI
//!
//! Frames have 16 bits, high byte first, each with the chip selected anew. The answer to a frame comes with the next one.
//!
//! ```text
//! to it     parity | read | address 14 bits
//! from it   parity | error flag | data 14 bits         parity makes the ones of a frame even
//! ```
//!
//! | register | address | here |
//! |---|---|---|
//! | ERRFL | 0x0001 | what the error flag was set for; reading it clears the flag |
//! | DIAAGC | 0x3FFC | LF (bit 8) zeros found, COF (9) angle cannot be computed, MAGH (10), MAGL (11) field too strong, too weak |
//! | ANGLECOM | 0x3FFF | the angle, what the turning has changed meanwhile counted in |
//!
//! An encoder that stands at zero answers 0x0000, which is a sound frame and also what a bus says on which nothing answers.
//! So each reading is two frames: one brings DIAAGC, in which LF is set once the encoder works, the other the angle; and all
//! zeros are no DIAAGC. All ones have their error flag set.
//!
//! Clock: 10 MHz at most, mode 1; 350 ns from the selection to the first edge, and as long between two frames. It works 10 ms
//! after its supply is there.
//!
//! Source: ams AS5047P datasheet v1-01 (28 April 2016): SPI transaction, command frame, read data frame, SPI timing (tL, tCSn), volatile
//! register table, ERRFL and DIAAGC, power-on time.

use embedded_hal::spi::SpiDevice;
use model_core::link::sensor_codes::ENCODER_COUNTS;

use super::sensor_error::SensorError;

/// Angles in a turn.
pub const COUNTS: u16 = ENCODER_COUNTS;

const ERRFL: u16 = 0x0001;
const DIAAGC: u16 = 0x3FFC;
const ANGLECOM: u16 = 0x3FFF;

const READ: u16 = 1 << 14;
const ERROR_FLAG: u16 = 1 << 14;
const DATA: u16 = COUNTS - 1;
/// DIAAGC: LF, COF, MAGH, MAGL.
const FLAGS: u16 = 0x0F00;
/// Of these, those of an encoder that works.
const WORKS: u16 = 0x0100;

/// The frame that asks for a register.
const fn ask(address: u16) -> u16 {
    let frame = READ | address;
    frame | (frame.count_ones() as u16 & 1) << 15
}

/// An encoder.
#[derive(Debug)]
pub struct As5047p<S>(S);

impl<S: SpiDevice> As5047p<S> {
    /// An encoder that was not spoken to yet.
    pub fn new(spi: S) -> Self {
        Self(spi)
    }

    /// Clears what an earlier frame may have left, and asks for what the first reading begins with.
    ///
    /// # Errors
    /// [`SensorError`] where the bus fails; what the encoder says is looked at by [`Self::angle`].
    pub fn begin(&mut self) -> Result<(), SensorError> {
        self.frame(ask(ERRFL))?;
        // its answer is ERRFL, with the flag as it was before: neither is of interest
        self.frame(ask(DIAAGC)).map(|_| ())
    }

    /// The angle [1/16384 turn], counted as the magnet turns clockwise seen from above the chip. A reading that fails has to be
    /// followed by [`Self::begin`].
    ///
    /// # Errors
    /// [`SensorError`] where the frames are not those of an encoder that works and sees its magnet.
    pub fn angle(&mut self) -> Result<u16, SensorError> {
        let state = data(self.frame(ask(ANGLECOM))?)?;
        if state & FLAGS != WORKS {
            return Err(SensorError::Field { field: "DIAAGC", is: state });
        }
        data(self.frame(ask(DIAAGC))?)
    }

    /// Sends a frame; what came with it.
    fn frame(&mut self, frame: u16) -> Result<u16, SensorError> {
        let mut bytes = frame.to_be_bytes();
        self.0.transfer_in_place(&mut bytes).map_err(|_| SensorError::Bus)?;
        Ok(u16::from_be_bytes(bytes))
    }
}

/// The data of a frame.
fn data(frame: u16) -> Result<u16, SensorError> {
    if !frame.count_ones().is_multiple_of(2) {
        return Err(SensorError::Field { field: "PARD", is: frame });
    }
    if frame & ERROR_FLAG != 0 {
        return Err(SensorError::Field { field: "EF", is: frame });
    }
    Ok(frame & DATA)
}
