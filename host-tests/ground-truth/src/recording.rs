//! Recordings: what a log of a drive holds, with noise, as the data contract has it.

use crate::drawn::Drawn;
use crate::driving::{Driver, Style};
use crate::logging::{Log, Logging};
use crate::reading::{Pace, drive};
use crate::robot_file::RobotFile;
use crate::setup::Setup;

/// How recordings are made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// How many.
    pub runs: usize,
    /// How long each lasts [s]
    pub duration: f64,
    /// Rows a second [1/s]
    pub rate: f64,
    /// Frames of the camera a second [1/s]
    pub camera_rate: f64,
    /// The most that a motor is given [V]
    pub voltage: f64,
    /// Whether a gyro is logged.
    pub gyro: bool,
    /// How it is driven.
    pub style: Style,
}

/// What stands in a session folder.
#[derive(Clone, Debug, PartialEq)]
pub struct Session {
    /// `robot.toml`
    pub robot: String,
    /// `runs/NAME`, each with its text.
    pub runs: Vec<(String, String)>,
}

/// What parts the noise of a run from its drive.
const OF_NOISE: u64 = 0x5eed;

/// What parts the time at which a run begins from its drive.
const OF_CLOCK: u64 = 0xc10c;

/// Some time within this the room's clock shows when a run begins [s]
const DAY: f64 = 120.0;

impl Session {
    /// Recordings of a robot whose file says something else, or the same.
    pub fn of(file: &RobotFile, setup: &Setup, plan: &Plan, seed: u64) -> Self {
        Self::logged((file, setup), plan, &Logging::clean(), seed)
    }

    /// The same, logged as it may be.
    pub fn logged((file, setup): (&RobotFile, &Setup), plan: &Plan, logging: &Logging, seed: u64) -> Self {
        let run = |k: usize| {
            let seed = seed.wrapping_mul(1000).wrapping_add(k as u64);
            (format!("run{k}.csv"), recorded((file, setup), plan, logging, seed))
        };
        Self { robot: file.toml(), runs: (0..plan.runs).map(run).collect() }
    }

    /// Writes the folder.
    ///
    /// # Errors
    /// Where a file cannot be written.
    pub fn write(&self, folder: &std::path::Path) -> std::io::Result<()> {
        let runs = folder.join("runs");
        std::fs::create_dir_all(&runs)?;
        std::fs::write(folder.join("robot.toml"), &self.robot)?;
        self.runs.iter().try_for_each(|(name, text)| std::fs::write(runs.join(name), text))
    }
}

/// One run, as a table.
fn recorded((file, setup): (&RobotFile, &Setup), plan: &Plan, logging: &Logging, seed: u64) -> String {
    let row = 1.0 / plan.rate;
    let pace = Pace { row, steps: (row / setup.step()).ceil() as usize };
    let mut driver = Driver::new(file, plan.voltage, plan.style, seed);
    let rows = (plan.duration * plan.rate).round() as usize;
    let setup = setup.clone().begun_at(Drawn::new(seed ^ OF_CLOCK).between(0.0, DAY));
    let readings = drive(&setup, pace, rows, |k, moving| driver.command(k as f64 * row, moving.pose()));
    let mut log = Log::new(logging, &file.noise, plan.gyro, seed ^ OF_NOISE);
    let mut next_frame = 0.0;
    let mut text = log.header(file.wheels.len());
    for reading in &readings {
        let framed = reading.time >= next_frame - 1e-9;
        if framed {
            next_frame += 1.0 / plan.camera_rate;
        }
        text += &log.row(reading, framed);
    }
    text
}
