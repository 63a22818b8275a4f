//! The table of channels: everything that is measured and compared with a model, in which group, in which order of a row.
//!
//! | group | channels | unit | how a model says it |
//! |---|---|---|---|
//! | `i` | one a wheel | A | current sensor of each motor |
//! | `w` | one a wheel | rad/s | encoder at each wheel's shaft |
//! | `pose` | x, y, heading | m, m, rad | camera |
//! | `gyro` | one | rad/s | yaw rate |
//! | `vbat` | one | V | bus voltage under load, less that of the same battery without |
//!
//! What a battery holds is a matter of the day, so the bus voltage is compared by what the load takes off it. Gaps are
//! totals over the groups that every simulator has, `i`, `w` and `pose`; the others are fitted and told beside them.

use std::ops::Range;

/// The most channels of a row: those of a robot with four wheels.
pub const MAX_CHANNELS: usize = Channels { wheels: 4 }.count();

/// One row of numbers, one a channel.
pub type Row = [f64; MAX_CHANNELS];

/// Signals that a gap is told of together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SignalGroup {
    /// Motor currents.
    Current,
    /// Wheel speeds.
    WheelSpeed,
    /// Position and heading.
    Pose,
    /// Yaw rate.
    Gyro,
    /// What the load takes off the bus voltage.
    Battery,
}

impl SignalGroup {
    /// All groups, in the order of their channels.
    pub const ALL: [SignalGroup; 5] = [Self::Current, Self::WheelSpeed, Self::Pose, Self::Gyro, Self::Battery];

    /// How many groups there are.
    pub const COUNT: usize = Self::ALL.len();

    /// Its name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Current => "i",
            Self::WheelSpeed => "w",
            Self::Pose => "pose",
            Self::Gyro => "gyro",
            Self::Battery => "vbat",
        }
    }

    /// Whether it counts in totals; a group that does not is judged by itself.
    pub const fn in_totals(self) -> bool {
        matches!(self, Self::Current | Self::WheelSpeed | Self::Pose)
    }

    /// How many channels it has on a robot with so many wheels.
    const fn width(self, wheels: usize) -> usize {
        match self {
            Self::Current | Self::WheelSpeed => wheels,
            Self::Pose => 3,
            Self::Gyro | Self::Battery => 1,
        }
    }
}

/// One number for each group.
pub type PerGroup<T> = [T; SignalGroup::COUNT];

/// Where the channels stand in a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Channels {
    /// Wheels.
    pub wheels: usize,
}

impl Channels {
    /// How many channels a row has.
    pub const fn count(self) -> usize {
        self.of(SignalGroup::Battery).end
    }

    /// The channels of a group.
    pub const fn of(self, group: SignalGroup) -> Range<usize> {
        let (mut first, mut k) = (0, 0);
        while k < group as usize {
            first += SignalGroup::ALL[k].width(self.wheels);
            k += 1;
        }
        first..first + group.width(self.wheels)
    }

    /// The channels of a group, as a bit mask.
    pub(crate) fn mask(self, group: SignalGroup) -> u16 {
        self.of(group).fold(0, |mask, channel| mask | 1 << channel)
    }

    /// The group of a channel.
    pub const fn group(self, channel: usize) -> SignalGroup {
        let mut k = 0;
        while k + 1 < SignalGroup::COUNT && channel >= self.of(SignalGroup::ALL[k]).end {
            k += 1;
        }
        SignalGroup::ALL[k]
    }

    /// The current of a wheel's motor.
    pub const fn current(self, wheel: usize) -> usize {
        self.of(SignalGroup::Current).start + wheel
    }

    /// The speed of a wheel.
    pub const fn wheel_speed(self, wheel: usize) -> usize {
        self.of(SignalGroup::WheelSpeed).start + wheel
    }

    /// x, y and the heading.
    pub const fn pose(self) -> [usize; 3] {
        let first = self.of(SignalGroup::Pose).start;
        [first, first + 1, first + 2]
    }

    /// The heading, whose errors count modulo a turn.
    pub const fn heading(self) -> usize {
        self.pose()[2]
    }

    /// The yaw rate.
    pub const fn gyro(self) -> usize {
        self.of(SignalGroup::Gyro).start
    }

    /// What the load takes off the bus voltage.
    pub const fn battery(self) -> usize {
        self.of(SignalGroup::Battery).start
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_channel_is_in_the_group_that_has_it_and_none_is_in_two() {
        for wheels in [3, 4] {
            let channels = Channels { wheels };
            let all: Vec<usize> = SignalGroup::ALL.into_iter().flat_map(|group| channels.of(group)).collect();
            assert_eq!(all, (0..channels.count()).collect::<Vec<_>>());
            for group in SignalGroup::ALL {
                assert!(channels.of(group).all(|channel| channels.group(channel) == group), "{group:?}");
            }
            assert!(channels.count() <= MAX_CHANNELS);
        }
    }

    #[test]
    fn channels_stand_where_their_names_say() {
        let channels = Channels { wheels: 3 };
        assert_eq!((channels.current(2), channels.wheel_speed(0), channels.pose()), (2, 3, [6, 7, 8]));
        assert_eq!((channels.heading(), channels.gyro(), channels.battery(), channels.count()), (8, 9, 10, 11));
    }
}
