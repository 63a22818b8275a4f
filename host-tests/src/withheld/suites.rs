//! Suites: which sessions a split has, and how each is drawn from its seed.

use std::collections::BTreeMap;

use ground_truth::causes::{CAUSES, Cause};
use ground_truth::drawn::Drawn;
use ground_truth::drawn_robot::DrawnRobot;
use ground_truth::driving::Style;
use ground_truth::foreign::{FOREIGN, Foreign};
use ground_truth::gap::ROW_S;
use ground_truth::logging::Logging;
use ground_truth::recording::{Plan, Session};
use ground_truth::robot_file::{Noise, RobotFile};
use ground_truth::setup::Setup;
use ground_truth::sizing::{BOUNDS, Sized, Trial};

use super::label::{Hidden, Label, Severity, Suite};

/// How many sessions of each suite.
pub type Sizes = [(Suite, usize); 5];

/// A whole split.
pub const WHOLE: Sizes =
    [(Suite::Laboratory, 250), (Suite::NoGap, 150), (Suite::Several, 150), (Suite::Life, 400), (Suite::Open, 150)];

/// A quick look: a few of each.
pub const REDUCED: Sizes =
    [(Suite::Laboratory, 12), (Suite::NoGap, 6), (Suite::Several, 4), (Suite::Life, 12), (Suite::Open, 6)];

/// One session of a split.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Case {
    /// What it asks.
    pub suite: Suite,
    /// Its number in its suite.
    pub number: usize,
    /// Of everything that is drawn in it.
    pub seed: u64,
    /// Whether it may hide what is kept for splits that nobody has seen.
    pub fresh: bool,
}

/// Of supply, what motors are given at most [1]
const DRIVEN: f64 = 2.0 / 3.0;

/// Gaps are measured on so much of a drive [s]
const TRIED_S: f64 = 6.0;

/// From one cause to the next, which shares no divisor with their number [causes]
const STRIDE: usize = 23;

/// Severities take turns.
const SEVERITIES: [Severity; 3] = [Severity::Weak, Severity::Medium, Severity::Strong];

/// All sessions of a split by its seed; `fresh` ones may hide what is in no other split.
pub fn cases(sizes: &[(Suite, usize)], seed: u64, fresh: bool) -> Vec<Case> {
    let of = |(at, (suite, count)): (u64, &(Suite, usize))| {
        let suite = *suite;
        (0..*count).map(move |number| Case {
            suite,
            number,
            seed: mixed(seed ^ mixed(at << 32 | number as u64)),
            fresh,
        })
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
        let (mut plan, logging) = self.logged(&robot, &mut drawn);
        // what only a gyro shows needs one
        plan.gyro |= causes.iter().any(|cause| cause.id == "gyro_bias");
        let seen = what_is_seen(&robot.truth, &plan, &logging);
        let trial = Trial {
            truth: &seen,
            voltage: plan.voltage,
            style: plan.style,
            seed: self.seed,
            seconds: TRIED_S,
            row: ROW_S,
        };
        let mut setup = robot.truth.setup();
        let mut hidden: Vec<Hidden> = Vec::new();
        for cause in causes {
            let one = self.hidden(cause, &trial, &mut drawn);
            (cause.put)(&mut setup, one.wheel, one.times);
            hidden.push(one);
        }
        hidden.sort_by(|a, b| b.gap.total_cmp(&a.gap));
        let mut about = about(&robot, &plan, &logging);
        let foreign = self.foreign();
        if let Some(foreign) = foreign {
            let (low, high) = [Severity::Medium, Severity::Strong][self.number % 2].range();
            let put = |setup: &mut Setup, times: f64| (foreign.put)(setup, times, self.seed);
            let sized = trial.sized_by(drawn.log_between(low, high), BOUNDS.0, &put);
            put(&mut setup, sized.times);
            about.insert("foreign_times".to_owned(), sized.times.to_string());
            about.insert("foreign_gap".to_owned(), sized.gap.to_string());
        }
        let label = Label {
            session: self.name(),
            suite: self.suite,
            seed: self.seed,
            hidden,
            foreign: foreign.map(|foreign| foreign.id.to_owned()),
            far_off: robot.far_off.map_or_else(Vec::new, |key| causes_of(key).map(str::to_owned).collect()),
            about,
        };
        (Session::logged((&robot.file, &setup), &plan, &logging, self.seed), label)
    }

    /// What no entry of the catalogue describes, in sessions that are there for that.
    fn foreign(&self) -> Option<&'static Foreign> {
        let kinds: Vec<&Foreign> = FOREIGN.iter().filter(|kind| self.fresh || !kind.fresh).collect();
        (self.suite == Suite::Open).then(|| kinds[self.number % kinds.len()])
    }

    /// How it is driven and logged: as robots leave logs, or as a laboratory would.
    fn logged(&self, robot: &DrawnRobot, drawn: &mut Drawn) -> (Plan, Logging) {
        let life = self.suite == Suite::Life || (self.suite == Suite::NoGap && self.number % 2 == 1);
        let laboratory = laboratory(robot, drawn);
        if !life {
            return (laboratory, Logging::clean());
        }
        let logging = Logging::drawn(&robot.file.noise, drawn);
        let rate = [50.0, 100.0, 125.0, 200.0, 250.0, 500.0, 1000.0][drawn.below(7) as usize];
        // three short runs only, in every fourth
        let (runs, duration) = if drawn.below(4) == 0 { (3, 5.0) } else { (6, 6.0) };
        let style = if drawn.below(2) == 0 { Style::Everyday } else { Style::Excitation };
        (Plan { rate, camera_rate: drawn.between(15.0, 90.0).round(), runs, duration, style, ..laboratory }, logging)
    }

    /// What is hidden: by turns, or drawn.
    fn causes(&self, drawn: &mut Drawn) -> Vec<&'static Cause> {
        match self.suite {
            Suite::NoGap | Suite::Open => Vec::new(),
            Suite::Several => several(self.number, drawn),
            _ => vec![&CAUSES[self.turn().0]],
        }
    }

    /// The cause whose turn it is, and how large it is: as many sessions as there are causes hide each once, three times as
    /// many hide each once weak, once medium and once strong, and a few hide causes of every kind.
    fn turn(&self) -> (usize, Severity) {
        let (round, place) = (self.number / CAUSES.len(), self.number % CAUSES.len());
        (place * STRIDE % CAUSES.len(), SEVERITIES[(place + round) % SEVERITIES.len()])
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
            let (low, high) = if several { Severity::Medium } else { self.turn().1 }.range();
            trial.sized(cause, wheel, drawn.log_between(low, high))
        };
        Hidden { cause: cause.id.to_owned(), wheel, times: sized.times, gap: sized.gap }
    }
}

/// Of fifteen sessions with several causes, so many have two effects, and so many of the others three; the rest have wrong
/// numbers.
const SEVERAL: [usize; 3] = [6, 4, 15];

/// Causes of which a wheel has one or the other: a shaft, and a grip on the floor.
const SAME_PLACE: [[&str; 2]; 2] = [["backlash", "shaft_elasticity"], ["creep", "wheel_slip"]];

/// Two effects, three, or three to five numbers that are wrong, no two of which are the same number or take the same place.
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
        let twice = |other: &&Cause| {
            let same_place = SAME_PLACE.iter().any(|place| place.contains(&other.id) && place.contains(&next.id));
            same_place || other.id == next.id || other.keys.iter().any(|key| next.keys.contains(key))
        };
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

/// A robot as its log shows it: what is not logged has noise without end, and no gap.
fn what_is_seen(truth: &RobotFile, plan: &Plan, logging: &Logging) -> RobotFile {
    let mut seen = truth.clone();
    let if_logged = |is: bool, sigma: f64| if is { sigma } else { f64::INFINITY };
    let Noise { current, wheel_speed, position, heading, gyro } = truth.noise;
    seen.noise = Noise {
        current: if_logged(logging.currents, current),
        wheel_speed: if_logged(logging.wheel_speeds, wheel_speed),
        position: if_logged(logging.pose, position),
        heading: if_logged(logging.pose, heading),
        gyro: if_logged(plan.gyro, gyro),
    };
    seen
}

/// How a laboratory records.
fn laboratory(robot: &DrawnRobot, drawn: &mut Drawn) -> Plan {
    Plan {
        runs: 6,
        duration: 6.0,
        gyro: drawn.below(2) == 0,
        rate: [100.0, 200.0, 500.0][drawn.below(3) as usize],
        camera_rate: drawn.between(25.0, 90.0).round(),
        voltage: DRIVEN * robot.truth.supply,
        style: Style::Excitation,
        unrest: None,
    }
}

fn about(robot: &DrawnRobot, plan: &Plan, logging: &Logging) -> BTreeMap<String, String> {
    let degrees: Vec<String> = robot.truth.wheels.iter().map(|wheel| format!("{:.0}", wheel.0)).collect();
    let all = [
        ("mass_kg", format!("{:.3}", robot.truth.mass)),
        ("drive_angles_deg", degrees.join(" ")),
        ("rate_hz", plan.rate.to_string()),
        ("camera_rate_hz", plan.camera_rate.to_string()),
        ("gyro", plan.gyro.to_string()),
        ("runs", plan.runs.to_string()),
        ("duration_s", plan.duration.to_string()),
        ("driven", format!("{:?}", plan.style)),
        ("noise_over_stated", format!("{:?}", logging.noise_factor)),
        ("noise_remembers_s", format!("{:?}", logging.correlation)),
        ("encoder_quantum_rad_s", logging.quantum.to_string()),
        ("lost_rows", logging.lost_rows.to_string()),
        ("outliers", logging.outliers.to_string()),
        ("currents", logging.currents.to_string()),
        ("wheel_speeds", logging.wheel_speeds.to_string()),
        ("pose", logging.pose.to_string()),
    ];
    all.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_sessions_share_a_seed_or_a_name_and_splits_share_none() {
        let mut seeds: Vec<u64> =
            [1, 2].into_iter().flat_map(|seed| cases(&WHOLE, seed, false)).map(|case| case.seed).collect();
        let all = seeds.len();
        seeds.sort_unstable();
        seeds.dedup();
        assert_eq!(seeds.len(), all);
        let mut names: Vec<String> = cases(&WHOLE, 1, false).iter().map(Case::name).collect();
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
        let of = |number: usize| Case { suite: Suite::Laboratory, number, seed: 5, fresh: false };
        let is = |case: &Case| (CAUSES[case.turn().0].id, case.turn().1) == ("coriolis", Severity::Medium);
        let case = (0..).map(of).find(is).expect("within three rounds");
        let (session, label) = case.made();
        assert_eq!(case.made(), (session.clone(), label.clone()), "the same bits from the same seed");
        assert_eq!((label.hidden[0].cause.as_str(), label.severity()), ("coriolis", Some(Severity::Medium)));
        assert_eq!(session.runs.len(), 6);
        let (_, nothing) = Case { suite: Suite::NoGap, number: 3, seed: 6, fresh: false }.made();
        assert!(nothing.nothing());
    }

    #[test]
    fn what_is_kept_for_fresh_splits_is_in_no_other() {
        let foreign = |fresh: bool| -> Vec<&'static Foreign> {
            cases(&WHOLE, 1, fresh).iter().filter_map(Case::foreign).collect()
        };
        assert!(foreign(false).iter().all(|kind| !kind.fresh) && foreign(true).iter().any(|kind| kind.fresh));
        assert_eq!(foreign(true).len(), 150);
    }

    #[test]
    fn a_group_that_is_not_logged_makes_no_gap() {
        let blind = |case: &Case| {
            let (_, logging) = case.logged(&DrawnRobot::new(case.seed), &mut Drawn::new(mixed(case.seed)));
            case.suite == Suite::Life && !logging.pose
        };
        let case = cases(&WHOLE, 3, false).into_iter().find(blind).expect("one in six");
        let (session, label) = case.made();
        assert_eq!(label.about["pose"], "false");
        assert!(session.runs.iter().all(|(_, text)| !text.contains("x_m") && text.contains("u0_V")));
        let truth = RobotFile::paper(0.0);
        let plan = Plan { gyro: false, ..laboratory(&DrawnRobot::new(1), &mut Drawn::new(1)) };
        let seen = what_is_seen(&truth, &plan, &Logging { pose: false, ..Logging::clean() });
        let mut setup = seen.setup();
        setup.sensors.camera.heading_offset = 1.0;
        setup.sensors.gyro_bias = 1.0;
        let trial = Trial { truth: &seen, voltage: 8.0, style: Style::Excitation, seed: 1, seconds: 1.0, row: ROW_S };
        assert!(trial.gap(&setup) < 0.02);
    }

    #[test]
    fn each_cause_gets_its_turn_in_each_severity() {
        let of = |number: usize| Case { suite: Suite::Laboratory, number, seed: 5, fresh: false }.turn();
        let mut turns: Vec<(usize, Severity)> = (0..3 * CAUSES.len()).map(of).collect();
        turns.sort_unstable();
        turns.dedup();
        assert_eq!(turns.len(), 3 * CAUSES.len());
    }

    #[test]
    fn several_causes_are_two_or_three_effects_or_three_to_five_numbers() {
        let mut drawn = Drawn::new(3);
        let mut counts = [0; 3];
        for number in 0..1500 {
            let causes = several(number, &mut drawn);
            let numbers = causes.iter().filter(|cause| !cause.keys.is_empty()).count();
            let mut keys: Vec<&str> = causes.iter().flat_map(|cause| cause.keys).copied().collect();
            let all = keys.len();
            keys.sort_unstable();
            keys.dedup();
            assert_eq!(keys.len(), all, "a number that is wrong twice");
            let takes = |place: &[&str; 2]| causes.iter().filter(|cause| place.contains(&cause.id)).count();
            assert!(SAME_PLACE.iter().all(|place| takes(place) <= 1), "one cause takes the place of another");
            match (numbers, causes.len()) {
                (0, 2) => counts[0] += 1,
                (0, 3) => counts[1] += 1,
                (3..=5, all) if all == numbers => counts[2] += 1,
                other => panic!("{other:?}"),
            }
        }
        assert_eq!(counts, [600, 400, 500]);
    }
}
