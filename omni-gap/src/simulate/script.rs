//! # The experiments of the paper, as inputs that a robot can play
//!
//! ```text
//! spin    experiment 1: ω alone, the voltage ramped from level to level and held         → B_ω, C_ω   (eq. 23)
//! coast   experiment 2: up to speed on one axis, then the bridges open                   → B, C, J    (eq. 24–27)
//! motor   the motor's: ω alone at held voltages, repeated with more and more to drag     → R, K_v     (eq. 29)
//! step    experiment 3: one axis, a step with an initial ramp, forth and back            → R, J, B, C_ω (eq. 38–42)
//! ```
//!
//! Every run begins and ends at rest and comes back to where it began. An experiment is told by the name of its runs:
//! `coast-vn-1` belongs to experiment 2.

use model_core::geometry::kinematics::Wheels;
use model_core::plant::Input;
use model_core::plant::robot::Robot;

use super::terms::terms;
use crate::log::{Channel, Group, Missing, Run};

/// One of the experiments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Experiment {
    /// Experiment 1: steady spinning.
    Spin,
    /// Experiment 2: coasting with the bridges open.
    Coast,
    /// The motor's resistance and constant.
    Motor,
    /// Experiment 3: a step with an initial ramp.
    Step,
}

impl Experiment {
    /// All of them, in the order in which they are done.
    pub const ALL: [Experiment; 4] = [Self::Spin, Self::Coast, Self::Motor, Self::Step];

    /// The word with which its runs' names begin.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Spin => "spin",
            Self::Coast => "coast",
            Self::Motor => "motor",
            Self::Step => "step",
        }
    }

    /// What the paper calls it.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Spin => "experiment 1 (steady spin)",
            Self::Coast => "experiment 2 (coast-down)",
            Self::Motor => "motor experiment",
            Self::Step => "experiment 3 (step with initial ramp)",
        }
    }

    /// The experiment that goes by this on a command line: its word, or its number in the paper.
    pub fn named(text: &str) -> Option<Self> {
        let numbered = [("1", Self::Spin), ("2", Self::Coast), ("3", Self::Step)];
        let by_number = numbered.into_iter().find(|(number, _)| *number == text).map(|(_, e)| e);
        by_number.or_else(|| Self::ALL.into_iter().find(|e| e.word() == text))
    }

    /// What the names of its runs look like.
    pub const fn names(self) -> &'static str {
        match self {
            Self::Spin => "spin-left, spin-right",
            Self::Coast => "coast-v-1, coast-vn-1, coast-w-1, …",
            Self::Motor => "motor-load-0, motor-load-1, …",
            Self::Step => "step-v-50-1, step-vn-50-1, step-w-50-1, …",
        }
    }

    /// The experiment that a run of this name belongs to.
    pub fn of(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|e| name.starts_with(e.word()))
    }
}

/// The body axes, as they are named in the names of runs.
pub const AXES: [&str; 3] = ["v", "vn", "w"];

/// What to play.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// Rows a second [1/s]
    pub rate: f64,
    /// Largest voltage on any motor [V]
    pub voltage: f64,
    /// Side of the free floor [m]
    pub field: f64,
    /// How often the coast-downs and the steps are repeated.
    pub repeats: usize,
    /// Runs of the motor experiment, each with more to drag.
    pub loads: usize,
}

/// The input of one run.
#[derive(Clone, Debug, PartialEq)]
pub struct Script<const N: usize> {
    /// The run's name.
    pub name: String,
    /// Time of each row [s]
    pub t: Vec<f64>,
    /// Motor voltages of each row [V]; `None`: the bridges are open
    pub volts: Vec<Option<[f64; N]>>,
}

/// Figures after the point of a voltage in a file [1/V]
const TENTHS_OF_A_MILLIVOLT: f64 = 1e4;

impl<const N: usize> Script<N> {
    /// What drives a plant, row by row; open bridges are motors without current.
    pub fn inputs(&self) -> impl Iterator<Item = Input<N, f64>> + '_ {
        self.volts.iter().map(|u| u.map_or(Input::Bridges([None; N]), Input::Voltage))
    }

    /// The script as a run that nothing was measured in: `u` and `enable`, blank and zero where the bridges are open.
    ///
    /// Voltages are cut to tenths of a millivolt, towards zero.
    pub fn to_run(&self) -> Run {
        let cut = |volts: f64| (volts * TENTHS_OF_A_MILLIVOLT).trunc() / TENTHS_OF_A_MILLIVOLT + 0.0;
        let wheel = |j: usize| self.volts.iter().map(move |u| u.map(|u| cut(u[j])).ok_or(Missing::Open)).collect();
        Run {
            name: self.name.clone(),
            t_s: self.t.clone(),
            u: Some(Group::new((0..N).map(wheel).collect())),
            enable: Some(Channel::from_values(self.volts.iter().map(|u| f64::from(u8::from(u.is_some()))))),
            ..Run::default()
        }
    }
}

/// Share of the free floor that a run may use.
const OF_THE_FIELD: f64 = 0.7;
/// Length of a ramp [s]
const RAMP: f64 = 0.3;
/// Rest before and after [s]
const REST: f64 = 0.4;
/// Levels of the spin, as shares of the largest voltage.
const SPIN_LEVELS: [f64; 6] = [0.25, 0.4, 0.55, 0.7, 0.85, 1.0];
/// Levels of the steps, as shares of the largest voltage.
const STEP_LEVELS: [f64; 3] = [0.5, 0.75, 1.0];

/// The scripts of all experiments for a robot: `robot` is what is known of it so far.
pub fn scripts<const N: usize>(robot: &Robot<N, f64>, plan: &Plan) -> Vec<Script<N>> {
    let mut all = Vec::new();
    for (sign, name) in [(1.0, "spin-left"), (-1.0, "spin-right")] {
        let mut writer = Writer::new(robot, plan, 2);
        for level in SPIN_LEVELS {
            writer.ramp(sign * level).hold(sign * level, 2.0);
        }
        all.push(writer.ramp(0.0).rest(3.0 * REST).done(name));
    }
    for repeat in 1..=plan.repeats {
        for (axis, name) in AXES.iter().enumerate() {
            let mut writer = Writer::new(robot, plan, axis);
            for sign in [1.0, -1.0] {
                let hold = writer.time_for(axis, 1.0, 0.35).min(0.8);
                writer.ramp(sign).hold(sign, hold).open(2.2);
            }
            all.push(writer.rest(REST).done(&format!("coast-{name}-{repeat}")));
        }
    }
    for load in 0..plan.loads {
        let mut writer = Writer::new(robot, plan, 2);
        for level in [0.4, 0.6, 0.8, 1.0] {
            writer.ramp(level).hold(level, 2.0);
        }
        all.push(writer.ramp(0.0).rest(3.0 * REST).done(&format!("motor-load-{load}")));
    }
    for repeat in 1..=plan.repeats {
        for (axis, name) in AXES.iter().enumerate() {
            for level in STEP_LEVELS {
                let mut writer = Writer::new(robot, plan, axis);
                let hold = writer.time_for(axis, level, 1.0).min(1.4);
                for sign in [1.0, -1.0] {
                    writer.ramp(sign * level).hold(sign * level, hold).ramp(0.0).rest(REST);
                }
                all.push(writer.done(&format!("step-{name}-{:.0}-{repeat}", 100.0 * level)));
            }
        }
    }
    all
}

/// Writes a script row by row.
struct Writer<'a, const N: usize> {
    robot: &'a Robot<N, f64>,
    plan: &'a Plan,
    axis: usize,
    level: f64,
    volts: Vec<Option<[f64; N]>>,
}

impl<'a, const N: usize> Writer<'a, N> {
    fn new(robot: &'a Robot<N, f64>, plan: &'a Plan, axis: usize) -> Self {
        let mut writer = Self { robot, plan, axis, level: 0.0, volts: Vec::new() };
        writer.rest(REST);
        writer
    }

    fn rows(&self, seconds: f64) -> usize {
        ((seconds * self.plan.rate).round() as usize).max(1)
    }

    /// Goes evenly from the level that stands to another, a share of the largest voltage.
    fn ramp(&mut self, to: f64) -> &mut Self {
        let (from, rows) = (self.level, self.rows(RAMP));
        for k in 1..=rows {
            let level = from + (to - from) * k as f64 / rows as f64;
            self.volts.push(Some(along(&self.robot.wheels, self.axis, level * self.plan.voltage)));
        }
        self.level = to;
        self
    }

    fn hold(&mut self, level: f64, seconds: f64) -> &mut Self {
        let volts = along(&self.robot.wheels, self.axis, level * self.plan.voltage);
        self.volts.resize(self.volts.len() + self.rows(seconds), Some(volts));
        self.level = level;
        self
    }

    fn rest(&mut self, seconds: f64) -> &mut Self {
        self.hold(0.0, seconds)
    }

    fn open(&mut self, seconds: f64) -> &mut Self {
        self.volts.resize(self.volts.len() + self.rows(seconds), None);
        self.level = 0.0;
        self
    }

    /// How long a level can be held before the given share of what the field allows is used up [s].
    fn time_for(&self, axis: usize, level: f64, share: f64) -> f64 {
        if axis == 2 {
            return f64::INFINITY;
        }
        let speed = final_speed(self.robot, axis, level * self.plan.voltage).max(0.05);
        (share * OF_THE_FIELD * self.plan.field / speed - RAMP).max(0.2)
    }

    fn done(&mut self, name: &str) -> Script<N> {
        let volts = std::mem::take(&mut self.volts);
        let t = (0..volts.len()).map(|row| row as f64 / self.plan.rate).collect();
        Script { name: name.to_owned(), t, volts }
    }
}

/// The motor voltages that drive one axis alone, the largest of them `volts` [V].
pub fn along<const N: usize>(wheels: &Wheels<N, f64>, axis: usize, volts: f64) -> [f64; N] {
    let share = wheels.rows().map(|row| row[axis]);
    let most = share.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    share.map(|x| if most > 0.0 { x / most * volts } else { 0.0 })
}

/// The speed that an axis comes to under a voltage, by the plain model [m/s] or [rad/s].
pub(super) fn final_speed<const N: usize>(robot: &Robot<N, f64>, axis: usize, volts: f64) -> f64 {
    terms(robot, axis, along(&robot.wheels, axis, volts)).final_speed()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::log::{Catalogue, RobotFile};
    use crate::simulate::robot_of;
    use std::path::Path;

    fn robot() -> Robot<3, f64> {
        let text = include_str!("../../robots/feup-3w/robot.toml");
        robot_of(&RobotFile::parse(text, Path::new("robot.toml"), &Catalogue::default()).unwrap(), 12.0)
    }

    const PLAN: Plan = Plan { rate: 25.0, voltage: 8.0, field: 3.0, repeats: 1, loads: 3 };

    #[test]
    fn every_run_tells_its_experiment_and_begins_and_ends_at_rest() {
        let all = scripts(&robot(), &PLAN);
        for experiment in Experiment::ALL {
            assert!(all.iter().any(|s| Experiment::of(&s.name) == Some(experiment)), "{experiment:?}");
        }
        for script in &all {
            let at_rest = |u: &Option<[f64; 3]>| *u == Some([0.0; 3]);
            assert!(at_rest(&script.volts[0]) && at_rest(script.volts.last().unwrap()), "{}", script.name);
            assert!(script.volts.iter().flatten().flatten().all(|u| u.abs() <= 8.0 + 1e-9), "{}", script.name);
            assert_eq!(script.t.len(), script.volts.len());
        }
    }

    #[test]
    fn an_experiment_goes_by_its_word_and_by_its_number() {
        assert_eq!(Experiment::named("3"), Some(Experiment::Step));
        assert_eq!(Experiment::named("motor"), Some(Experiment::Motor));
        assert_eq!(Experiment::named("4"), None);
        for experiment in Experiment::ALL {
            assert!(experiment.names().split(", ").all(|n| n == "…" || Experiment::of(n) == Some(experiment)));
        }
    }

    #[test]
    fn one_axis_alone_is_driven() {
        let wheels = robot().wheels;
        for axis in 0..3 {
            let u = along(&wheels, axis, 6.0);
            for other in (0..3).filter(|other| *other != axis) {
                let push: f64 = wheels.rows().iter().zip(u).map(|(row, u)| row[other] * u).sum();
                assert!(push.abs() < 1e-12, "{axis} pushes {other}");
            }
        }
        assert!((along(&wheels, 0, 6.0)[2] - 6.0).abs() < 1e-12 && along(&wheels, 0, 6.0)[1].abs() < 1e-12);
    }

    #[test]
    fn the_final_speed_is_where_the_papers_forces_balance() {
        // 2·sin(π/3)·l·Kt/(r·R)·6 V = (3·Kt²·l²/(2·r²·R) + Bv)·v + Cv
        let drive = 3f64.sqrt() * 5.0 * 0.0259 / (0.0325 * 4.3111) * 6.0;
        let brake = 1.5 * (5.0 * 0.0259 / 0.0325_f64).powi(2) / 4.3111 + 0.5082;
        assert!((final_speed(&robot(), 0, 6.0) - (drive - 1.9068) / brake).abs() < 1e-12);
    }
}
