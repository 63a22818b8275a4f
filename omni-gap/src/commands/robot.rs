//! `robot`: what a robot is asked to do over its line.

mod ask;
mod commission;
mod drive;
mod gyro;
mod live;

use std::path::PathBuf;

use omni_gap::api::{RobotFile, export, known_effects};
use omni_gap::wire::robot::{clear, send, status, stop};

use super::cli_error::CliError;
use super::console::Console;
use super::done::{DONE, Done};
use super::record::Record;
pub use ask::{Ask, RobotAnswered};
use commission::Commission;
use drive::Drive;
use gyro::Gyro;
pub use gyro::GyroCalibrated;

/// Send parameters to a robot, find out how its motors are wired and what its gyro is worth, drive it, stop it, have it forget its faults, ask how it is
#[derive(Debug, clap::Args)]
pub struct Robot {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, clap::Subcommand)]
enum Verb {
    /// Say how the robot is: what it does, its faults, the parameters that it drives with
    Status(Ask),
    /// Send the parameters of a robot file, and wait until the robot drives with them
    Send(Send),
    /// Find out how each motor is wired: phases, current signs, halls and their places; wheels off the ground, at most 1 A
    Commission(Box<Commission>),
    /// Tell what a count of the gyro is worth, from a recording in which the robot was turned by hand
    Gyro(Gyro),
    /// Drive leg by leg, then come to rest and open the bridges; Ctrl-C does so at once
    Drive(Box<Drive>),
    /// Open the bridges: the robot coasts
    Stop(Ask),
    /// Have the robot forget its faults
    Clear(Ask),
    /// Record what the robot sends into a session: the same as `omni-gap record`
    Record(Box<Record>),
}

/// Parameters for a robot.
#[derive(Debug, clap::Args)]
pub struct Send {
    /// The robot file, with the effects that the robot should undo
    #[arg(value_name = "ROBOT.toml")]
    pub robot: PathBuf,

    /// Which robot.
    #[command(flatten)]
    pub ask: Ask,
}

impl Robot {
    /// Does it.
    pub fn run(&self, console: &Console) -> Done {
        match &self.verb {
            Verb::Record(record) => return record.run(console),
            Verb::Status(ask) => ask.answer(console, "listening", status)?,
            Verb::Stop(ask) => ask.answer(console, "opening the bridges", stop)?,
            Verb::Clear(ask) => ask.answer(console, "clearing the faults", clear)?,
            Verb::Send(asked) => asked.run(console)?,
            Verb::Commission(asked) => asked.run(console)?,
            Verb::Gyro(asked) => asked.run(console)?,
            Verb::Drive(asked) => asked.run(console)?,
        }
        Ok(DONE)
    }
}

impl Send {
    /// Sends them.
    pub fn run(&self, console: &Console) -> Result<(), CliError> {
        let robot = RobotFile::load(&self.robot, &known_effects())?;
        let block = export(&robot, &self.robot)?;
        for (effect, why) in &block.left {
            console.more(format!("not undone: {effect}: {why}"));
        }
        self.ask.answer(console, "sending the parameters", |line| send(line, &block.bytes, block.checksum))
    }
}
