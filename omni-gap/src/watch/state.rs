//! The watch: shown rows, it gives readings.

use rayon::prelude::*;

use super::alarms::Alarms;
use super::errors::{Errors, Model};
use super::reading::{GroupError, Reading, StageError};
use super::rule::Rule;
use super::window::{AFTER_S, BEFORE_S, Window, lost, mean, rows};
use crate::localise::Link;
use crate::log::{RobotFile, Run};
use crate::simulate::{self, SignalGroup};

/// A watch over a robot.
#[derive(Clone, Debug)]
pub struct Watch {
    rule: Rule,
    robot: RobotFile,
    /// Which window is next.
    window: u64,
    alarms: Alarms,
    at: At,
}

/// How far the model is, by the number of wheels.
#[derive(Clone, Debug)]
enum At {
    Three(Box<OnTheWay<3>>),
    Four(Box<OnTheWay<4>>),
}

/// How far a model is.
#[derive(Clone, Debug, Default)]
struct OnTheWay<const N: usize> {
    /// None before the first window: the supply may have to be seen.
    model: Option<Model<N>>,
    /// By how much the wheels have turned [rad], where that is measured
    turned: Option<[f64; N]>,
}

impl Watch {
    /// A watch that has seen nothing.
    pub fn new(robot: &RobotFile, rule: Rule) -> Self {
        let at = match robot.wheel.len() {
            3 => At::Three(Box::default()),
            _ => At::Four(Box::default()),
        };
        Self { rule, robot: robot.clone(), window: 0, alarms: Alarms::default(), at }
    }

    /// Its rule.
    pub fn rule(&self) -> &Rule {
        &self.rule
    }

    /// Rows before this time are not needed any more [s]
    pub fn needs_from_s(&self) -> f64 {
        self.begins_s() - BEFORE_S
    }

    /// Rows up to this time are needed for the next reading [s]
    pub fn needs_to_s(&self) -> f64 {
        self.to_s() + AFTER_S
    }

    /// Where the next window ends [s]
    pub fn to_s(&self) -> f64 {
        (self.window + 1) as f64 * self.rule.window_s
    }

    fn begins_s(&self) -> f64 {
        self.window as f64 * self.rule.window_s
    }

    /// Reads the next window off a run whose times are those since the watch began, and which has the rows that are needed.
    /// Where the window has no rows, it goes on to the one that has the next row, and tells nothing.
    pub fn read(&mut self, run: &Run) -> Option<Reading> {
        let (from_s, to_s) = (self.begins_s(), self.to_s());
        let here = rows(run, from_s..to_s);
        if here.is_empty() {
            let next = run.t_s.get(here.end).map_or(self.window + 1, |t| (t / self.rule.window_s) as u64);
            self.window = next.max(self.window + 1);
            return None;
        }
        let lost_rows = lost(run, here.clone());
        let heard = lost_rows as f64 <= self.rule.most_lost * here.len() as f64;
        let (measured, simulated) = match &mut self.at {
            At::Three(at) => at.compared(run, &self.robot, &self.rule, self.window),
            At::Four(at) => at.compared(run, &self.robot, &self.rule, self.window),
        }
        .unwrap_or_default();
        let mut reading = Reading {
            from_s,
            to_s,
            rows: here.len(),
            lost_rows,
            judged: heard && measured.stages.iter().any(Option::is_some),
            battery_v: run.vbat.as_ref().and_then(|vbat| mean(vbat, here)),
            groups: groups(&measured, &simulated),
            stages: Vec::new(),
            alarm: None,
            alarm_began: false,
        };
        for link in Link::ALL {
            let of = |errors: &Errors| errors.stages[link as usize];
            let Some((error, floor)) = of(&measured).zip(rms(simulated.iter().filter_map(of))) else { continue };
            let largest = simulated.iter().filter_map(of).fold(0.0, f64::max);
            let limit = largest.max(floor + self.rule.margin_sigma);
            if heard {
                self.alarms.note(&self.rule, link, from_s, error / limit);
            }
            let (stage, above, score) = (link.name(), error > limit, self.alarms.score(link));
            reading.stages.push(StageError { stage, error, floor, limit, above, score });
        }
        reading.alarm_began = self.alarms.settle(&self.rule);
        reading.alarm = self.alarms.on();
        self.window += 1;
        Some(reading)
    }
}

impl<const N: usize> OnTheWay<N> {
    /// The errors of a window, and those of simulated ones; goes on to its end. None where nothing drives a model.
    fn compared(&mut self, run: &Run, robot: &RobotFile, rule: &Rule, window: u64) -> Option<(Errors, Vec<Errors>)> {
        let from_s = window as f64 * rule.window_s;
        let laid = Window::laid(run, robot, from_s..from_s + rule.window_s, rule.horizon_s, self.turned)?;
        let nominal = || simulate::Model::nominal(robot, run.supply_v(robot).unwrap_or(1.0));
        let model = self.model.get_or_insert_with(|| Model::new(nominal().plant()));
        let measured = model.errors(&laid);
        let draws = u64::from(rule.simulated);
        let simulated = (0..draws).into_par_iter().map(|k| model.simulated(&laid, window * draws + k)).collect();
        model.pass(&laid);
        self.turned = laid.run.turned(laid.rows.end.min(laid.run.rows() - 1)).or(self.turned);
        Some((measured, simulated))
    }
}

fn groups(measured: &Errors, simulated: &[Errors]) -> Vec<GroupError> {
    let told = |group: SignalGroup| {
        let of = |errors: &Errors| errors.groups[group as usize];
        let floor = rms(simulated.iter().filter_map(of))?;
        Some(GroupError { group: group.name(), error: of(measured)?, floor })
    };
    SignalGroup::ALL.into_iter().filter_map(told).collect()
}

/// The root of the mean square; none of nothing.
fn rms(errors: impl Iterator<Item = f64>) -> Option<f64> {
    let squares: Vec<f64> = errors.map(|error| error * error).collect();
    (!squares.is_empty()).then(|| (squares.iter().sum::<f64>() / squares.len() as f64).sqrt())
}
