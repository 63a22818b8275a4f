//! # Units, told by the size of numbers

use super::doubt::{Certainty, Found};
use crate::log::unit_factor;

/// How a column becomes the contract's unit.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Conversion {
    /// A unit that mappings know; none for the contract's own.
    pub unit: Option<&'static str>,
    /// A factor beside it.
    pub scale: Option<f64>,
    /// Counts in a turn, and whether they run on.
    pub counts: Option<(f64, bool)>,
    pub found: Found,
}

impl Conversion {
    /// The contract's unit.
    pub fn none(certainty: Certainty, reason: impl Into<String>) -> Conversion {
        Conversion { unit: None, scale: None, counts: None, found: Found::new(certainty, reason) }
    }

    pub fn in_unit(unit: &'static str, certainty: Certainty, reason: impl Into<String>) -> Conversion {
        Conversion { unit: Some(unit), ..Conversion::none(certainty, reason) }
    }

    pub fn scaled(scale: f64, certainty: Certainty, reason: impl Into<String>) -> Conversion {
        Conversion { scale: Some(scale), ..Conversion::none(certainty, reason) }
    }

    /// What a number is multiplied by (counts apart).
    pub fn factor(&self) -> f64 {
        let of_unit = self.unit.and_then(unit_factor).unwrap_or(1.0);
        of_unit * self.scale.unwrap_or(1.0)
    }
}

/// Units of rates, and of lengths.
const RATES: [&str; 3] = ["rad/s", "rpm", "deg/s"];
const LENGTHS: [&str; 3] = ["m", "cm", "mm"];

/// How many of a rate make a rad/s, by the name of its unit.
pub(super) fn rates_in_a_rad_s(unit: &str) -> Option<f64> {
    in_one(&RATES, unit)
}

/// How many of a length make a metre, by the name of its unit.
pub(super) fn lengths_in_a_metre(unit: &str) -> Option<f64> {
    in_one(&LENGTHS, unit)
}

fn in_one(units: &[&str], unit: &str) -> Option<f64> {
    units.contains(&unit).then(|| unit_factor(unit)).flatten().map(|factor| 1.0 / factor)
}

/// The units of these of which there may be `per` in one.
fn near<'a>(units: &'a [&'static str], per: f64) -> impl Iterator<Item = (&'static str, f64)> + 'a {
    let with = |unit: &&'static str| Some((*unit, in_one(units, unit)?));
    units.iter().filter_map(with).filter(move |(_, known)| is_near(per, *known))
}

/// A number may be off by so much, wheel and floor being what they are, and still be of its unit.
const NEAR: f64 = 0.2;

/// Whether a number can be the size of anything: nothing can, of a robot that stands.
fn is_size(number: f64) -> bool {
    number.is_finite() && number > 0.0
}

fn is_near(a: f64, b: f64) -> bool {
    (a / b).ln().abs() < NEAR
}

/// The unit of wheel speeds that have `per_rad_s` to a rad/s, of a robot with this gear.
pub(super) fn of_rate(per_rad_s: f64, stated: Option<&'static str>, gear: f64) -> Conversion {
    if !is_size(per_rad_s) {
        return by_name(stated, "rad/s");
    }
    let told = |per: f64| format!("the pose turns {:.3} as fast as they would", per_rad_s / per);
    if let Some((unit, per)) = stated.and_then(|unit| Some((unit, rates_in_a_rad_s(unit)?))) {
        let unit = (unit != "rad/s").then_some(unit);
        let of = |scale, certainty, reason: String| Conversion {
            unit,
            scale,
            counts: None,
            found: Found::new(certainty, reason),
        };
        return match () {
            () if is_near(per_rad_s, per) => of(None, Certainty::Sure, format!("by its name, and {}", told(per))),
            () if gear > 1.0 && is_near(per_rad_s, per * gear) => of(
                Some(1.0 / gear),
                Certainty::Sure,
                format!("by its name, of the motor in front of the gear of {gear}: {}", told(per * gear)),
            ),
            () => of(
                Some(per / per_rad_s),
                Certainty::Guess,
                "its name's unit does not fit the pose: scaled to it".into(),
            ),
        };
    }
    for (times, of_motor) in [(1.0, false), (gear, true)] {
        let near: Vec<_> = near(&RATES, per_rad_s / times).collect();
        if let [(unit, per)] = near.as_slice() {
            let motor = if of_motor { format!(" of the motor in front of the gear of {gear}") } else { String::new() };
            let found = Found::new(Certainty::Sure, format!("{unit}{motor}: {}", told(per * times)));
            let unit = (*unit != "rad/s").then_some(*unit);
            return Conversion { unit, scale: of_motor.then_some(1.0 / gear), counts: None, found };
        }
    }
    Conversion::scaled(1.0 / per_rad_s, Certainty::Guess, "no unit fits: scaled so that wheels and pose agree")
}

/// The unit of a pose that has `per_m` to a metre.
pub(super) fn of_length(per_m: f64, stated: Option<&'static str>) -> Conversion {
    if !is_size(per_m) {
        return by_name(stated, "m");
    }
    let near = near(&LENGTHS, per_m).next();
    let in_contracts = |unit: &'static str| (unit != "m").then_some(unit);
    match (near, stated) {
        (Some((unit, per)), stated) => {
            let agrees = stated.is_none_or(|stated| stated == unit);
            let certainty = if agrees { Certainty::Sure } else { Certainty::Guess };
            let reason = format!("{unit}: by the wheels the robot goes {:.3} as far", per_m / per);
            Conversion { unit: in_contracts(unit), ..Conversion::none(certainty, reason) }
        }
        (None, _) => Conversion::scaled(
            1.0 / per_m,
            Certainty::Likely,
            "pixels or the like: scaled so that wheels and pose agree",
        ),
    }
}

/// The unit of a name where no number can confirm it.
pub(super) fn by_name(stated: Option<&'static str>, own: &str) -> Conversion {
    match stated {
        Some(unit) if unit == own => Conversion::none(Certainty::Likely, "by its name"),
        Some(unit) => Conversion::in_unit(unit, Certainty::Likely, "by its name"),
        None => Conversion::none(Certainty::Guess, format!("taken to be {own}: nothing says so")),
    }
}

/// Largest numbers of duties, and what is meant by each.
const FULL: [f64; 12] = [1.0, 100.0, 127.0, 255.0, 256.0, 511.0, 512.0, 1000.0, 1023.0, 2047.0, 4095.0, 32767.0];

/// Volts of a drive, from numbers of which `largest` is the largest and `per_speed` a wheel speed's share at the least and at
/// the most (V/(rad/s) as they stand); `nominal` is the robot file's, `supply_v` its supply.
pub(super) fn of_drive(
    largest: f64,
    per_speed: Option<(f64, f64)>,
    nominal: f64,
    supply_v: f64,
    is_duty: bool,
) -> Conversion {
    // volts are some more than the speed asks for: Kv·l, and what the current takes
    let fits =
        |scale: f64| per_speed.is_none_or(|(low, high)| scale * low < 3.0 * nominal && scale * high > 0.6 * nominal);
    let told = |scale: f64| match per_speed {
        Some((low, high)) => {
            let times = |per_speed| scale * per_speed / nominal;
            format!("the volts of a speed are {:.2} to {:.2} times its back-EMF", times(low), times(high))
        }
        None => "no speed confirms it".into(),
    };
    let volts = (!is_duty && largest <= 1.3 * supply_v && largest > 1.05 && fits(1.0)).then_some(1.0);
    let full = FULL.iter().copied().find(|full| largest <= 1.001 * full).filter(|full| fits(supply_v / full));
    let certainty = match (per_speed, volts, full) {
        (Some(_), Some(_), None) | (Some(_), None, Some(_)) => Certainty::Likely,
        _ => Certainty::Guess,
    };
    match (volts, full) {
        (Some(_), _) => Conversion::none(certainty, format!("volts: within the supply; {}", told(1.0))),
        (None, Some(full)) => {
            let scale = supply_v / full;
            Conversion::scaled(
                scale,
                certainty,
                format!("a duty of {full} is the supply of {supply_v} V; {}", told(scale)),
            )
        }
        (None, None) => {
            Conversion::none(Certainty::Guess, format!("neither volts nor a duty of the supply fits; {}", told(1.0)))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_are_told_by_how_many_make_a_radian_a_second() {
        assert_eq!(of_rate(9.4, None, 5.0).unit, Some("rpm"));
        assert_eq!(of_rate(1.03, None, 5.0), Conversion { unit: None, scale: None, ..of_rate(1.03, None, 5.0) });
        let motor = of_rate(16.5, None, 16.0);
        assert_eq!((motor.unit, motor.scale), (None, Some(1.0 / 16.0)));
        assert_eq!(of_rate(300.0, None, 16.0).found.certainty, Certainty::Guess);
        assert_eq!(of_rate(9.6, Some("rad/s"), 5.0).found.certainty, Certainty::Guess);
    }

    #[test]
    fn lengths_and_pixels() {
        assert_eq!(of_length(1030.0, None).unit, Some("mm"));
        assert_eq!(of_length(0.97, None).unit, None);
        assert!((of_length(543.0, None).scale.unwrap() - 1.0 / 543.0).abs() < 1e-12);
    }

    #[test]
    fn duties_are_told_by_their_largest_number_and_the_speeds() {
        // 12 V, 0.13 V/(rad/s): volts of 8 and speeds of 40 rad/s
        assert_eq!(of_drive(8.0, Some((0.2, 0.3)), 0.13, 12.0, false).scale, None);
        assert_eq!(of_drive(0.7, Some((0.2 / 12.0, 0.3 / 12.0)), 0.13, 12.0, true).scale, Some(12.0));
        assert_eq!(
            of_drive(480.0, Some((0.2 * 511.0 / 12.0, 0.3 * 511.0 / 12.0)), 0.13, 12.0, true).scale,
            Some(12.0 / 511.0)
        );
        assert_eq!(of_drive(480.0, Some((900.0, 900.0)), 0.13, 12.0, true).found.certainty, Certainty::Guess);
    }
}
