//! What noise the recordings show.

use serde::{Deserialize, Serialize};

/// The noise of one sensor, as it is stated and as it was found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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
