//! Recordings: what a log of a drive holds, with noise, as the data contract has it.

use std::fmt::Write;

use crate::drawn::Drawn;
use crate::driving::Driver;
use crate::reading::{Pace, Reading, drive};
use crate::robot_file::{Noise, RobotFile};
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

impl Session {
    /// Recordings of a robot whose file says something else, or the same.
    pub fn of(file: &RobotFile, setup: &Setup, plan: &Plan, seed: u64) -> Self {
        let run = |k: usize| {
            let seed = seed.wrapping_mul(1000).wrapping_add(k as u64);
            (format!("run{k}.csv"), recorded(file, setup, plan, seed))
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
fn recorded(file: &RobotFile, setup: &Setup, plan: &Plan, seed: u64) -> String {
    let row = 1.0 / plan.rate;
    let pace = Pace { row, steps: (row / setup.step()).ceil() as usize };
    let mut driver = Driver::new(file, plan.voltage, seed);
    let rows = (plan.duration * plan.rate).round() as usize;
    let readings = drive(setup, pace, rows, |k, moving| driver.command(k as f64 * row, moving.pose()));
    let mut noise = Drawn::new(seed ^ OF_NOISE);
    let mut next_frame = 0.0;
    let mut text = header(file.wheels.len(), plan.gyro);
    for reading in &readings {
        let framed = reading.time >= next_frame - 1e-9;
        if framed {
            next_frame += 1.0 / plan.camera_rate;
        }
        text += &line(reading, (framed, plan.gyro), &file.noise, &mut noise);
    }
    text
}

fn header(wheels: usize, gyro: bool) -> String {
    let of = |name: &str, unit: &str| (0..wheels).map(|j| format!(",{name}{j}_{unit}")).collect::<String>();
    let gyro = if gyro { ",gyro_rad_s" } else { "" };
    format!("t_s{}{}{},x_m,y_m,theta_rad{gyro}\n", of("u", "V"), of("i", "A"), of("w", "rad_s"))
}

fn line(reading: &Reading, (framed, gyro): (bool, bool), noise: &Noise, drawn: &mut Drawn) -> String {
    let mut line = format!("{:.6}", reading.time);
    let put = |line: &mut String, value: f64| write!(line, ",{value:.6}").expect("a string takes any text");
    reading.command.iter().for_each(|u| put(&mut line, *u));
    reading.currents.iter().for_each(|i| put(&mut line, i + noise.current * drawn.normal()));
    reading.wheel_speeds.iter().for_each(|w| put(&mut line, w + noise.wheel_speed * drawn.normal()));
    for (x, sigma) in reading.pose.iter().zip([noise.position, noise.position, noise.heading]) {
        // drawn on every row, so that a faster camera does not change all other noise
        let seen = x + sigma * drawn.normal();
        if framed {
            put(&mut line, seen);
        } else {
            line.push(',');
        }
    }
    if gyro {
        put(&mut line, reading.gyro + noise.gyro * drawn.normal());
    }
    line + "\n"
}
