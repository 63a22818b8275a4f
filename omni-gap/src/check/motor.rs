//! Each wheel's own motor: volts against speed and current, u = a·w + b·i with a ≈ Kv·l and b ≈ R.
//!
//! a and b are fitted within a factor of two and more, and the drive may act late, so wrong parameters, a weak motor, a
//! dead zone or a delay do not matter; what cannot be is a relation that is bad as it stands, in every run, and good with
//! another wheel's channel, another sign or another unit. Set speeds stand for volts where the drive controls speed (a ≈ 1).

use super::Fault;
use super::agree::{self, Evidence};
use super::body::largest;
use super::duty;
use super::gram::{Gram, Term, Within};
use super::order::{self, Order};
use super::ranked::ranked;
use super::units::{self, WrongUnit};
use crate::log::{Group, RobotFile, Run};

/// Which group a guess blames.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Blame {
    Drive,
    Speed,
    Current,
}

/// What a guess says.
#[derive(Debug, Clone)]
enum What {
    Wheels(Order),
    Unit(WrongUnit),
}

/// A guess, and which groups it could blame as well.
#[derive(Debug, Clone)]
pub(super) struct Guess {
    blame: Blame,
    what: What,
    or: Vec<Blame>,
    better: f64,
}

/// What can be said of the motors of a run.
#[derive(Clone)]
struct Motors {
    gram: Gram,
    /// "u" or "wset".
    drive: &'static str,
    currents: bool,
    /// Where a and b may lie.
    a: Within,
    b: Within,
}

/// How much worse than the guess the log must be as given (squares), and how much the guess may leave over.
const TIMES: f64 = 5.0;
const LEFT: f64 = 0.15;
/// The same without currents, whose part in the volts then remains in any case.
const TIMES_WITHOUT: f64 = 2.5;
const LEFT_WITHOUT: f64 = 0.4;
/// What the log must leave over as given.
const LEAST: f64 = 0.01;
/// Of the most driven wheel's volts squared, what the guess must explain.
const COUNTS: f64 = 0.015;
/// The same, and what may remain, where the guess brings a run back to what remains in the others.
const COUNTS_BACK: f64 = 0.003;
const BACK: f64 = 2.0;

impl Motors {
    fn new(run: &Run, robot: &RobotFile) -> Option<Motors> {
        let speed = run.w.as_ref().filter(|group| !group.unsigned)?;
        let (drive, group, per_speed) = match (&run.u, &run.wset) {
            (Some(u), _) if !u.unsigned => ("u", u, robot.volts_per_wheel_speed()),
            (None, Some(set)) if !set.unsigned => ("wset", set, 1.0),
            _ => return None,
        };
        let current = run.i.as_ref().filter(|group| !group.unsigned && drive == "u");
        let gram = Gram::new(run, group, speed, current);
        let n = gram.wheels;
        let moved = |group: usize| (group * n..(group + 1) * n).any(|channel| gram.square(channel) > 0.0);
        if gram.rows < 20 || !moved(0) || !moved(1) {
            return None;
        }
        let r = robot.motor.resistance_ohm;
        let (a, b) = match (current, drive) {
            (Some(_), _) => ((0.5 * per_speed, 2.0 * per_speed), (0.4 * r, 2.5 * r)),
            // the current's share of the volts falls to the speed
            (None, "u") => ((0.48 * per_speed, 5.0 * per_speed), (0.0, 0.0)),
            (None, _) => ((0.4, 2.5), (0.0, 0.0)),
        };
        Some(Motors { gram, drive, currents: current.is_some(), a, b })
    }

    /// The share that remains of wheel j's volts if a group's channel is another one's.
    fn wheel(&self, blame: Blame, j: usize, there: usize, times: f64) -> f64 {
        let n = self.gram.wheels;
        let mut terms = [0, n, 2 * n].map(|group| Term { channel: group + j, times: 1.0 });
        let group = blame as usize;
        terms[group] = Term { channel: group * n + there, times };
        let [u, w, i] = terms;
        let within = |within: Within, factor: f64| (within.0 / factor, within.1 * factor);
        // a unit is told from a wrong parameter only where it fits more closely
        let tight = if times.abs() < 1.0 && (self.currents || self.drive == "wset") { 0.8 } else { 1.0 };
        self.gram.rest(u, w, i, within(self.a, tight), within(self.b, tight))
    }

    fn duty(&self, largest: f64, robot: &RobotFile) -> Option<f64> {
        let nominal = (robot.volts_per_wheel_speed(), robot.motor.resistance_ohm);
        let supply = robot.supply.map(|supply| supply.voltage_v);
        let known = duty::Known { nominal, largest, supply, currents: self.currents };
        if self.drive == "u" { duty::factor(&self.gram, known) } else { None }
    }

    fn as_given(&self, j: usize) -> f64 {
        self.wheel(Blame::Speed, j, j, 1.0)
    }

    /// Volts squared of a wheel, by which its share counts.
    fn weight(&self, j: usize) -> f64 {
        self.gram.square(j)
    }

    /// The mean share of some relations; `drive` says whose volts each one explains.
    fn mean(&self, wheels: &[usize], drive: impl Fn(usize) -> usize, share: impl Fn(usize) -> f64) -> f64 {
        let all: f64 = wheels.iter().map(|&j| self.weight(drive(j))).sum();
        let left: f64 = wheels.iter().map(|&j| self.weight(drive(j)) * share(j)).sum();
        if all > 0.0 { left / all } else { 0.0 }
    }

    fn all(&self) -> Vec<usize> {
        (0..self.gram.wheels).collect()
    }

    fn blames(&self) -> &'static [Blame] {
        if self.currents { &[Blame::Speed, Blame::Current, Blame::Drive] } else { &[Blame::Speed] }
    }

    fn units(&self) -> Vec<(Blame, WrongUnit)> {
        let speeds = units::SPEEDS.map(|unit| (Blame::Speed, unit)).to_vec();
        let currents = units::AMPERES.map(|unit| (Blame::Current, unit)).to_vec();
        let volts = units::VOLTS.map(|unit| (Blame::Drive, unit)).to_vec();
        let sets = units::SPEEDS.map(|unit| (Blame::Drive, unit)).to_vec();
        match (self.drive, self.currents) {
            ("u", true) => [speeds, currents, volts].concat(),
            ("u", false) => [speeds, volts].concat(),
            _ => [speeds, sets].concat(),
        }
    }

    /// Every guess that holds: how many things it changes, and what it leaves over on all wheels.
    fn holding(&self, usual: Option<f64>) -> Vec<((Blame, What), usize, bool, f64)> {
        let n = self.gram.wheels;
        let mut holding = Vec::new();
        let given: Vec<f64> = (0..n).map(|j| self.as_given(j)).collect();
        for &blame in self.blames() {
            let sign = |k: usize| if k % 2 == 1 { -1.0 } else { 1.0 };
            let fits: Vec<f64> = (0..n * n * 2).map(|k| self.wheel(blame, k / 2 / n, k / 2 % n, sign(k))).collect();
            for order in order::all(n).into_iter().skip(1) {
                let fit = |j: usize| fits[(j * n + order.place[j]) * 2 + usize::from(order.sign[j] < 0.0)];
                let changed: Vec<usize> = (0..n).filter(|&j| order.changed(j)).collect();
                let rests = self.over(&changed, &given, blame, &order, fit);
                let rest = self.over(&self.all(), &given, blame, &order, fit).1;
                let holds = self.holds(rests) && self.counts(&changed, rests, COUNTS) && rests.0 > LEAST;
                let back =
                    |usual: f64| self.holds(rests) && self.counts(&changed, rests, COUNTS_BACK) && rest < BACK * usual;
                if holds || usual.is_some_and(back) {
                    let (changes, moved) = (order.changes(), order.moved());
                    holding.push(((blame, What::Wheels(order)), changes, moved, rest));
                }
            }
        }
        for (blame, unit) in self.units() {
            let rests = self.rests(&Guess { blame, what: What::Unit(unit), or: Vec::new(), better: 1.0 });
            if self.holds(rests) && rests.0 > LEAST {
                holding.push(((blame, What::Unit(unit)), 1, true, rests.1));
            }
        }
        holding
    }

    /// What some wheels leave over, as given and with an order.
    fn over(
        &self,
        wheels: &[usize],
        given: &[f64],
        blame: Blame,
        order: &Order,
        fit: impl Fn(usize) -> f64,
    ) -> (f64, f64) {
        let place = |j: usize| if blame == Blame::Drive { order.place[j] } else { j };
        (self.mean(wheels, |j| j, |j| given[j]), self.mean(wheels, place, fit))
    }

    /// Whether what some wheels leave over counts against the volts of the most driven one: a wheel that is hardly driven
    /// shows little but its bridge's losses.
    fn counts(&self, wheels: &[usize], (given, otherwise): (f64, f64), share: f64) -> bool {
        let top = self.all().into_iter().map(|j| self.weight(j)).fold(0.0, f64::max);
        (given - otherwise) * wheels.iter().map(|&j| self.weight(j)).sum::<f64>() > share * top
    }

    fn holds(&self, (given, otherwise): (f64, f64)) -> bool {
        let (times, left) = if self.currents { (TIMES, LEFT) } else { (TIMES_WITHOUT, LEFT_WITHOUT) };
        given > times * otherwise && otherwise < left
    }
}

impl Evidence for Motors {
    type Guess = Guess;

    fn add(&mut self, other: &Motors) {
        self.gram.add(&other.gram);
    }

    fn best(&self, usual: Option<f64>) -> Option<Guess> {
        let holding = self.holding(usual);
        let ((blame, what), _) = order::best(&holding, 0.002)?;
        let mut guess = Guess { blame, what, or: Vec::new(), better: 1.0 };
        let (given, otherwise) = self.rests(&guess);
        guess.better = (given / otherwise.max(1e-6)).sqrt();
        let as_well = |other: &&Blame| {
            let rests = self.rests(&Guess { blame: **other, ..guess.clone() });
            **other != blame && rests.1 < 2.0 * otherwise + 0.002 && self.holds(rests)
        };
        guess.or = self.blames().iter().filter(as_well).copied().collect();
        Some(guess)
    }

    fn rests(&self, guess: &Guess) -> (f64, f64) {
        match &guess.what {
            What::Unit(unit) => {
                let otherwise = |j| self.wheel(guess.blame, j, j, 1.0 / unit.per_unit);
                (self.rest_as_given(), self.mean(&self.all(), |j| j, otherwise))
            }
            // only the wheels that the guess changes are compared
            What::Wheels(order) => {
                let given: Vec<f64> = self.all().iter().map(|&j| self.as_given(j)).collect();
                let changed: Vec<usize> = self.all().into_iter().filter(|&j| order.changed(j)).collect();
                let fit = |j: usize| self.wheel(guess.blame, j, order.place[j], order.sign[j]);
                self.over(&changed, &given, guess.blame, order, fit)
            }
        }
    }

    fn rest_as_given(&self) -> f64 {
        self.mean(&self.all(), |j| j, |j| self.as_given(j))
    }
}

/// Whether the drive of a run says in which unit its wheel speeds are.
pub(super) fn knows_speeds(run: &Run) -> bool {
    let moved = |group: &Group| !group.unsigned && group.channels.iter().any(|channel| largest(channel) > 0.0);
    run.w.as_ref().is_some_and(moved) && run.u.as_ref().or(run.wset.as_ref()).is_some_and(moved)
}

pub(super) fn check<'a>(runs: &[&'a Run], robot: &RobotFile) -> Vec<Fault> {
    let mut faults = Vec::new();
    for kind in [("u", true), ("u", false), ("wset", false)] {
        let of = |&run: &&'a Run| Some((run, Motors::new(run, robot).filter(|m| (m.drive, m.currents) == kind)?));
        let all: Vec<(&Run, Motors)> = runs.iter().filter_map(of).collect();
        let by_duty = duties(&all, robot);
        faults.extend(all.iter().zip(&by_duty).filter_map(|((run, _), factor)| Some(duty_told(run, (*factor)?))));
        let rest = all.into_iter().zip(by_duty).filter(|(_, factor)| factor.is_none()).map(|(one, _)| one);
        let (runs, motors): (Vec<&Run>, Vec<Motors>) = rest.unzip();
        let found = agree::guesses(&motors);
        faults.extend(found.into_iter().map(|(guess, which)| {
            let fault = describe(runs[which[0]], &motors[which[0]], &guess);
            let sentence = fault.sentence.clone() + &agree::in_which(which.len(), runs.len());
            Fault { sentence, ..fault }
        }));
    }
    let unsure = runs.iter().filter(|run| !(run.i.is_some() && run.u.is_some() && knows_speeds(run)));
    faults.extend(unsure.filter_map(|run| stall(run, robot)));
    faults
}

fn describe(run: &Run, motors: &Motors, guess: &Guess) -> Fault {
    let stem = |blame: Blame| match blame {
        Blame::Drive => motors.drive,
        Blame::Speed => "w",
        Blame::Current => "i",
    };
    let drive = if motors.drive == "u" { "voltages" } else { "set speeds" };
    let with = match guess.blame {
        Blame::Speed if motors.currents => "voltages and currents".to_string(),
        Blame::Speed => drive.to_string(),
        Blame::Current => "voltages and wheel speeds".to_string(),
        Blame::Drive if motors.currents => "wheel speeds and currents".to_string(),
        Blame::Drive => "wheel speeds".to_string(),
    };
    let name = stem(guess.blame);
    let signal = [&[guess.blame], &guess.or[..]].concat().into_iter().map(stem).collect::<Vec<_>>().join(", ");
    let better = format!("the `{name}` columns fit the {with} {:.0} times better so.", guess.better);
    let or: String = guess.or.iter().map(|&b| format!(" It may be the `{}` columns instead.", stem(b))).collect();
    let (code, what, fix) = match &guess.what {
        What::Unit(unit) => (
            "wrong_unit",
            format!("The `{name}` columns look like {}", unit.name),
            "Convert the columns to SI units, or state `unit` in columns.toml.",
        ),
        What::Wheels(order) if order.moved() => {
            ("swapped_wheels", order.words(name), "Put the columns into wheel order, or change `from` in columns.toml.")
        }
        What::Wheels(order) => ("wrong_sign", order.words(name), "Turn the sign, or set sign = -1 in columns.toml."),
    };
    Fault::of(run, code, signal, true).says(format!("{what}: {better}{or}"), fix)
}

/// By what factor the drive of each run is a duty cycle. A log writes one or the other, so that what half of the runs
/// say holds for those too that say nothing, where their drive is no larger.
fn duties(runs: &[(&Run, Motors)], robot: &RobotFile) -> Vec<Option<f64>> {
    let top = |run: &Run| run.u.iter().flat_map(|u| &u.channels).map(largest).fold(0.0, f64::max);
    let own: Vec<Option<f64>> = runs.iter().map(|(run, motors)| motors.duty(top(run), robot)).collect();
    let said: Vec<usize> = (0..runs.len()).filter(|k| own[*k].is_some()).collect();
    if said.is_empty() || 2 * said.len() < runs.len() {
        return own;
    }
    let most = said.iter().map(|k| top(runs[*k].0)).fold(0.0, f64::max);
    let usual = own[said[0]];
    runs.iter().zip(&own).map(|((run, _), own)| own.or(usual.filter(|_| top(run) <= most))).collect()
}

fn duty_told(run: &Run, factor: f64) -> Fault {
    let factor = if factor < 1.0 {
        format!("{:.0} times too small", 1.0 / factor)
    } else {
        format!("{factor:.0} times too large")
    };
    let sentence = format!(
        "The `u` columns are {factor} for the wheel speeds and currents, all by one factor: they look like a duty cycle, expected volts."
    );
    let fix = "Multiply the duty by the supply voltage over its full scale, with `scale` in columns.toml.";
    Fault::of(run, "duty_for_volts", "u", true).says(sentence, fix)
}

/// Currents far above what the supply could drive through a motor held still.
fn stall(run: &Run, robot: &RobotFile) -> Option<Fault> {
    let (group, supply) = (run.i.as_ref()?, run.supply_v(robot)?);
    let stall_a = 2.0 * supply / robot.motor.resistance_ohm;
    let mut all: Vec<f64> = group.channels.iter().flat_map(|c| c.present()).map(|(_, i)| i.abs()).collect();
    let rank = all.len() * 9 / 10;
    let high = ranked(&mut all, rank).unwrap_or(0.0);
    if high < 10.0 * stall_a {
        return None;
    }
    let sentence = format!(
        "The `i` columns look like milliamperes: a tenth of them exceed {high:.0} A, a stalled motor draws {:.1} A.",
        stall_a / 2.0
    );
    let fix = "Convert the columns to amperes, or state `unit` in columns.toml.";
    Some(Fault::of(run, "wrong_unit", "i", true).says(sentence, fix))
}
