//! # What the name of a column says: a role, a wheel, a unit
//!
//! Names are taken to words (`m1SetVel [rpm]` is `m`, `1`, `set`, `vel`, `rpm`); words decide, never the order of columns.

use super::words::{UNITS, Words, words_of};
use crate::log::target::Target;

/// What a column is, by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Role {
    Time,
    X,
    Y,
    Heading,
    Battery,
    Gyro,
    /// Commanded of a wheel, and the name does not say whether a voltage or a speed.
    Command,
    /// Commanded voltage or duty of a motor.
    Drive,
    /// Commanded speed of a wheel.
    SetSpeed,
    Current,
    Speed,
}

/// A name, read.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Name {
    pub role: Option<Role>,
    /// Which wheel it is of, as the name has it: a number or a word.
    pub wheel: Option<String>,
    /// The name without the wheel: what the columns of one group share.
    pub stem: String,
    /// The unit that it states, in the spelling of mappings; `counts` where it counts.
    pub unit: Option<&'static str>,
    /// Whether it is a name that needs no mapping.
    pub is_a_runs_own: bool,
}

/// Words for the places of wheels.
const PLACES: [&str; 22] = [
    "fl", "fr", "rl", "rr", "bl", "br", "lf", "rf", "lr", "lb", "rb", "front", "rear", "back", "left", "right",
    "north", "south", "east", "west", "a", "b",
];

const TIME: [&str; 8] = ["t", "time", "timestamp", "stamp", "ts", "clock", "zeit", "uptime"];
const SET: [&str; 13] = [
    "set",
    "cmd",
    "command",
    "commanded",
    "ref",
    "reference",
    "target",
    "des",
    "desired",
    "goal",
    "setpoint",
    "sp",
    "demand",
];
const SPEED: [&str; 14] = [
    "w",
    "vel",
    "velocity",
    "velocities",
    "speed",
    "speeds",
    "omega",
    "rpm",
    "enc",
    "encoder",
    "ticks",
    "counts",
    "count",
    "wheel",
];
const CURRENT: [&str; 7] = ["i", "cur", "curr", "current", "currents", "amp", "amps"];
const DRIVE: [&str; 8] = ["u", "volt", "volts", "voltage", "voltages", "pwm", "duty", "dutycycle"];
const HEADING: [&str; 11] =
    ["theta", "th", "yaw", "heading", "phi", "psi", "ang", "angle", "orientation", "rot", "rotation"];
const BATTERY: [&str; 8] = ["bat", "batt", "battery", "vbat", "vbatt", "vbus", "supply", "vin"];
const POSITION: [&str; 13] = [
    "pos",
    "position",
    "pose",
    "translation",
    "transform",
    "transforms",
    "cam",
    "camera",
    "vision",
    "mocap",
    "robot",
    "world",
    "global",
];
/// Words of what no mapping asks for.
const OTHER: [&str; 21] = [
    "covariance",
    "acc",
    "accel",
    "acceleration",
    "linear",
    "mag",
    "temperature",
    "temp",
    "layout",
    "error",
    "err",
    "effort",
    "quaternion",
    "percentage",
    "cell",
    "charge",
    "capacity",
    "status",
    "health",
    "technology",
    "present",
];

impl Name {
    /// The same in a message whose definition has lengths in this unit and all else in SI units, where the name states no
    /// other.
    pub fn by_definition(mut self, length: &'static str) -> Name {
        let own = match self.role {
            Some(Role::X | Role::Y) => Some(length),
            Some(Role::Heading) => Some("rad"),
            Some(Role::Gyro | Role::Speed | Role::SetSpeed) => Some("rad/s"),
            Some(Role::Battery) => Some("V"),
            _ => None,
        };
        self.unit = self.unit.or(own);
        self
    }
}

/// Reads a name; `of` is what the table itself is called, such as a topic.
pub(super) fn read(name: &str, of: &str) -> Name {
    let (mut words, bracketed) = words_of(name);
    let mut unit = None;
    // a unit stands behind: `speed_rpm`, `x [mm]`; rad_s and deg/s are two words
    if let [.., per, "s"] = words.iter().map(String::as_str).collect::<Vec<_>>().as_slice()
        && let Some(of_rate) = [("rad", "rad/s"), ("deg", "deg/s")].iter().find(|(word, _)| word == per)
    {
        unit = Some(of_rate.1);
        words.truncate(words.len() - 2);
    } else if words.len() > 1
        && let Some((_, known)) = words.last().and_then(|last| UNITS.iter().find(|(word, _)| word == last))
        // `speed_a` is of wheel a
        && (*known != "A" || CURRENT.contains(&words[0].as_str()) || words.iter().any(|word| word.bytes().all(|b| b.is_ascii_digit())))
    {
        unit = Some(*known);
        // what is counted is a role too
        if *known != "counts" && *known != "rpm" {
            words.pop();
        }
    } else if words.len() == 1 {
        unit = UNITS.iter().find(|(word, _)| *word == words[0] && word.len() > 1).map(|(_, unit)| *unit);
    }
    let wheel = bracketed.or_else(|| take_wheel(&mut words));
    let context = words_of(of).0;
    let mut role = wheel.as_ref().and_then(|_| of_wheel(&words, unit)).or_else(|| of_body(&words, unit));
    let both: Vec<String> = context.iter().chain(&words).cloned().collect();
    if role.is_none() && wheel.is_some() {
        role = of_wheel(&both, unit);
    }
    if role.is_none() && Words(&words).any(&["voltage", "volts"]) && Words(&context).hold(&BATTERY) {
        role = Some(Role::Battery);
    }
    Name { role, wheel, stem: words.join("_"), unit, is_a_runs_own: Target::named(name).is_some() }
}

/// What a column that names a wheel is.
fn of_wheel(words: &[String], unit: Option<&str>) -> Option<Role> {
    let words = Words(words);
    match unit {
        // what stands in brackets there is a frame
        _ if words.0.is_empty() || words.any(&OTHER) || words.any(&["transform", "transforms"]) => None,
        Some("A" | "mA") => Some(Role::Current),
        _ if words.hold(&CURRENT) => Some(Role::Current),
        Some("V" | "mV") => Some(Role::Drive),
        _ if words.hold(&DRIVE) => Some(Role::Drive),
        Some("rad/s" | "deg/s" | "rpm") if words.hold(&SET) => Some(Role::SetSpeed),
        _ if words.hold(&SET) && words.hold(&SPEED) => Some(Role::SetSpeed),
        _ if words.hold(&SET) => Some(Role::Command),
        Some("rad/s" | "deg/s" | "rpm" | "counts") => Some(Role::Speed),
        _ if words.hold(&SPEED) || words.any(&["v"]) => Some(Role::Speed),
        _ => None,
    }
}

/// What a column of the robot as a whole is.
fn of_body(words: &[String], unit: Option<&str>) -> Option<Role> {
    let (all, words) = (words, Words(words));
    if all.is_empty() || words.any(&OTHER) {
        return None;
    }
    if words.hold(&BATTERY) {
        return Some(Role::Battery);
    }
    let axis = words.last();
    let turns = words.hold(&["gyro", "gyr", "yawrate"]) || words.any(&["wz", "gz"]);
    let turns_about =
        words.any(&["angular", "omega"]) && axis == "z" || words.any(&["yaw"]) && words.hold(&["rate", "vel"]);
    if turns || turns_about {
        return (!matches!(axis, "x" | "y")).then_some(Role::Gyro);
    }
    let is_time = all.iter().all(|word| TIME.contains(&word.as_str()) || ["header", "log"].contains(&word.as_str()));
    let in_time = matches!(unit, Some("s" | "ms" | "us" | "ns"));
    if is_time || in_time && (words.any(&TIME) || all.len() == 1 && is_unit_of_time(&all[0])) {
        return Some(Role::Time);
    }
    let turned = words.any(&["orientation", "rotation", "quaternion"]);
    if turned && matches!(axis, "x" | "y" | "z" | "w") || words.hold(&["vel", "speed", "twist"]) || words.hold(&SET) {
        return None;
    }
    let others: Vec<&String> = all.iter().filter(|word| !POSITION.contains(&word.as_str())).collect();
    let is = |letter: &str| {
        let with = ["pos", "p", ""].map(|part| [format!("{letter}{part}"), format!("{part}{letter}")]).concat();
        others.first().is_some_and(|word| with.contains(word)) && others.len() == 1
    };
    match () {
        () if is("x") => Some(Role::X),
        () if is("y") => Some(Role::Y),
        () if words.any(&HEADING) => Some(Role::Heading),
        // an angle of what a camera sees
        () if others.is_empty() && matches!(unit, Some("deg" | "rad")) => Some(Role::Heading),
        () => None,
    }
}

fn is_unit_of_time(word: &str) -> bool {
    UNITS.iter().any(|(known, unit)| *known == word && matches!(*unit, "s" | "ms" | "us" | "ns"))
}

/// Takes the word that says which wheel out of a name.
fn take_wheel(words: &mut Vec<String>) -> Option<String> {
    let number = words.iter().rposition(|word| word.bytes().all(|byte| byte.is_ascii_digit()));
    let place = || (words.len() > 1).then(|| words.iter().rposition(|word| PLACES.contains(&word.as_str()))).flatten();
    let at = number.or_else(place)?;
    let mut wheel = words.remove(at);
    // `front_left` is one place
    if at > 0 && PLACES.contains(&wheel.as_str()) && PLACES.contains(&words[at - 1].as_str()) {
        wheel = format!("{}_{wheel}", words.remove(at - 1));
    }
    Some(wheel)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(name: &str) -> (Option<Role>, Option<String>, Option<&'static str>) {
        let name = read(name, "");
        (name.role, name.wheel, name.unit)
    }

    #[test]
    fn names_of_many_tools_are_understood() {
        let wheel = |wheel: &str| Some(wheel.to_owned());
        for (name, role, of, unit) in [
            ("t", Role::Time, None, None),
            ("Timestamp [ms]", Role::Time, None, Some("ms")),
            ("time_us", Role::Time, None, Some("us")),
            ("header.stamp", Role::Time, None, None),
            ("m1setvel", Role::SetSpeed, wheel("1"), None),
            ("m3cur", Role::Current, wheel("3"), None),
            ("motor2_current_mA", Role::Current, wheel("2"), Some("mA")),
            ("wheelSpeed_FL_rpm", Role::Speed, wheel("fl"), Some("rpm")),
            ("enc4", Role::Speed, wheel("4"), None),
            ("ticks_1", Role::Speed, wheel("1"), None),
            ("velocity[front_left]", Role::Speed, wheel("front_left"), None),
            ("duty3", Role::Drive, wheel("3"), None),
            ("u1", Role::Drive, wheel("1"), None),
            ("w2 (rad/s)", Role::Speed, wheel("2"), Some("rad/s")),
            ("xpos", Role::X, None, None),
            ("cam_y_mm", Role::Y, None, Some("mm")),
            ("pose.pose.position.x", Role::X, None, None),
            ("transforms[base].transform.translation.y", Role::Y, None, None),
            ("pose.orientation.yaw", Role::Heading, None, None),
            ("ang", Role::Heading, None, None),
            ("phi_rad", Role::Heading, None, Some("rad")),
            ("cam_deg", Role::Heading, None, Some("deg")),
            ("battery_voltage", Role::Battery, None, None),
            ("angular_velocity.z", Role::Gyro, None, None),
            ("gyro_z_deg_s", Role::Gyro, None, Some("deg/s")),
        ] {
            let (told_role, told_wheel, told_unit) = told(name);
            assert_eq!(told_role, Some(role), "{name}");
            if role != Role::Y && role != Role::X {
                assert_eq!(told_wheel, of, "{name}");
            }
            assert_eq!(told_unit, unit, "{name}");
        }
    }

    #[test]
    fn what_no_mapping_asks_for_has_no_role() {
        for name in [
            "pose.orientation.x",
            "linear_acceleration.x",
            "twist.twist.linear.x",
            "layout.data_offset",
            "temp1",
            "gyro_x",
            "joint_deg",
            "target_x",
            "pose.covariance[3]",
            "power_supply_status",
            "transforms[arm].transform.rotation.w",
            "transforms[arm].header.stamp",
        ] {
            assert_eq!(told(name).0, None, "{name}");
        }
    }

    #[test]
    fn a_topic_says_what_a_list_of_its_numbers_is() {
        assert_eq!(read("data[0]", "/motor_voltages").role, Some(Role::Drive));
        assert_eq!(read("data[1]", "/wheel_cmd_speed").role, Some(Role::SetSpeed));
        assert_eq!(read("data[1]", "/cmd").role, Some(Role::Command));
        assert_eq!(read("data[1]", "/unknown").role, None);
        assert_eq!(read("voltage", "/battery").role, Some(Role::Battery));
    }
}
