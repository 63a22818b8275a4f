//! Suites: which sessions a split has, and how each is drawn from its seed.

use std::collections::BTreeMap;

use ground_truth::causes::{CAUSES, Cause};
use ground_truth::drawn::Drawn;
use ground_truth::drawn_robot::DrawnRobot;
use ground_truth::recording::{Plan, Session};
use ground_truth::sizing::Trial;

use super::label::{Hidden, Label, Severity, Suite};

/// How many sessions of each suite.
pub type Sizes = [(Suite, usize); 2];

/// A whole split.
pub const WHOLE: Sizes = [(Suite::Laboratory, 250), (Suite::NoGap, 150)];

/// What the test command takes on.
pub const REDUCED: Sizes = [(Suite::Laboratory, 30), (Suite::NoGap, 10)];

/// One session of a split.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Case {
    /// What it asks.
    pub suite: Suite,
    /// Its number in its suite.
    pub number: usize,
    /// Of everything that is drawn in it.
    pub seed: u64,
}

/// Of supply, what motors are given at most [1]
const DRIVEN: f64 = 2.0 / 3.0;

/// Gaps are measured on so much of a drive [s]
const TRIED_S: f64 = 6.0;

/// Severities take turns.
const SEVERITIES: [Severity; 3] = [Severity::Weak, Severity::Medium, Severity::Strong];

/// All sessions of a split by its seed.
pub fn cases(sizes: &[(Suite, usize)], seed: u64) -> Vec<Case> {
    let of = |(at, (suite, count)): (u64, &(Suite, usize))| {
        let suite = *suite;
        (0..*count).map(move |number| Case { suite, number, seed: mixed(seed ^ mixed(at << 32 | number as u64)) })
    };
    (0..).zip(sizes).flat_map(of).collect()
}

/// Another number by each seed, all bits of which depend on all of its (Steele, Lea and Flood, `SplitMix64`, 2014).
fn mixed(seed: u64) -> u64 {
    let z = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

impl Case {
    /// Name of its folder.
    pub fn name(&self) -> String {
        format!("{}-{:03}", self.suite.name(), self.number)
    }

    /// Recordings and label.
    pub fn made(&self) -> (Session, Label) {
        let cause = (self.suite != Suite::NoGap).then(|| &CAUSES[self.number % CAUSES.len()]);
        let keys = cause.map_or(&[][..], |cause| cause.keys);
        let robot = DrawnRobot::new(self.seed).with_true(keys);
        let mut drawn = Drawn::new(mixed(self.seed));
        let plan = plan(&robot, cause, &mut drawn);
        let trial = Trial { truth: &robot.truth, voltage: plan.voltage, seed: self.seed, seconds: TRIED_S };
        let hidden = cause.map(|cause| self.hidden(cause, &robot, &trial, &mut drawn));
        let setup = match (&cause, &hidden) {
            (Some(cause), Some(hidden)) => trial.with(cause, hidden.wheel, hidden.times),
            _ => robot.truth.setup(),
        };
        let label = Label {
            session: self.name(),
            suite: self.suite,
            seed: self.seed,
            hidden: hidden.into_iter().collect(),
            foreign: None,
            far_off: robot.far_off.map_or_else(Vec::new, |key| causes_of(key).map(str::to_owned).collect()),
            about: about(&robot, &plan),
        };
        (Session::of(&robot.file, &setup, &plan, self.seed), label)
    }

    /// A cause on a wheel if it sits on one, as large as its turn asks for.
    fn hidden(&self, cause: &Cause, robot: &DrawnRobot, trial: &Trial<'_>, drawn: &mut Drawn) -> Hidden {
        let wheel = drawn.below(robot.truth.wheels.len() as u32) as usize;
        let wheel = cause.one_wheel.then_some(wheel);
        let (low, high) = SEVERITIES[(self.number / CAUSES.len()) % SEVERITIES.len()].range();
        let asked = drawn.log_between(low, high);
        let sized = trial.sized(cause, wheel, asked);
        Hidden { cause: cause.id.to_owned(), wheel, times: sized.times, gap: sized.gap }
    }
}

/// Causes that name a number of the robot file.
fn causes_of(key: &str) -> impl Iterator<Item = &'static str> {
    CAUSES.iter().filter(move |cause| cause.keys.contains(&key)).map(|cause| cause.id)
}

fn plan(robot: &DrawnRobot, cause: Option<&Cause>, drawn: &mut Drawn) -> Plan {
    let gyro = drawn.below(2) == 0;
    Plan {
        runs: 6,
        duration: 6.0,
        rate: [100.0, 200.0, 500.0][drawn.below(3) as usize],
        camera_rate: drawn.between(25.0, 90.0).round(),
        voltage: DRIVEN * robot.truth.supply,
        // what only a gyro shows needs one
        gyro: gyro || cause.is_some_and(|cause| cause.id == "gyro_bias"),
    }
}

fn about(robot: &DrawnRobot, plan: &Plan) -> BTreeMap<String, String> {
    let degrees: Vec<String> = robot.truth.wheels.iter().map(|wheel| format!("{:.0}", wheel.0)).collect();
    let all = [
        ("mass_kg", format!("{:.3}", robot.truth.mass)),
        ("drive_angles_deg", degrees.join(" ")),
        ("rate_hz", plan.rate.to_string()),
        ("camera_rate_hz", plan.camera_rate.to_string()),
        ("gyro", plan.gyro.to_string()),
        ("runs", plan.runs.to_string()),
        ("duration_s", plan.duration.to_string()),
    ];
    all.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_sessions_share_a_seed_or_a_name_and_splits_share_none() {
        let mut seeds: Vec<u64> =
            [1, 2].into_iter().flat_map(|seed| cases(&WHOLE, seed)).map(|case| case.seed).collect();
        let all = seeds.len();
        seeds.sort_unstable();
        seeds.dedup();
        assert_eq!(seeds.len(), all);
        let mut names: Vec<String> = cases(&WHOLE, 1).iter().map(Case::name).collect();
        names.dedup();
        assert_eq!(2 * names.len(), all);
    }

    #[test]
    fn every_cause_of_the_second_simulator_is_one_of_the_catalogue() {
        for cause in CAUSES {
            assert!(super::super::scored::stage_of(cause.id).is_some(), "{}", cause.id);
        }
    }

    #[test]
    fn a_session_hides_what_its_label_says_at_the_size_that_was_asked_for() {
        let coriolis = CAUSES.iter().position(|cause| cause.id == "coriolis").expect("a cause");
        let case = Case { suite: Suite::Laboratory, number: coriolis + CAUSES.len(), seed: 5 };
        let (session, label) = case.made();
        assert_eq!(case.made(), (session.clone(), label.clone()), "the same bits from the same seed");
        assert_eq!((label.hidden[0].cause.as_str(), label.severity()), ("coriolis", Some(Severity::Medium)));
        assert_eq!(session.runs.len(), 6);
        let (_, nothing) = Case { suite: Suite::NoGap, number: 3, seed: 6 }.made();
        assert!(nothing.nothing());
    }
}
