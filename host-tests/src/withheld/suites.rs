//! Suites: which sessions a split has, and how each is drawn from its seed.

use ground_truth::causes::{CAUSES, Cause};
use ground_truth::drawn::Drawn;
use ground_truth::drawn_robot::DrawnRobot;
use ground_truth::foreign::{FOREIGN, Foreign};
use ground_truth::gap::ROW_S;
use ground_truth::logging::Logging;
use ground_truth::recording::Session;
use ground_truth::setup::Setup;
use ground_truth::sizing::{BOUNDS, Sized, Trial};

use super::label::{Hidden, Label, Severity, Suite};
use super::logged::{Logged, about, calmed, laboratory, life, ramped, set_speed, what_is_seen};
use super::true_model::TrueModel;
use super::turns;

/// How many sessions of each suite.
pub type Sizes = [(Suite, usize); 6];

/// A whole split.
pub const WHOLE: Sizes = [
    (Suite::Laboratory, 250),
    (Suite::NoGap, 150),
    (Suite::Several, 150),
    (Suite::Life, 400),
    (Suite::Open, 150),
    (Suite::SetSpeed, 100),
];

/// A quick look: a few of each.
pub const REDUCED: Sizes = [
    (Suite::Laboratory, 10),
    (Suite::NoGap, 6),
    (Suite::Several, 4),
    (Suite::Life, 10),
    (Suite::Open, 6),
    (Suite::SetSpeed, 4),
];

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

/// Gaps are measured on so much of a drive [s]
const TRIED_S: f64 = 6.0;

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

    /// Whether a cause is among what it hides.
    pub fn hides(&self, cause: &str) -> bool {
        self.causes(&mut Drawn::new(mixed(self.seed))).iter().any(|hidden| hidden.id == cause)
    }

    /// Recordings and label.
    pub fn made(&self) -> (Session, Label) {
        let mut drawn = Drawn::new(mixed(self.seed));
        let causes = self.causes(&mut drawn);
        let ids: Vec<&str> = causes.iter().map(|cause| cause.id).collect();
        let keys: Vec<&str> = causes.iter().flat_map(|cause| cause.keys).copied().collect();
        let mut robot = self.robot(&ids).with_true(&keys);
        let (mut plan, logging) = self.logged(&mut robot, &ids, &mut drawn);
        // what only a gyro shows needs one
        plan.gyro |= ids.contains(&"gyro_bias");
        let seen = what_is_seen(&robot.truth, &plan, &logging);
        let (voltage, style, row) = (plan.voltage, plan.style, ROW_S);
        let mut trial = Trial { truth: &seen, voltage, style, seed: self.seed, seconds: TRIED_S, row };
        if robot.truth.drive.is_some() {
            trial.row = 1.0 / plan.rate;
            plan.style = ramped(&trial);
            trial.style = plan.style;
        }
        plan.unrest = plan.unrest.map(|unrest| calmed(unrest, &trial));
        let mut setup = robot.truth.setup();
        let (mut hidden, mut put): (Vec<Hidden>, Vec<(&Cause, Option<usize>)>) = (Vec::new(), Vec::new());
        for cause in causes {
            let one = self.hidden(cause, &trial, &mut drawn);
            (cause.put)(&mut setup, one.wheel, one.times);
            put.push((cause, one.wheel));
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
        let truth = foreign.is_none().then(|| TrueModel::of(&robot.truth, &setup, &put));
        let label = Label {
            session: self.name(),
            suite: self.suite,
            seed: self.seed,
            hidden,
            foreign: foreign.map(|foreign| foreign.id.to_owned()),
            far_off: robot.far_off.map_or_else(Vec::new, |key| causes_of(key).map(str::to_owned).collect()),
            about,
            truth,
            class: Vec::new(),
        };
        (Session::logged((&robot.file, &setup), &plan, &logging, self.seed), label)
    }

    /// What no entry of the catalogue describes, in sessions that are there for that.
    fn foreign(&self) -> Option<&'static Foreign> {
        let kinds: Vec<&Foreign> = FOREIGN.iter().filter(|kind| self.fresh || !kind.fresh).collect();
        (self.suite == Suite::Open).then(|| kinds[self.number % kinds.len()])
    }

    /// The robot: for wheels that would fight each other, one of three.
    fn robot(&self, hidden: &[&str]) -> DrawnRobot {
        let fights = self.suite == Suite::SetSpeed && turns::fights(hidden);
        let mut all = (0..).map(|other| DrawnRobot::new(self.seed.wrapping_add(other)));
        all.find(|robot| !fights || robot.truth.wheels.len() == 3).expect("two of five have three wheels")
    }

    /// How it is driven and logged.
    fn logged(&self, robot: &mut DrawnRobot, hidden: &[&str], drawn: &mut Drawn) -> Logged {
        match (self.suite, self.number % 2) {
            (Suite::Life, _) => life(robot, hidden, self.number, drawn),
            (Suite::NoGap, 1) => life(robot, hidden, self.number / 2, drawn),
            (Suite::SetSpeed, _) => set_speed(robot, hidden, drawn),
            _ => (laboratory(robot, drawn), Logging::clean()),
        }
    }

    /// What is hidden: by turns, or drawn.
    fn causes(&self, drawn: &mut Drawn) -> Vec<&'static Cause> {
        match self.suite {
            Suite::NoGap | Suite::Open => Vec::new(),
            Suite::Several => turns::several(self.number, drawn),
            Suite::SetSpeed => turns::of_set_speed(self.number).0.into_iter().collect(),
            Suite::Laboratory | Suite::Life => vec![turns::single(self.number).0],
        }
    }

    /// How large what is hidden is.
    fn severity(&self) -> Severity {
        match self.suite {
            Suite::Several => Severity::Medium,
            Suite::SetSpeed => turns::of_set_speed(self.number).1,
            _ => turns::single(self.number).1,
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
            let (low, high) = self.severity().range();
            trial.sized(cause, wheel, drawn.log_between(low, high))
        };
        Hidden { cause: cause.id.to_owned(), wheel, times: sized.times, gap: sized.gap }
    }
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

#[cfg(test)]
mod tests {
    use ground_truth::driving::Style;
    use ground_truth::logging::CameraClock;
    use ground_truth::robot_file::RobotFile;
    use ground_truth::unrest::{Forces, Unrest};

    use super::*;
    use crate::laboratory::through_files;

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
    fn a_session_hides_what_its_label_says_at_the_size_that_was_asked_for() {
        let of = |number: usize| Case { suite: Suite::Laboratory, number, seed: 5, fresh: false };
        let is =
            |case: &Case| (case.causes(&mut Drawn::new(0))[0].id, case.severity()) == ("coriolis", Severity::Medium);
        let case = (0..).map(of).find(is).expect("within three rounds");
        let (session, label) = case.made();
        assert_eq!(case.made(), (session.clone(), label.clone()), "the same bits from the same seed");
        assert_eq!((label.hidden[0].cause.as_str(), label.severity()), ("coriolis", Some(Severity::Medium)));
        assert!(case.hides("coriolis") && !case.hides("creep"));
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

    /// How a case is driven and logged.
    fn logged(case: &Case) -> Logged {
        let mut drawn = Drawn::new(mixed(case.seed));
        let ids: Vec<&str> = case.causes(&mut drawn).iter().map(|cause| cause.id).collect();
        case.logged(&mut case.robot(&ids), &ids, &mut drawn)
    }

    #[test]
    fn a_floor_that_moves_a_robot_makes_a_third_of_a_sigma_at_the_most() {
        let truth = RobotFile::paper(0.0);
        let trial = Trial { truth: &truth, voltage: 8.0, style: Style::Excitation, seed: 1, seconds: 2.0, row: ROW_S };
        let wild = calmed(Unrest { share: 0.5, time: 0.3 }, &trial);
        let mut setup = truth.setup();
        let coulomb = setup.robot.chassis.friction.coulomb;
        setup.robot.surroundings.unrest = Some(Forces::drawn(&wild, coulomb, 2.0, 1));
        // friction that lets go makes it a little less than proportional
        assert!((trial.gap(&setup) / 0.3 - 1.0).abs() < 0.2, "{wild:?}: {}", trial.gap(&setup));
        let still = Unrest { share: 1e-3, time: 0.3 };
        assert_eq!(calmed(still, &trial), still);
    }

    #[test]
    fn half_of_life_is_on_a_floor_that_moves_it_and_a_third_of_its_cameras_have_clocks_of_their_own() {
        let all = cases(&WHOLE, 3, false);
        let of = |suite: Suite| all.iter().filter(move |case| case.suite == suite).map(|case| (case, logged(case)));
        for (suite, least) in [(Suite::Life, 400), (Suite::NoGap, 75)] {
            let restless = of(suite).filter(|(_, (plan, _))| plan.unrest.is_some()).count();
            assert!((least / 2..=least / 2 + 1).contains(&restless), "{suite:?}: {restless}");
        }
        let clocks = |clock| of(Suite::Life).filter(move |(_, (_, logging))| logging.camera == Some(clock));
        let (known, unknown) = (clocks(CameraClock::Known).count(), clocks(CameraClock::Unknown).count());
        // of 133, five in six have a pose; of these, four in five wheel speeds, and every second is driven hard
        assert!((95..=125).contains(&(known + unknown)) && (30..=60).contains(&unknown), "{known} {unknown}");
        for (case, (_, logging)) in clocks(CameraClock::Unknown) {
            let id = case.causes(&mut Drawn::new(mixed(case.seed)))[0].id;
            assert!(logging.wheel_speeds && id != "camera_latency" && id != "creep", "{id}");
        }
        for suite in [Suite::Laboratory, Suite::Several, Suite::Open] {
            assert!(of(suite).all(|(_, (plan, logging))| plan.unrest.is_none() && logging == Logging::clean()));
        }
    }

    #[test]
    fn set_speeds_hide_what_their_logs_can_show_and_half_of_the_files_know_their_drives() {
        let all: Vec<Case> = cases(&WHOLE, 4, false).into_iter().filter(|case| case.suite == Suite::SetSpeed).collect();
        let mut known = 0;
        for case in &all {
            let mut drawn = Drawn::new(mixed(case.seed));
            let causes = case.causes(&mut drawn);
            let ids: Vec<&str> = causes.iter().map(|cause| cause.id).collect();
            let mut robot = case.robot(&ids);
            let (plan, logging) = case.logged(&mut robot, &ids, &mut drawn);
            assert_eq!(robot.truth.drive, robot.file.drive);
            assert!(logging.wheel_speeds && logging.pose);
            let knows = robot.file.toml().contains("[effects.speed_loop]");
            known += usize::from(knows);
            // a silent file's drive is quick, or what is hidden
            let late = ids == ["speed_loop"];
            assert!(if late { !knows } else { knows || plan.rate == 1000.0 }, "{ids:?}");
            assert!(!turns::fights(&ids) || robot.truth.wheels.len() == 3, "{ids:?}");
        }
        assert!((25..=60).contains(&known), "{known}");
    }

    #[test]
    fn a_session_of_set_speeds_logs_no_voltage_and_hides_what_its_label_says() {
        let of = |number: usize| Case { suite: Suite::SetSpeed, number, seed: 41, fresh: false };
        let (session, label) = of(3).made();
        assert_eq!(of(3).made(), (session.clone(), label.clone()), "the same bits from the same seed");
        assert_eq!(label.hidden[0].cause, "command_deadband");
        assert!(label.hidden[0].gap > 0.3 && label.about["set_speeds"].starts_with("SpeedLoop"), "{label:?}");
        assert!(session.runs.iter().all(|(_, text)| text.contains("wset0_rad_s") && !text.contains("u0_V")));
        // one whose file is silent, and one whose file knows
        for number in [0, 3] {
            let read = through_files::read(&of(number).made().0).expect("a session");
            assert_eq!(read.robot.effects.iter().any(|effect| effect.id == "speed_loop"), number == 3);
            assert!(read.runs.len() == 6 && read.runs.iter().all(|run| run.wset.is_some() && run.u.is_none()));
        }
        assert!(of(2).made().1.nothing());
    }

    /// The first stamp of a camera's own file.
    fn first_stamp(session: &Session) -> f64 {
        let (_, text) = session.runs.iter().find(|(name, _)| name.ends_with("run0/camera.csv")).expect("a camera");
        let line = text.lines().nth(1).expect("a frame");
        line.split(',').next().and_then(|stamp| stamp.parse().ok()).expect("a stamp")
    }

    #[test]
    fn clocks_that_nobody_knows_can_be_estimated() {
        let unknown = |case: &&Case| case.suite == Suite::Life && logged(case).1.camera == Some(CameraClock::Unknown);
        let all = cases(&WHOLE, 2008, false);
        for case in all.iter().filter(unknown).take(4) {
            let (robot, (plan, logging)) = (DrawnRobot::new(case.seed), logged(case));
            let made = |camera| {
                let logging = Logging { camera: Some(camera), ..logging.clone() };
                Session::logged((&robot.file, &robot.truth.setup()), &plan, &logging, case.seed)
            };
            let [known, session] = [CameraClock::Known, CameraClock::Unknown].map(made);
            let read = through_files::read(&session).expect("a session");
            let told = known.columns.as_ref().and_then(|text| text.split_once("offset_s = ")).expect("an offset").1;
            let known_offset: f64 = told.trim().parse().expect("a number");
            let truth = known_offset + first_stamp(&known) - first_stamp(&session);
            let estimate = read.runs[0].files[1].offset_s;
            // a standard error of 10 ms is the worst that the reader lets pass
            assert!((estimate - truth).abs() < 0.02, "{}: {estimate} s of {truth} s", case.name());
        }
    }

    #[test]
    fn a_group_that_is_not_logged_makes_no_gap() {
        let blind = |case: &Case| case.suite == Suite::Life && !logged(case).1.pose;
        let case = cases(&WHOLE, 3, false).into_iter().find(blind).expect("one in six");
        let (session, label) = case.made();
        assert_eq!(label.about["pose"], "false");
        assert!(session.runs.iter().all(|(_, text)| !text.contains("x_m") && text.contains("u0_V")));
        let truth = RobotFile::paper(0.0);
        let plan = ground_truth::recording::Plan { gyro: false, ..laboratory(&DrawnRobot::new(1), &mut Drawn::new(1)) };
        let seen = what_is_seen(&truth, &plan, &Logging { pose: false, ..Logging::clean() });
        let mut setup = seen.setup();
        setup.sensors.camera.heading_offset = 1.0;
        setup.sensors.gyro_bias = 1.0;
        let trial = Trial { truth: &seen, voltage: 8.0, style: Style::Excitation, seed: 1, seconds: 1.0, row: ROW_S };
        assert!(trial.gap(&setup) < 0.02);
    }
}
