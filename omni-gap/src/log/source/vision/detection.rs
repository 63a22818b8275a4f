//! Messages of SSL-Vision, as far as they tell where robots are: numbers of fields are those of its definitions.

use std::fmt;

/// What one packet of the network holds: what a camera saw, or the geometry of the field.
#[derive(Clone, PartialEq, prost::Message)]
pub(super) struct WrapperPacket {
    #[prost(message, optional, tag = "1")]
    pub detection: Option<DetectionFrame>,
}

/// What one camera saw at one instant.
#[derive(Clone, PartialEq, prost::Message)]
pub(super) struct DetectionFrame {
    #[prost(uint32, optional, tag = "1")]
    pub frame_number: Option<u32>,
    /// When the picture came from the camera (s, by the clock of the computer that looks at it).
    #[prost(double, optional, tag = "2")]
    pub t_capture: Option<f64>,
    /// When the packet was sent (s, by the same clock).
    #[prost(double, optional, tag = "3")]
    pub t_sent: Option<f64>,
    #[prost(uint32, optional, tag = "4")]
    pub camera_id: Option<u32>,
    #[prost(message, repeated, tag = "6")]
    pub robots_yellow: Vec<DetectionRobot>,
    #[prost(message, repeated, tag = "7")]
    pub robots_blue: Vec<DetectionRobot>,
}

/// One robot in it.
#[derive(Clone, PartialEq, prost::Message)]
pub(super) struct DetectionRobot {
    /// From 0 to 1.
    #[prost(float, optional, tag = "1")]
    pub confidence: Option<f32>,
    #[prost(uint32, optional, tag = "2")]
    pub robot_id: Option<u32>,
    /// Place on the field (mm).
    #[prost(float, optional, tag = "3")]
    pub x: Option<f32>,
    #[prost(float, optional, tag = "4")]
    pub y: Option<f32>,
    /// Heading (rad).
    #[prost(float, optional, tag = "5")]
    pub orientation: Option<f32>,
}

/// A team, by the colour of its markers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Team {
    Yellow,
    Blue,
}

/// Which robot: its team, and the number of its pattern.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct RobotName {
    pub team: Team,
    pub id: u32,
}

impl RobotName {
    /// The robot that a topic names: `yellow/3`, `blue/0`.
    pub fn of(topic: &str) -> Option<RobotName> {
        let (team, id) = topic.split_once('/')?;
        let team = match team {
            "yellow" => Team::Yellow,
            "blue" => Team::Blue,
            _ => return None,
        };
        let is_number = id.bytes().all(|byte| byte.is_ascii_digit());
        Some(RobotName { team, id: id.parse().ok().filter(|_| is_number)? })
    }
}

impl fmt::Display for RobotName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let team = match self.team {
            Team::Yellow => "yellow",
            Team::Blue => "blue",
        };
        write!(f, "{team}/{}", self.id)
    }
}

impl DetectionFrame {
    /// The robots in it that have a name.
    pub fn robots<'a>(&'a self) -> impl Iterator<Item = (RobotName, &'a DetectionRobot)> {
        let of = |team, robots: &'a [DetectionRobot]| {
            robots.iter().filter_map(move |robot| Some((RobotName { team, id: robot.robot_id? }, robot)))
        };
        of(Team::Yellow, &self.robots_yellow).chain(of(Team::Blue, &self.robots_blue))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_topic_names_a_robot_or_none() {
        let blue = RobotName { team: Team::Blue, id: 11 };
        assert_eq!(RobotName::of("blue/11"), Some(blue));
        assert_eq!(blue.to_string(), "blue/11");
        for other in ["blue", "blue/", "green/1", "yellow3", "/yellow/3", "blue/+1", "blue/-1", "blue/99999999999"] {
            assert_eq!(RobotName::of(other), None, "{other}");
        }
    }
}
