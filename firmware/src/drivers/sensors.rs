//! # Sensors: one gyro and an encoder a wheel, kept at work
//!
//! A sensor that does not answer as it should costs its own reading and nothing else. It is begun with anew, at once for the
//! first time and every 0.1 s from then on: at the start the sensors take longer to come up than the processor,
//! and one whose plug is put back in comes back.

use embedded_hal::spi::SpiDevice;
use model_core::link::record::MOTORS;
use model_core::link::sensor_codes::SensorCodes;

use super::as5047p::As5047p;
use super::bmi088::Bmi088Gyro;
use super::sensor_error::SensorError;

/// Turns from one try to begin to the next, 0.1 s; longer than either sensor takes to come up.
pub const RETRY: u8 = 100;

/// Which sensors the robot has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FittedSensors {
    /// A gyro
    pub gyro: bool,
    /// Encoders, at so many motors from the first one on
    pub encoders: u8,
}

/// The sensors at the SPI.
#[derive(Debug)]
pub struct Sensors<S> {
    gyro: Bmi088Gyro<S>,
    encoders: [As5047p<S>; MOTORS],
    gyro_state: State,
    encoder_states: [State; MOTORS],
}

/// Where a sensor is.
#[derive(Clone, Copy, Debug)]
struct State {
    /// It was begun with, and has answered since
    works: bool,
    /// Turns until it is begun with
    wait: u8,
}

impl State {
    const NEW: Self = Self { works: false, wait: 0 };

    /// A turn: begins where that is due, and then reads; `None` where that fails or nothing is due.
    fn turn<D, T>(
        &mut self,
        device: &mut D,
        begin: fn(&mut D) -> Result<(), SensorError>,
        read: fn(&mut D) -> Result<T, SensorError>,
    ) -> Option<T> {
        if !self.works {
            if self.wait > 0 {
                self.wait -= 1;
                return None;
            }
            self.wait = RETRY - 1;
            begin(device).ok()?;
        }
        let reading = read(device).ok();
        self.works = reading.is_some();
        reading
    }
}

impl<S: SpiDevice> Sensors<S> {
    /// Sensors that were not spoken to yet, each at its own chip select.
    pub fn new(gyro: S, encoders: [S; MOTORS]) -> Self {
        Self {
            gyro: Bmi088Gyro::new(gyro),
            encoders: encoders.map(As5047p::new),
            gyro_state: State::NEW,
            encoder_states: [State::NEW; MOTORS],
        }
    }

    /// What those that are fitted say now.
    pub fn read(&mut self, fitted: FittedSensors) -> SensorCodes {
        let mut yaw = None;
        if fitted.gyro {
            yaw = self.gyro_state.turn(&mut self.gyro, Bmi088Gyro::begin, Bmi088Gyro::rate_z);
        }
        let mut angles = [None; MOTORS];
        let all = self.encoders.iter_mut().zip(&mut self.encoder_states);
        for (angle, (encoder, state)) in angles.iter_mut().zip(all).take(fitted.encoders.into()) {
            *angle = state.turn(encoder, As5047p::begin, As5047p::angle);
        }
        SensorCodes::of(yaw, angles)
    }
}
