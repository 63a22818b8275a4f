//! # Study: every scenario, on both robots, with many seeds in software and one in the emulator
//!
//! The same [`run`](NominalRobot::run) runs on either program. What the image leaves behind must be, bit for bit, what
//! the library called on the host leaves; only load and jitter, which take a clock, may differ.

use model_core::geometry::frames::Pose;
use model_core::link::block::Block;
use model_core::link::record::{OperatingState, TelemetryRecord};
use model_core::plant::robot::Robot;

use super::command_timeout::{self, CommandTimeout};
use super::figure_eight::{FigureEight, TrackingError, WAYS, Way};
use super::ramps::{self, Ramp};
use super::robots::{self, ToParameters};
use super::saturation::{self, DirectionError};
use super::{ClosedLoopRun, HostProgram, RunLog};
use crate::emulator::{BoardProgram, RunError};
use crate::virtual_board::{BoardSetup, VirtualBoard};

/// The seeds; the first one is played in the emulator too. Nobody chose them by result.
pub const SEEDS: [u64; 8] = [1, 2, 3, 4, 5, 6, 7, 8];

/// What is done with a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scenario {
    /// Ramps on one axis
    Ramps(usize),
    /// The figure-eight in one of its [`WAYS`]
    FigureEight(usize),
    /// The same without the model's feedforward
    FigureEightFeedbackOnly,
    /// A diagonal acceleration that does not fit
    Saturation,
    /// Commands that end
    CommandTimeout,
}

impl Scenario {
    /// All of them, the longest first.
    pub const ALL: [Self; 12] = [
        Self::Ramps(0),
        Self::Ramps(1),
        Self::Ramps(2),
        Self::FigureEightFeedbackOnly,
        Self::FigureEight(0),
        Self::FigureEight(1),
        Self::FigureEight(2),
        Self::FigureEight(3),
        Self::FigureEight(4),
        Self::FigureEight(5),
        Self::CommandTimeout,
        Self::Saturation,
    ];

    /// Which of its ways a figure-eight is driven in; the first where nothing else is said.
    fn way(self) -> usize {
        if let Self::FigureEight(way) = self { way } else { 0 }
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ramps(0) => "ramps along v",
            Self::Ramps(1) => "ramps along vn",
            Self::Ramps(_) => "ramps about the vertical",
            Self::FigureEight(0) => "figure-eight",
            Self::FigureEight(_) => "figure-eight, set otherwise",
            Self::FigureEightFeedbackOnly => "figure-eight, feedback alone",
            Self::Saturation => "diagonal into saturation",
            Self::CommandTimeout => "commands end",
        }
    }
}

/// What came of it.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// of ramps
    Ramps(Vec<Ramp>),
    /// of a figure-eight
    FigureEight(TrackingError),
    /// of a saturation
    Saturation(DirectionError),
    /// of commands that end
    CommandTimeout(CommandTimeout),
}

/// A run.
#[derive(Clone, Debug)]
pub struct ScenarioRun {
    /// What was measured
    pub outcome: Outcome,
    /// All that it left behind
    pub log: RunLog,
}

/// A robot of the paper as it is believed to be, in both precisions.
#[derive(Clone, Copy, Debug)]
pub struct NominalRobot<const N: usize> {
    /// For the host
    pub host: Robot<N, f64>,
    /// For its block
    pub robot: Robot<N, f32>,
}

impl<const N: usize> NominalRobot<N>
where
    Block<N>: ToParameters,
{
    /// Its block.
    pub fn block(&self) -> Block<N> {
        robots::block(self.robot)
    }

    /// The board that a seed draws.
    pub fn board(&self, seed: u64) -> BoardSetup<N> {
        robots::board(&self.host, seed)
    }

    /// Lets a program play a scenario.
    ///
    /// # Errors
    /// [`RunError`] says what became of the program.
    pub fn run<B: BoardProgram>(
        &self,
        program: B,
        scenario: Scenario,
        seed: u64,
    ) -> Result<(ScenarioRun, ClosedLoopRun<B, N>), RunError> {
        let mut run =
            ClosedLoopRun::new(program, VirtualBoard::moving(self.board(seed), Pose::default(), Default::default()));
        let mut block = self.block();
        let came = match scenario {
            Scenario::Ramps(axis) => Outcome::Ramps(ramps::measure(&mut run, &block, axis)?),
            Scenario::Saturation => Outcome::Saturation(saturation::measure(&mut run, &block)?),
            Scenario::FigureEight(_) | Scenario::FigureEightFeedbackOnly => {
                block.feedforward = scenario != Scenario::FigureEightFeedbackOnly;
                let Way { commands, acceleration, integral } = WAYS[scenario.way()];
                block.limits.acceleration = [acceleration, acceleration, 30.0];
                block.feedback_integral = integral;
                run.send_block(&block.parameters());
                run.wait(0.15)?;
                let [radius, _] = robots::geometry(&self.host, &self.board(seed).robot);
                Outcome::FigureEight(FigureEight::default().track(&mut run, commands, radius)?)
            }
            Scenario::CommandTimeout => {
                run.send_block(&block.parameters());
                run.wait(0.15)?;
                Outcome::CommandTimeout(command_timeout::measure(&mut run)?)
            }
        };
        Ok((ScenarioRun { outcome: came, log: run.log.clone() }, run))
    }

    /// The same in software, which has no trouble.
    pub fn run_on_host(&self, scenario: Scenario, seed: u64) -> ScenarioRun {
        self.run(HostProgram::default(), scenario, seed).expect("software does not fail").0
    }
}

/// What differs first between two runs of the same, bit for bit; load and jitter apart, unless `clocked`.
pub fn difference(one: &RunLog, other: &RunLog, clocked: bool) -> Option<String> {
    let (n, m) = (one.records.len(), other.records.len());
    if n != m {
        return Some(format!("{n} records against {m}"));
    }
    let bits = |record: &TelemetryRecord| {
        let clock = if clocked { (record.load, record.jitter) } else { (0, 0) };
        TelemetryRecord { load: clock.0, jitter: clock.1, ..*record }.to_bytes()
    };
    for (a, b) in one.records.iter().zip(&other.records) {
        if bits(a) != bits(b) {
            return Some(format!("record {}: {a:?} against {b:?}", a.sequence));
        }
    }
    if one.truth != other.truth {
        return Some("the motion, though not the records".into());
    }
    (one.replies != other.replies).then(|| "the answers to commands".into())
}

/// Worst load [‰] and jitter [cycles] that a program told while it drove.
pub fn load(log: &RunLog) -> [u16; 2] {
    let driving = log.records.iter().filter(|record| record.state == OperatingState::Driving);
    driving.fold([0; 2], |[load, jitter], record| [load.max(record.load), jitter.max(record.jitter)])
}
