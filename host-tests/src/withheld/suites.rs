//! Suites: which sessions a split has, and how each is drawn from its seed.

use std::collections::BTreeMap;

use ground_truth::causes::{CAUSES, Cause};
use ground_truth::drawn::Drawn;
use ground_truth::drawn_robot::DrawnRobot;
use ground_truth::recording::{Plan, Session};
use ground_truth::sizing::{Sized, Trial};

use super::label::{Hidden, Label, Severity, Suite};

/// How many sessions of each suite.
pub type Sizes = [(Suite, usize); 3];

/// A whole split.
pub const WHOLE: Sizes = [(Suite::Laboratory, 250), (Suite::NoGap, 150), (Suite::Several, 150)];

/// What the test command takes on.
pub const REDUCED: Sizes = [(Suite::Laboratory, 24), (Suite::NoGap, 8), (Suite::Several, 8)];

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
        let mut drawn = Drawn::new(mixed(self.seed));
        let causes = self.causes(&mut drawn);
        let keys: Vec<&str> = causes.iter().flat_map(|cause| cause.keys).copied().collect();
        let robot = DrawnRobot::new(self.seed).with_true(&keys);
        let plan = plan(&robot, &causes, &mut drawn);
        let trial = Trial { truth: &robot.truth, voltage: plan.voltage, seed: self.seed, seconds: TRIED_S };
        let mut setup = robot.truth.setup();
        let mut hidden: Vec<Hidden> = Vec::new();
        for cause in causes {
            let one = self.hidden(cause, &trial, &mut drawn);
            (cause.put)(&mut setup, one.wheel, one.times);
            hidden.push(one);
        }
        hidden.sort_by(|a, b| b.gap.total_cmp(&a.gap));
        let label = Label {
            session: self.name(),
            suite: self.suite,
            seed: self.seed,
            hidden,
            foreign: None,
            far_off: robot.far_off.map_or_else(Vec::new, |key| causes_of(key).map(str::to_owned).collect()),
            about: about(&robot, &plan),
        };
        (Session::of(&robot.file, &setup, &plan, self.seed), label)
    }

    /// What is hidden: by turns, or drawn.
    fn causes(&self, drawn: &mut Drawn) -> Vec<&'static Cause> {
        match self.suite {
            Suite::NoGap => Vec::new(),
            Suite::Several => several(self.number, drawn),
            _ => vec![&CAUSES[self.number % CAUSES.len()]],
        }
    }

    /// A cause on a wheel if it sits on one, as large as its turn asks for.
    fn hidden(&self, cause: &Cause, trial: &Trial<'_>, drawn: &mut Drawn) -> Hidden {
        let wheel = drawn.below(trial.truth.wheels.len() as u32) as usize;
        let wheel = cause.one_wheel.then_some(wheel);
        let several = self.suite == Suite::Several;
        let sized = if several && !cause.keys.is_empty() {
            let times = wrong_by(drawn);
            Sized { times, gap: trial.gap(&trial.with(cause, wheel, times)) }
        } else {
            let turn = SEVERITIES[(self.number / CAUSES.len()) % SEVERITIES.len()];
            let (low, high) = if several { Severity::Medium } else { turn }.range();
            trial.sized(cause, wheel, drawn.log_between(low, high))
        };
        Hidden { cause: cause.id.to_owned(), wheel, times: sized.times, gap: sized.gap }
    }
}

/// Of fifteen sessions with several causes, so many have two effects, and so many of the others three; the rest have wrong
/// numbers.
const SEVERAL: [usize; 3] = [6, 4, 15];

/// Two effects, three, or three to five numbers that are wrong, no two of which are the same number.
fn several(number: usize, drawn: &mut Drawn) -> Vec<&'static Cause> {
    let turn = number % SEVERAL[2];
    let (numbers, count) = match turn {
        _ if turn < SEVERAL[0] => (false, 2),
        _ if turn < SEVERAL[0] + SEVERAL[1] => (false, 3),
        _ => (true, 3 + drawn.below(3) as usize),
    };
    let kind: Vec<&Cause> = CAUSES.iter().filter(|cause| cause.keys.is_empty() != numbers).collect();
    let mut chosen: Vec<&'static Cause> = Vec::new();
    while chosen.len() < count {
        let next = kind[drawn.below(kind.len() as u32) as usize];
        let twice = |other: &&Cause| other.id == next.id || other.keys.iter().any(|key| next.keys.contains(key));
        if !chosen.iter().any(twice) {
            chosen.push(next);
        }
    }
    chosen
}

/// By how many times three stated sigmas a number is wrong, one way or the other: a friction can only be a little less than
/// half of what it was thought to be.
fn wrong_by(drawn: &mut Drawn) -> f64 {
    if drawn.below(2) == 0 { drawn.between(1.0, 2.0) } else { -drawn.between(1.0, 1.2) }
}

/// Causes that name a number of the robot file.
fn causes_of(key: &str) -> impl Iterator<Item = &'static str> {
    CAUSES.iter().filter(move |cause| cause.keys.contains(&key)).map(|cause| cause.id)
}

fn plan(robot: &DrawnRobot, causes: &[&Cause], drawn: &mut Drawn) -> Plan {
    let gyro = drawn.below(2) == 0;
    Plan {
        runs: 6,
        duration: 6.0,
        rate: [100.0, 200.0, 500.0][drawn.below(3) as usize],
        camera_rate: drawn.between(25.0, 90.0).round(),
        voltage: DRIVEN * robot.truth.supply,
        // what only a gyro shows needs one
        gyro: gyro || causes.iter().any(|cause| cause.id == "gyro_bias"),
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

    #[test]
    fn several_causes_are_two_or_three_effects_or_three_to_five_numbers() {
        let mut drawn = Drawn::new(3);
        let mut counts = [0; 3];
        for number in 0..150 {
            let causes = several(number, &mut drawn);
            let numbers = causes.iter().filter(|cause| !cause.keys.is_empty()).count();
            let mut keys: Vec<&str> = causes.iter().flat_map(|cause| cause.keys).copied().collect();
            let all = keys.len();
            keys.sort_unstable();
            keys.dedup();
            assert_eq!(keys.len(), all, "a number that is wrong twice");
            match (numbers, causes.len()) {
                (0, 2) => counts[0] += 1,
                (0, 3) => counts[1] += 1,
                (3..=5, all) if all == numbers => counts[2] += 1,
                other => panic!("{other:?}"),
            }
        }
        assert_eq!(counts, [60, 40, 50]);
    }
}
