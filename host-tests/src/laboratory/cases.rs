//! What is recorded, and what the diagnosis answers.

use std::path::Path;
use std::time::Instant;

use ground_truth::causes::{CAUSES, Cause};
use ground_truth::driving::Style;
use ground_truth::recording::{Plan, Session as Recorded};
use ground_truth::robot_file::RobotFile;
use omni_gap::error::Result;
use omni_gap::log::Session;
use omni_gap::report::Report;
use omni_gap::{Options, diagnose};

use super::through_files::{read, read_in};
use crate::catalogue::outcome::{Judgement, judge_cause};

/// Runs, length [s], rows a second, frames of the camera a second, largest voltage [V].
pub const PLAN: Plan = Plan {
    runs: 6,
    duration: 6.0,
    rate: 200.0,
    camera_rate: 60.0,
    voltage: 8.0,
    gyro: false,
    style: Style::Excitation,
    unrest: None,
};

/// The wheel of a cause that sits on one.
pub const WHEEL: usize = 1;

/// Seeds count up from here; none was chosen by its result.
pub const FIRST_SEED: u64 = 4100;

/// Sessions in which nothing is hidden.
pub const WITHOUT: usize = 6;

/// By how much the robot's wheels are turned, one layout after the other [°].
pub const TURNED: [f64; 2] = [0.0, 45.0];

/// One session.
#[derive(Clone, Copy, Debug)]
pub struct LaboratoryCase {
    /// What is hidden, if anything.
    pub cause: Option<&'static Cause>,
    /// By how much the wheels are turned from the paper's [°].
    pub turned: f64,
    /// Of drives and noise.
    pub seed: u64,
}

/// All of them.
pub fn cases() -> Vec<LaboratoryCase> {
    let hidden = CAUSES.iter().map(Some).chain([None; WITHOUT]);
    let of_robot = move |turned: f64| hidden.clone().map(move |cause| (cause, turned));
    let all = TURNED.into_iter().flat_map(of_robot);
    (FIRST_SEED..).zip(all).map(|(seed, (cause, turned))| LaboratoryCase { cause, turned, seed }).collect()
}

/// A session that was diagnosed.
#[derive(Debug)]
pub struct LaboratoryOutcome {
    /// Which.
    pub case: LaboratoryCase,
    /// The answer.
    pub report: Report,
    /// How long that took [s]
    pub seconds: f64,
}

impl LaboratoryCase {
    /// The name of what is hidden.
    pub fn name(&self) -> &'static str {
        self.cause.map_or("nothing", |cause| cause.id)
    }

    /// The cause's name and its wheel.
    pub fn hidden(&self) -> Option<(&'static str, Option<usize>)> {
        self.cause.map(|cause| (cause.id, cause.one_wheel.then_some(WHEEL)))
    }

    /// The folder's files.
    pub fn recorded(&self) -> Recorded {
        let file = RobotFile::paper(self.turned);
        let mut setup = file.setup();
        if let Some(cause) = self.cause {
            (cause.put)(&mut setup, cause.one_wheel.then_some(WHEEL), 1.0);
        }
        let plan = Plan { gyro: self.cause.is_some_and(|cause| cause.id == "gyro_bias"), ..PLAN };
        Recorded::of(&file, &setup, &plan, self.seed)
    }

    /// How the robot is called: by its wheels' layout.
    pub fn robot(&self) -> &'static str {
        if self.turned == 0.0 { "+" } else { "X" }
    }

    /// What the diagnosis says of the folder that it is recorded into, read as a user's.
    ///
    /// # Errors
    /// Where the folder cannot be written or read.
    pub fn diagnosed_in(self, folder: &Path) -> Result<LaboratoryOutcome> {
        let session = read_in(&self.recorded(), folder)?;
        Ok(self.outcome(&session))
    }

    /// The same, with a folder that nobody keeps.
    ///
    /// # Errors
    /// Where no folder can be written or read.
    pub fn diagnosed(self) -> Result<LaboratoryOutcome> {
        let session = read(&self.recorded())?;
        Ok(self.outcome(&session))
    }

    fn outcome(self, session: &Session) -> LaboratoryOutcome {
        let start = Instant::now();
        let report = diagnose(session, &Options::default());
        LaboratoryOutcome { case: self, report, seconds: start.elapsed().as_secs_f64() }
    }
}

impl LaboratoryOutcome {
    /// How good the answer is.
    pub fn judged(&self) -> Judgement {
        judge_cause(self.case.hidden(), &self.report)
    }

    /// The answer gives a name to what is none of it.
    pub fn names_another(&self) -> bool {
        self.judged() == Judgement::Wrong && !self.report.causes.is_empty()
    }
}
