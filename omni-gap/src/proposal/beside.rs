//! # Signals beside the speeds: commands and currents, told by the names they share with the speeds and by how they go with them

use super::doubt::{Certainty, Found};
use super::groups::Place;
use super::logs::LoggedRun;
use super::rule::Rule;
use super::series::{Together, largest};
use super::units::{self, Conversion};
use crate::log::target::Target;
use crate::log::{Channel, RobotFile, permutations};

/// What groups are put to wheels by.
pub(super) struct Beside<'a> {
    pub runs: &'a [LoggedRun],
    pub robot: &'a RobotFile,
    /// The rule of each wheel's speed.
    pub speeds: &'a [Rule],
}

/// A column that was put to a wheel.
struct Put {
    place: Place,
    sign: f64,
    found: Found,
}

/// Columns that were put to wheels.
struct PutGroup {
    wheels: Vec<Put>,
    /// How many times the speeds' numbers theirs are, at the least and at the most; none where they do not go together.
    times: Option<(f64, f64)>,
    /// How well they go with the speeds, from 0 to 1.
    fit: f64,
}

impl PutGroup {
    fn rules(&self, target: fn(usize) -> Target, conversion: &Conversion) -> Vec<Rule> {
        let rule = |(wheel, put): (usize, &Put)| Rule {
            sign: put.sign,
            found: put.found.clone().and(conversion.found.clone()),
            ..Rule::new(target(wheel), put.place, conversion.clone())
        };
        self.wheels.iter().enumerate().map(rule).collect()
    }
}

impl Beside<'_> {
    /// Commanded speeds.
    pub fn set_speeds(&self, places: &[Place]) -> Vec<Rule> {
        let put = self.put(places);
        put.rules(Target::Wset, &self.of_set_speed(&put))
    }

    /// Commanded voltages or duties.
    pub fn drives(&self, places: &[Place]) -> Vec<Rule> {
        let put = self.put(places);
        put.rules(Target::U, &self.of_drive(&put))
    }

    /// Commands of which no name says what they are: speeds, if the measured ones follow them closely and are as large.
    pub fn commands(&self, places: &[Place]) -> Vec<Rule> {
        let put = self.put(places);
        let as_large = |(low, high): (f64, f64)| (0.8..1.25).contains(&(low * high).sqrt());
        match put.fit > 0.9 && put.times.is_some_and(as_large) {
            true => put.rules(Target::Wset, &self.of_set_speed(&put)),
            false => put.rules(Target::U, &self.of_drive(&put)),
        }
    }

    /// Motor currents. A current leads its speed: how they go together says nothing of its sign.
    pub fn currents(&self, places: &[Place]) -> Vec<Rule> {
        let mut put = self.put_by(places, if self.are_unsigned(places) { f64::abs } else { |value| value });
        put.wheels.iter_mut().for_each(|wheel| wheel.sign = 1.0);
        let column = self.runs[0].column(places[0]);
        let conversion = match column.name.unit {
            Some("mA") => Conversion::in_unit("mA", Certainty::Sure, "by its name"),
            Some("A") => Conversion::none(Certainty::Sure, "by its name"),
            _ if self.largest(places) > 100.0 => Conversion::in_unit("mA", Certainty::Likely, "too large for amperes"),
            _ => Conversion::none(Certainty::Likely, "amperes by their size"),
        };
        put.rules(Target::I, &conversion)
    }

    fn name_of(&self, place: Place) -> Option<&str> {
        self.runs[0].column(place).name.wheel.as_deref()
    }

    fn are_unsigned(&self, places: &[Place]) -> bool {
        let channel = |place: &Place| &self.runs[0].column(*place).values;
        let speeds: Vec<&Channel> = self.speeds.iter().map(|rule| channel(&rule.place)).collect();
        is_unsigned(&places.iter().map(channel).collect::<Vec<_>>(), &speeds)
    }

    fn largest(&self, places: &[Place]) -> f64 {
        let of_run =
            |run: &LoggedRun| places.iter().map(|place| largest(&run.column(*place).values)).fold(0.0, f64::max);
        self.runs.iter().map(of_run).fold(0.0, f64::max)
    }

    /// What the speeds' numbers are multiplied by for rad/s; none where they are counts, or nothing is known of them.
    fn factor(&self) -> Option<f64> {
        let speed = self.speeds.first()?;
        (speed.conversion.counts.is_none()).then(|| speed.conversion.factor())
    }

    /// Puts columns to wheels: by the names that they share with the speeds, where these do not go badly together.
    fn put(&self, places: &[Place]) -> PutGroup {
        self.put_by(places, |value| value)
    }

    /// The same by what `part` takes of the speeds: their sizes, beside signals that have no sign.
    fn put_by(&self, places: &[Place], part: fn(f64) -> f64) -> PutGroup {
        if self.speeds.is_empty() {
            let found = Found::new(Certainty::Guess, "in the order of names: no speed tells order and signs");
            let put = |place: &Place| Put { place: *place, sign: 1.0, found: found.clone() };
            return PutGroup { wheels: places.iter().map(put).collect(), times: None, fit: 0.0 };
        }
        let fits = self.fits(places, part);
        let total = |order: &Vec<usize>| -> f64 {
            order.iter().enumerate().map(|(wheel, column)| fits[wheel][*column].fit().abs()).sum()
        };
        let place_of = |rule: &Rule| places.iter().position(|place| self.name_of(*place) == self.name_of(rule.place));
        let named: Option<Vec<usize>> = self.speeds.iter().map(place_of).collect();
        let all = permutations(places.len());
        let best = all.into_iter().max_by(|a, b| total(a).total_cmp(&total(b))).unwrap_or_default();
        let clear = total(&best) > 0.5 * places.len() as f64;
        let (order, certainty, reason) = match named {
            Some(named) if total(&named) >= total(&best) - 0.1 || !clear => {
                (named, if clear { Certainty::Sure } else { Certainty::Likely }, "the same wheel by its name")
            }
            None if clear => (best, Certainty::Likely, "goes best with this wheel's speed"),
            _ => (best, Certainty::Guess, "goes best with this wheel's speed, which is not that of its name"),
        };
        let put = |(wheel, column): (usize, &usize)| {
            let fit = fits[wheel][*column].fit();
            let told = fit.abs() > TOGETHER;
            let found = Found::new(
                if told { certainty } else { certainty.min(Certainty::Likely) },
                format!("{reason}; goes with its speed by {fit:.2}"),
            );
            Put { place: places[*column], sign: if told && fit < 0.0 { -1.0 } else { 1.0 }, found }
        };
        let of_order = order.iter().enumerate().map(|(wheel, column)| fits[wheel][*column]);
        let mut times: Vec<(f64, f64)> =
            of_order.filter(|fit| fit.fit().abs() > TOGETHER).map(|fit| fit.times()).collect();
        times.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (times, fit) = (times.get(times.len() / 2).copied(), total(&order) / places.len() as f64);
        PutGroup { wheels: order.iter().enumerate().map(put).collect(), times, fit }
    }

    /// How each column goes with each wheel's speed.
    fn fits(&self, places: &[Place], part: fn(f64) -> f64) -> Vec<Vec<Together>> {
        let both = |rule: &Rule, place: &Place| {
            let mut together = Together::default();
            for run in self.runs {
                let speed = run.column(rule.place).values.map(|_, value| part(rule.sign * value));
                together.add(&run.onto(*place, rule.place), &speed);
            }
            together
        };
        self.speeds.iter().map(|rule| places.iter().map(|place| both(rule, place)).collect()).collect()
    }

    fn of_set_speed(&self, put: &PutGroup) -> Conversion {
        let stated = self.runs[0].column(put.wheels[0].place).name.unit.filter(|unit| *unit != "counts");
        let measured = self.speeds.first().map(|rule| (&rule.conversion, self.runs[0].column(rule.place).name.unit));
        match measured {
            Some((of_speed, unit))
                if unit == stated && put.times.is_some_and(|(low, high)| (0.7..1.4).contains(&(low * high).sqrt())) =>
            {
                Conversion {
                    found: Found::new(of_speed.found.certainty, "in the unit of the measured speed: both are as large"),
                    ..of_speed.clone()
                }
            }
            _ => units::by_name(stated, "rad/s"),
        }
    }

    fn of_drive(&self, put: &PutGroup) -> Conversion {
        let places: Vec<Place> = put.wheels.iter().map(|put| put.place).collect();
        let column = self.runs[0].column(places[0]);
        let supply_v = self.robot.supply.map_or(12.0, |supply| supply.voltage_v);
        let per_speed = put.times.zip(self.factor()).map(|((low, high), factor)| (low / factor, high / factor));
        let is_duty = ["duty", "pwm", "dc"].iter().any(|word| column.title.to_lowercase().contains(word));
        match column.name.unit {
            Some("mV") => Conversion::in_unit("mV", Certainty::Likely, "by its name"),
            Some("V") => Conversion::none(Certainty::Sure, "volts by its name"),
            _ => {
                units::of_drive(self.largest(&places), per_speed, self.robot.volts_per_wheel_speed(), supply_v, is_duty)
            }
        }
    }
}

/// Signals that go together less than this do not tell signs and sizes.
const TOGETHER: f64 = 0.3;

/// Whether currents were logged as magnitudes: never below zero, of motors that turn both ways.
pub(super) fn is_unsigned(currents: &[&Channel], speeds: &[&Channel]) -> bool {
    let below = |channels: &[&Channel]| channels.iter().any(|channel| channel.present().any(|(_, value)| value < 0.0));
    !currents.is_empty() && !below(currents) && below(speeds)
}
