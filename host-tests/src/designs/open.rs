//! Recordings that leave something open.

use std::time::Instant;

use ground_truth::causes::{CAUSES, Cause};
use ground_truth::drawn::Drawn;
use ground_truth::drawn_robot::DrawnRobot;
use ground_truth::driving::Style;
use ground_truth::logging::Logging;
use ground_truth::recording::{Plan, Session as Recorded};
use ground_truth::setup::Setup;
use omni_gap::api::{DesignKnobs, Designed, next};
use omni_gap::error::Result;
use omni_gap::{Options, Report, Session};

use crate::laboratory::cases;
use crate::laboratory::through_files::read;

/// How it is recorded: short, everyday driving; the voltage is for a supply of 12 V.
pub const PLAN: Plan = Plan { runs: 2, duration: 4.0, rate: 100.0, style: Style::Everyday, ..cases::PLAN };
/// The supply that [`PLAN`] is for [V]
const SUPPLY_V: f64 = 12.0;
/// The least and the most that is hidden, as multiples of what is typical.
const TIMES: (f64, f64) = (0.4, 1.5);
/// What parts the drawing of what is hidden from that of the robot.
const OF_CASE: u64 = 0xde51;
/// What acts on set speeds, or shows in a sensor that is not logged here.
const LEFT_OUT: [&str; 3] = ["speed_loop", "command_deadband", "gyro_bias"];

/// A robot with something hidden in it, and how it is recorded.
#[derive(Debug)]
pub struct HiddenCase {
    /// Which.
    pub seed: u64,
    /// What is hidden.
    pub cause: &'static Cause,
    /// The wheel that it sits on.
    pub wheel: Option<usize>,
    robot: DrawnRobot,
    setup: Setup,
    logging: Logging,
    plan: Plan,
}

/// A case whose hidden cause a diagnosis names or has among those that it does not tell apart, and which are several.
#[derive(Debug)]
pub struct OpenCase {
    /// The robot.
    pub hidden: HiddenCase,
    /// Its recordings.
    pub session: Session,
    /// The answer to them.
    pub report: Report,
    /// What it leaves in question, the hidden cause among it.
    pub in_question: Vec<String>,
    /// The experiment; none where there is nothing to do.
    pub designed: Option<Designed>,
    /// How long it took to diagnose and to design [s]
    pub seconds: f64,
}

impl HiddenCase {
    /// The same seed gives the same case.
    pub fn drawn(seed: u64) -> Self {
        let robot = DrawnRobot::new(seed);
        let mut drawn = Drawn::new(seed ^ OF_CASE);
        let causes: Vec<&Cause> = CAUSES.iter().filter(|cause| !LEFT_OUT.contains(&cause.id)).collect();
        let cause = causes[(seed % causes.len() as u64) as usize];
        let wheel = cause.one_wheel.then(|| drawn.below(robot.truth.wheels.len() as u32) as usize);
        let mut setup = robot.truth.setup();
        (cause.put)(&mut setup, wheel, drawn.log_between(TIMES.0, TIMES.1));
        // one of them, the other, or both
        let missing = drawn.below(3);
        let logging = Logging { currents: missing == 1, wheel_speeds: missing == 2, ..Logging::clean() };
        let plan = Plan { voltage: PLAN.voltage * robot.truth.supply / SUPPLY_V, ..PLAN };
        Self { seed, cause, wheel, robot, setup, logging, plan }
    }

    /// Diagnoses it; none where nothing is open, or the hidden cause is not among what is.
    ///
    /// # Errors
    /// Where no folder can be written or read.
    pub fn opened(self) -> Result<Option<OpenCase>> {
        let session = read(&Recorded::logged((&self.robot.file, &self.setup), &self.plan, &self.logging, self.seed))?;
        let start = Instant::now();
        let (diagnosis, designed) = next(&session, &Options::default(), &DesignKnobs::default());
        let (report, seconds) = (diagnosis.report, start.elapsed().as_secs_f64());
        let in_question = in_question(&report);
        let open = in_question.len() > 1 && in_question.iter().any(|id| id == self.cause.id);
        Ok(open.then_some(OpenCase { hidden: self, session, report, in_question, designed, seconds }))
    }

    /// The script played so often on it: volts on each motor, row by row at a rate [1/s].
    ///
    /// # Errors
    /// Where no folder can be written or read.
    pub fn played(&self, plays: usize, volts: &[Vec<f64>], rate: f64) -> Result<Session> {
        let plan = Plan { runs: plays, duration: volts.len() as f64 / rate, ..self.plan };
        let of = (&self.robot.file, &self.setup);
        read(&Recorded::played(of, &plan, &self.logging, (volts, rate), self.seed ^ OF_CASE))
    }

    /// Random motion on all axes, so often and so long [s].
    ///
    /// # Errors
    /// Where no folder can be written or read.
    pub fn moved_at_random(&self, plays: usize, duration: f64) -> Result<Session> {
        let plan = Plan { runs: plays, duration, style: Style::Excitation, ..self.plan };
        read(&Recorded::logged((&self.robot.file, &self.setup), &plan, &self.logging, self.seed ^ OF_CASE))
    }
}

/// What an answer leaves in question: the first cause named that others were not told from, with these; else what was named.
pub fn in_question(report: &Report) -> Vec<String> {
    let named = report.which.iter().filter(|entry| report.causes.contains(&entry.cause));
    match named.clone().find(|entry| !entry.not_told_apart_from.is_empty()) {
        Some(entry) => std::iter::once(&entry.cause).chain(&entry.not_told_apart_from).cloned().collect(),
        None => named.map(|entry| entry.cause.clone()).collect(),
    }
}
