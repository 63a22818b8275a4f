//! The signals that are compared, and what they are called.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::simulate::{Channels, SignalGroup};

/// A signal; its name in files carries its unit, as in the logs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, JsonSchema, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
#[schemars(with = "String")]
pub enum Signal {
    /// Forward speed of the body, v [m/s]
    V,
    /// Sideways speed of the body, vn [m/s]
    Vn,
    /// Yaw rate of the body, ω [rad/s]
    Omega,
    /// Speed of a wheel at its shaft [rad/s]
    WheelSpeed(usize),
    /// Current of a motor [A]
    Current(usize),
    /// Position in the world [m]
    X,
    /// Position in the world [m]
    Y,
    /// Heading in the world [rad]
    Heading,
    /// Yaw rate by the gyro [rad/s]
    Gyro,
    /// What the load takes off the bus voltage [V]
    Battery,
}

const PLAIN: [(Signal, &str); 8] = [
    (Signal::V, "v_m_s"),
    (Signal::Vn, "vn_m_s"),
    (Signal::Omega, "omega_rad_s"),
    (Signal::X, "x_m"),
    (Signal::Y, "y_m"),
    (Signal::Heading, "theta_rad"),
    (Signal::Gyro, "gyro_rad_s"),
    (Signal::Battery, "vbat_V"),
];

impl Signal {
    /// The body's speeds.
    pub const AXES: [Signal; 3] = [Signal::V, Signal::Vn, Signal::Omega];

    /// Its SI unit.
    pub fn unit(self) -> &'static str {
        match self {
            Signal::V | Signal::Vn => "m/s",
            Signal::Omega | Signal::WheelSpeed(_) | Signal::Gyro => "rad/s",
            Signal::Current(_) => "A",
            Signal::X | Signal::Y => "m",
            Signal::Heading => "rad",
            Signal::Battery => "V",
        }
    }

    /// Whether it is a place, which sums up every error of speed since the start.
    pub fn is_pose(self) -> bool {
        matches!(self, Signal::X | Signal::Y | Signal::Heading)
    }

    /// The signal of a channel of a recording with this many wheels.
    pub fn of_channel(channel: usize, wheels: usize) -> Signal {
        let channels = Channels { wheels };
        let (group, at) = (channels.group(channel), channel - channels.of(channels.group(channel)).start);
        match group {
            SignalGroup::Current => Signal::Current(at),
            SignalGroup::WheelSpeed => Signal::WheelSpeed(at),
            SignalGroup::Pose => [Signal::X, Signal::Y, Signal::Heading][at.min(2)],
            SignalGroup::Gyro => Signal::Gyro,
            SignalGroup::Battery => Signal::Battery,
        }
    }
}

impl From<Signal> for String {
    fn from(signal: Signal) -> String {
        match signal {
            Signal::WheelSpeed(j) => format!("w{j}_rad_s"),
            Signal::Current(j) => format!("i{j}_A"),
            plain => PLAIN.iter().find(|(s, _)| *s == plain).map_or("", |(_, name)| name).to_owned(),
        }
    }
}

impl TryFrom<String> for Signal {
    type Error = String;

    fn try_from(name: String) -> Result<Signal, String> {
        let wheel = |stem: char, unit: &str| name.strip_prefix(stem)?.strip_suffix(unit)?.parse().ok();
        let plain = PLAIN.iter().find(|(_, n)| *n == name).map(|(s, _)| *s);
        plain
            .or_else(|| wheel('w', "_rad_s").map(Signal::WheelSpeed))
            .or_else(|| wheel('i', "_A").map(Signal::Current))
            .ok_or_else(|| format!("`{name}` is no signal"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_signal_comes_back_from_its_name() {
        for channel in 0..(Channels { wheels: 4 }).count() {
            let signal = Signal::of_channel(channel, 4);
            assert_eq!(Signal::try_from(String::from(signal)), Ok(signal));
        }
        for axis in Signal::AXES {
            assert_eq!(Signal::try_from(String::from(axis)), Ok(axis));
        }
        assert!(Signal::try_from("w_rad_s".to_owned()).is_err());
    }
}
