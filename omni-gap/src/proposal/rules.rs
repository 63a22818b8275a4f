//! # From what was found to the rules of a mapping

use super::beside::Beside;
use super::doubt::{Certainty, Found};
use super::groups::{Groups, Place};
use super::logs::LoggedRun;
use super::motion::Motion;
use super::rule::Rule;
use super::series::largest;
use super::units::{self, Conversion};
use super::wheels::{NO_OFFSET_RAD, OFF_RAD, Scales, Wheels};
use crate::log::target::Target;
use crate::log::{RobotFile, permutations};
use std::f64::consts::{FRAC_PI_2, TAU};

/// More than this share of the wheels' motion is not left of a pose that was read rightly.
const MOST_LEFT: f64 = 0.3;

/// Of which columns groups are made, in the order of the wheels.
pub(super) struct Rules<'a> {
    pub runs: &'a [LoggedRun],
    pub groups: &'a Groups,
    pub robot: &'a RobotFile,
    pub motion: Option<&'a Motion>,
    pub counts: Option<bool>,
}

impl Rules<'_> {
    /// The run whose columns all others have.
    pub fn run(&self) -> &LoggedRun {
        &self.runs[0]
    }

    /// All rules.
    pub fn all(&self) -> Vec<Rule> {
        let speeds = self.speeds();
        let mut all = speeds.clone();
        let groups = self.groups;
        let beside = Beside { runs: self.runs, robot: self.robot, speeds: &speeds };
        all.extend(
            groups.set_speed.iter().filter(|_| groups.speed.is_some()).flat_map(|places| beside.set_speeds(places)),
        );
        all.extend(groups.drive.iter().flat_map(|places| beside.drives(places)));
        all.extend(groups.command.iter().flat_map(|places| beside.commands(places)));
        all.extend(groups.current.iter().flat_map(|places| beside.currents(places)));
        all.extend(self.pose());
        all.extend(self.gyro());
        all.extend(groups.battery.map(|place| self.battery(place)));
        all
    }

    fn name_of(&self, place: Place) -> String {
        self.run().column(place).name.wheel.clone().unwrap_or_default()
    }

    fn wheels(&self) -> Option<&Wheels> {
        self.motion.map(|motion| &motion.wheels)
    }

    fn unit(&self, place: Place) -> Option<&'static str> {
        self.run().column(place).name.unit
    }

    /// What the numbers of wheels and pose are in, and how sure that is; none without a pose.
    fn scales(&self) -> Option<(Scales, Certainty)> {
        let wheels = self.wheels()?;
        if let Some(scales) = wheels.scales {
            return Some((scales, Certainty::Sure));
        }
        let speeds = self.groups.speed.as_ref().or(self.groups.set_speed.as_ref())?;
        let (both, pose) = (wheels.per_rad_s_per_m, self.groups.pose?);
        // only their ratio is known: one of the two has to be said
        if let Some(per_m) = self.unit(pose[0]).and_then(units::lengths_in_a_metre) {
            return Some((Scales { per_rad_s: both * per_m, per_m }, Certainty::Likely));
        }
        let stated = self.unit(speeds[0]).and_then(units::rates_in_a_rad_s);
        let per_rad_s = stated.unwrap_or_else(|| 1.0 / self.rate_by_size().factor());
        let certainty = if stated.is_some() { Certainty::Likely } else { Certainty::Guess };
        Some((Scales { per_rad_s, per_m: per_rad_s / both }, certainty))
    }

    /// The measured speeds; the commanded ones where nothing was measured.
    pub fn speeds(&self) -> Vec<Rule> {
        let (places, target): (_, fn(usize) -> Target) = match (&self.groups.speed, &self.groups.set_speed) {
            (Some(places), _) => (places, Target::W),
            (None, Some(places)) => (places, Target::Wset),
            _ => return Vec::new(),
        };
        let (order, sign, found) = self.order(places);
        let conversion = self.rate(self.unit(places[0]));
        let rule = |wheel: usize| Rule {
            sign: sign[wheel],
            found: found.clone().and(conversion.found.clone()),
            ..Rule::new(target(wheel), places[order[wheel]], conversion.clone())
        };
        (0..places.len()).map(rule).collect()
    }

    fn rate(&self, stated: Option<&'static str>) -> Conversion {
        let counted = |per_turn: f64, running, certainty, reason: &str| Conversion {
            counts: Some((per_turn, running)),
            ..Conversion::none(certainty, reason)
        };
        let stated = stated.filter(|unit| *unit != "counts");
        match (self.scales(), self.counts) {
            // 2π/N of a count is an angle
            (Some((scales, certainty)), Some(running)) => counted(
                (scales.per_rad_s * TAU).round().max(1.0),
                running,
                certainty.min(Certainty::Likely),
                "so many counts make wheels and pose agree; better give the encoder's own number",
            ),
            (None, Some(running)) => {
                counted(1.0, running, Certainty::Guess, "how many counts make a turn is in no log without a pose")
            }
            (Some((scales, certainty)), None) if certainty > Certainty::Guess => {
                let conversion = units::of_rate(scales.per_rad_s, stated, self.robot.motor.gear_ratio);
                let found = Found::new(conversion.found.certainty.min(certainty), conversion.found.reason.clone());
                Conversion { found, ..conversion }
            }
            _ if stated.is_none() => self.rate_by_size(),
            _ => units::by_name(stated, "rad/s"),
        }
    }

    /// The unit of speeds that nothing tells: of the wheel, where the supply could drive it so fast, else of the motor.
    fn rate_by_size(&self) -> Conversion {
        let gear = self.robot.motor.gear_ratio;
        let places = || self.groups.speed.as_ref().or(self.groups.set_speed.as_ref()).into_iter().flatten();
        let of_run = |run: &LoggedRun| places().map(|place| largest(&run.column(*place).values)).fold(0.0, f64::max);
        let fastest = self.runs.iter().map(of_run).fold(0.0, f64::max);
        let reach = self.robot.supply.map(|supply| 1.3 * supply.voltage_v / self.robot.volts_per_wheel_speed());
        let motor = format!("scale = {:.4} if they are the motor's, in front of the gear of {gear}", 1.0 / gear);
        match reach.is_some_and(|reach| fastest > reach) {
            true if gear > 1.0 => Conversion::scaled(
                1.0 / gear,
                Certainty::Guess,
                format!(
                    "too fast for this supply as speeds of the wheel: taken to be the motor's, in front of the gear of {gear}"
                ),
            ),
            _ if gear > 1.0 => {
                Conversion::none(Certainty::Guess, format!("taken to be rad/s of the wheel: nothing says so; {motor}"))
            }
            _ => units::by_name(None, "rad/s"),
        }
    }

    /// Which column is which wheel, and its sign.
    fn order(&self, places: &[Place]) -> (Vec<usize>, Vec<f64>, Found) {
        let count = places.len();
        let as_named = |found| ((0..count).collect::<Vec<_>>(), vec![1.0; count], found);
        if let Some(motion) = self.motion {
            let wheels = &motion.wheels;
            let fit = format!("wheels and pose leave {:.1} % of the motion", 100.0 * motion.reading.rest);
            return match (wheels.off_rad < OFF_RAD && motion.reading.rest < MOST_LEFT, wheels.scales) {
                (true, Some(_)) => {
                    let certainty = motion.certainty();
                    let fit = match certainty {
                        Certainty::Sure => fit,
                        _ => fit + ", and another order with another frame as little",
                    };
                    (wheels.column.clone(), wheels.sign.clone(), Found::new(certainty, fit))
                }
                (true, None) => {
                    let reason = "by its name, and the pose goes as these wheels drive; the robot hardly turns, which would prove it";
                    as_named(Found::new(Certainty::Likely, reason))
                }
                (false, _) => {
                    let reason = "by its name: wheels and pose do not fit the drive angles of the robot file";
                    as_named(Found::new(Certainty::Guess, reason))
                }
            };
        }
        if places.iter().all(|place| self.run().column(*place).name.is_a_runs_own) {
            return as_named(Found::new(Certainty::Sure, "by its name, which is a run's own"));
        }
        if let Some(order) = self.by_place(places) {
            let reason = "by what its name calls the wheel; no pose confirms it";
            return (order, vec![1.0; count], Found::new(Certainty::Likely, reason));
        }
        let reason = "in the order of names: without a pose no log tells order and signs";
        as_named(Found::new(Certainty::Guess, reason))
    }

    /// By words for the wheels' places, such as front left.
    fn by_place(&self, places: &[Place]) -> Option<Vec<usize>> {
        let direction = |place: &Place| direction_rad(&self.name_of(*place));
        let named: Vec<f64> = places.iter().map(direction).collect::<Option<_>>()?;
        // wheel j touches the floor in the direction a − 90°
        let touch = |wheel: usize| self.robot.wheel[wheel].drive_angle_deg.to_radians() - FRAC_PI_2;
        let apart = |order: &Vec<usize>| -> f64 {
            order
                .iter()
                .enumerate()
                .map(|(wheel, column)| (1.0 - (touch(wheel) - named[*column]).cos()).abs())
                .fold(0.0, f64::max)
        };
        let best = permutations(places.len()).into_iter().min_by(|a, b| apart(a).total_cmp(&apart(b)))?;
        (apart(&best) < 1.0 - NEAR_RAD.cos()).then_some(best)
    }

    fn pose(&self) -> Vec<Rule> {
        let Some([x, y, heading]) = self.groups.pose else { return Vec::new() };
        let known = self.motion.zip(self.scales()).filter(|(motion, _)| motion.wheels.off_rad < OFF_RAD);
        let Some((motion, (scales, of_scales))) = known else {
            let size = largest(&self.run().column(heading).values);
            let of_heading = match self.unit(heading) {
                None if size > 10.0 => Conversion::in_unit("deg", Certainty::Likely, "too large for radians"),
                stated => units::by_name(stated, "rad"),
            };
            let length = |place| units::by_name(self.unit(place), "m");
            let rules = [(Target::X, x, length(x)), (Target::Y, y, length(y)), (Target::Theta, heading, of_heading)];
            return rules.map(|(target, place, conversion)| Rule::new(target, place, conversion)).to_vec();
        };
        let frame = motion.reading.frame;
        let is_clear = motion.reading.next_best > 2.0 * motion.reading.rest;
        // without turning a frame and its mirror image are the same, wheels being otherwise
        let certainty = match (is_clear, motion.wheels.scales) {
            (true, Some(_)) => motion.certainty(),
            (_, None) if !frame.mirrored && !frame.clockwise => Certainty::Likely,
            _ => Certainty::Guess,
        };
        let axes = |is: bool, words: &str| Found::new(certainty, if is { words } else { "" });
        let length = |place| {
            let conversion = units::of_length(scales.per_m, self.unit(place));
            let found = Found::new(conversion.found.certainty.min(of_scales), conversion.found.reason.clone());
            Conversion { found, ..conversion }
        };
        let (along, across) = (length(x), length(y));
        let mirrored = axes(frame.mirrored, "the frame is mirrored: no other fits the wheels");
        let clockwise = axes(frame.clockwise, "it counts clockwise: nothing else fits the wheels");
        let angle = match frame.degrees {
            true => Conversion::in_unit("deg", certainty, "degrees: radians do not fit the wheels"),
            false => Conversion::none(certainty, "radians: turns as the wheels say"),
        };
        let offset = offset(&motion.wheels);
        vec![
            Rule { found: along.found.clone(), ..Rule::new(Target::X, x, along) },
            Rule {
                sign: if frame.mirrored { -1.0 } else { 1.0 },
                found: across.found.clone().and(mirrored),
                ..Rule::new(Target::Y, y, across)
            },
            Rule {
                sign: if frame.clockwise { -1.0 } else { 1.0 },
                offset: offset.0,
                found: angle.found.clone().and(clockwise).and(Found::new(certainty, offset.1)),
                ..Rule::new(Target::Theta, heading, angle)
            },
        ]
    }

    fn gyro(&self) -> Option<Rule> {
        let place = self.groups.gyro?;
        let column = self.run().column(place);
        let fitted = self.motion.and_then(|motion| motion.reading.columns.get(self.robot.wheel.len()));
        let known = fitted.filter(|fitted| fitted.unsure_turn < 0.1);
        let conversion = match known {
            Some(fitted) => units::of_rate(fitted.of[2].abs(), column.name.unit, 1.0),
            None if column.name.unit.is_none() && largest(&column.values) > 30.0 => {
                Conversion::in_unit("deg/s", Certainty::Likely, "too large for radians")
            }
            None => units::by_name(column.name.unit, "rad/s"),
        };
        let sign = known.map_or(1.0, |fitted| fitted.of[2].signum());
        Some(Rule { sign, ..Rule::new(Target::Gyro, place, conversion) })
    }

    fn battery(&self, place: Place) -> Rule {
        let column = self.run().column(place);
        let size = largest(&column.values);
        let conversion = match column.name.unit {
            Some("mV") => Conversion::in_unit("mV", Certainty::Sure, "by its name"),
            None if size > 1000.0 => Conversion::in_unit("mV", Certainty::Likely, "too large for volts"),
            _ if (3.0..80.0).contains(&size) => Conversion::none(Certainty::Sure, "by its name and size"),
            _ => Conversion::none(Certainty::Guess, "of no size that a battery has in volts"),
        };
        Rule::new(Target::Vbat, place, conversion)
    }
}

/// A wheel whose name says where it is lies no further from there (rad).
const NEAR_RAD: f64 = FRAC_PI_2 / 2.0;

/// What is added to the heading (rad), near to a quarter turn exactly that.
fn offset(wheels: &Wheels) -> (f64, String) {
    let quarter = (wheels.offset_rad / FRAC_PI_2).round() * FRAC_PI_2;
    let offset = if (wheels.offset_rad - quarter).abs() < NO_OFFSET_RAD { quarter } else { wheels.offset_rad };
    if offset == 0.0 {
        return (0.0, String::new());
    }
    (offset, format!("the marker lies {:.0}° off forward", offset.to_degrees()))
}

/// Which way a word for a place points, from the robot's forward axis to the left (rad).
fn direction_rad(word: &str) -> Option<f64> {
    let degrees = match word {
        "front" => 0.0,
        "fl" | "lf" | "front_left" | "left_front" => 45.0,
        "left" => 90.0,
        "rl" | "lr" | "bl" | "lb" | "rear_left" | "back_left" | "left_rear" | "left_back" => 135.0,
        "rear" | "back" => 180.0,
        "rr" | "br" | "rb" | "rear_right" | "back_right" | "right_rear" | "right_back" => 225.0,
        "right" => 270.0,
        "fr" | "rf" | "front_right" | "right_front" => 315.0,
        _ => return None,
    };
    Some(f64::to_radians(degrees))
}
