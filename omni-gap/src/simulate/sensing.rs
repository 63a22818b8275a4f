//! How a robot is measured: as the paper measured, as a modern robot does, and with hall sensors alone.

use super::record::{SensorSetup, SpeedSensor};
use crate::log::SensorsFile;

/// A way of measuring.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sensing {
    /// An overhead camera at 25 frames a second, 1 cm and 3°, and the drive's currents; no wheel speeds.
    Paper,
    /// Rows at 1 kHz with encoders, a camera at 80 frames a second, 2 mm and 0.5°.
    Modern,
    /// The same with wheel speeds from the edges of hall sensors alone.
    Halls,
}

/// Edges of three hall sensors in a turn of the wheel: six a pole pair, eight pole pairs, a gear of five.
const HALL_EDGES: f64 = 240.0;

impl Sensing {
    /// All of them.
    pub const ALL: [Sensing; 3] = [Self::Paper, Self::Modern, Self::Halls];

    /// Its name on the command line.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Modern => "modern",
            Self::Halls => "halls",
        }
    }

    /// Rows a second [1/s]
    pub const fn rate(self) -> f64 {
        match self {
            Self::Paper => 25.0,
            Self::Modern | Self::Halls => 1000.0,
        }
    }

    /// How recordings are made so: plant steps of 0.25 ms, ten times shorter than the longest of a fit.
    pub fn recording(self) -> SensorSetup {
        let modern = SensorSetup {
            steps_a_row: 4,
            camera_rate: 80.0,
            dropouts: 0.03,
            sensors: SensorsFile {
                current_noise_a: 0.02,
                wheel_speed_noise_rad_s: 0.15,
                position_noise_m: 0.002,
                heading_noise_rad: 0.5_f64.to_radians(),
                ..SensorsFile::SILENT
            },
            speed: SpeedSensor::Encoder,
            ..SensorSetup::default()
        };
        match self {
            Self::Paper => SensorSetup {
                steps_a_row: 160,
                camera_rate: 25.0,
                dropouts: 0.0,
                sensors: SensorsFile { position_noise_m: 0.01, heading_noise_rad: 3f64.to_radians(), ..modern.sensors },
                speed: SpeedSensor::None,
                ..modern
            },
            Self::Modern => modern,
            Self::Halls => SensorSetup { speed: SpeedSensor::Halls { edges_per_turn: HALL_EDGES }, ..modern },
        }
    }
}
