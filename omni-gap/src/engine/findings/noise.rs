//! What noise the recordings show.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::log::SensorsFile;

/// The noise of one sensor, as it is stated and as it was found.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct ChannelNoise {
    /// `current`, `wheel_speed`, `position`, `heading`, `gyro` or `battery`.
    pub sensor: String,
    /// Its signal group in `gap.signals`.
    pub group: String,
    /// The unit of the two numbers below.
    pub unit: String,
    /// One sigma by the robot file, with what coarse steps add to it.
    pub stated: f64,
    /// One sigma by what the best model leaves over; the stated one where that differs by little.
    pub found: f64,
    /// How long it remembers itself (s); zero for white noise.
    pub correlation_time_s: f64,
}

impl ChannelNoise {
    /// States of the sensor what was found, where that is more.
    pub fn no_quieter(&self, sensors: &mut SensorsFile) {
        if self.found <= self.stated {
            return;
        }
        match self.sensor.as_str() {
            "current" => sensors.current_noise_a = self.found,
            "wheel_speed" => sensors.wheel_speed_noise_rad_s = self.found,
            "position" => sensors.position_noise_m = self.found,
            "heading" => sensors.heading_noise_rad = self.found,
            "gyro" => sensors.gyro_noise_rad_s = Some(self.found),
            "battery" => sensors.battery_noise_v = Some(self.found),
            _ => {}
        }
    }
}
