//! Recordings: what a log of a drive holds, with noise, as the data contract has it.

use crate::drawn::Drawn;
use crate::driving::{Driver, Style};
use crate::logging::{CameraClock, Log, Logging};
use crate::reading::{Pace, Reading, Rows, drive_on};
use crate::robot_file::RobotFile;
use crate::setup::Setup;
use crate::track::Track;
use crate::unrest::{Forces, Unrest};

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
    /// Small forces of the floor.
    pub unrest: Option<Unrest>,
}

/// What stands in a session folder.
#[derive(Clone, Debug, PartialEq)]
pub struct Session {
    /// `robot.toml`
    pub robot: String,
    /// `columns.toml`, where runs are folders
    pub columns: Option<String>,
    /// `runs/NAME`, each with its text; of a run that is a folder, `runs/NAME/FILE`.
    pub runs: Vec<(String, String)>,
}

/// What parts the noise of a run from its drive.
const OF_NOISE: u64 = 0x5eed;

/// What parts the time at which a run begins from its drive.
const OF_CLOCK: u64 = 0xc10c;

/// What parts the same of the floor, of when rows are written, of a camera with a clock of its own, and of that clock.
const OF_FLOOR: u64 = 0xf100;
const OF_ROWS: u64 = 0x7011;
const OF_CAMERA: u64 = 0xca3e;
const OF_OFFSET: u64 = 0x0ff5;

/// Some time within this the room's clock shows when a run begins [s]
const DAY: f64 = 120.0;

/// How far a camera's clock may be from the drive's [s], where that is known and where it is not.
const KNOWN_S: (f64, f64) = (2e-3, 5.0);
const UNKNOWN_S: f64 = 2.0;

impl Session {
    /// Recordings of a robot whose file says something else, or the same.
    pub fn of(file: &RobotFile, setup: &Setup, plan: &Plan, seed: u64) -> Self {
        Self::logged((file, setup), plan, &Logging::clean(), seed)
    }

    /// The same, logged as it may be.
    pub fn logged((file, setup): (&RobotFile, &Setup), plan: &Plan, logging: &Logging, seed: u64) -> Self {
        let driven = |seed| Run::driven((file, setup), plan, logging, seed);
        Self::of_runs((file, plan, logging), seed, driven)
    }

    /// The same of a script: volts on each motor, row by row at so many rows a second [1/s], that is played in every run.
    pub fn played(
        (file, setup): (&RobotFile, &Setup),
        plan: &Plan,
        logging: &Logging,
        (volts, rate): (&[Vec<f64>], f64),
        seed: u64,
    ) -> Self {
        let at = |time: f64| volts[((time * rate + 1e-9) as usize).min(volts.len() - 1)].clone();
        let played = |seed| Run::commanded((file, setup), plan, logging, seed, |time, _| at(time));
        Self::of_runs((file, plan, logging), seed, played)
    }

    fn of_runs<'a>(
        (file, plan, logging): (&RobotFile, &Plan, &Logging),
        seed: u64,
        recorded: impl Fn(u64) -> Run<'a>,
    ) -> Self {
        let mut of_clock = Drawn::new(seed ^ OF_OFFSET);
        let magnitude = of_clock.log_between(KNOWN_S.0, KNOWN_S.1);
        let known = if of_clock.below(2) == 0 { magnitude } else { -magnitude };
        let run = |k: usize| {
            let seed = seed.wrapping_mul(1000).wrapping_add(k as u64);
            let run = recorded(seed);
            match logging.camera.filter(|_| logging.pose) {
                None => vec![(format!("run{k}.csv"), run.rows())],
                Some(clock) => {
                    let offset = if clock == CameraClock::Known { known } else { run.any_offset() };
                    let frames = (format!("run{k}/camera.csv"), run.frames(offset));
                    vec![(format!("run{k}/drive.csv"), run.rows()), frames]
                }
            }
        };
        let runs = (0..plan.runs).flat_map(run).collect();
        let columns = logging.camera.filter(|_| logging.pose).map(|clock| match clock {
            CameraClock::Known => columns(&format!("{known:?}")),
            CameraClock::Unknown => columns("\"estimate\""),
        });
        Self { robot: file.toml(), columns, runs }
    }

    /// Writes the folder.
    ///
    /// # Errors
    /// Where a file cannot be written.
    pub fn write(&self, folder: &std::path::Path) -> std::io::Result<()> {
        let runs = folder.join("runs");
        std::fs::create_dir_all(&runs)?;
        std::fs::write(folder.join("robot.toml"), &self.robot)?;
        if let Some(columns) = &self.columns {
            std::fs::write(folder.join("columns.toml"), columns)?;
        }
        self.runs.iter().try_for_each(|(name, text)| {
            let place = runs.join(name);
            std::fs::create_dir_all(place.parent().unwrap_or(&runs))?;
            std::fs::write(place, text)
        })
    }
}

/// The text of `columns.toml` of runs with a camera whose clock is so far from the drive's.
fn columns(offset: &str) -> String {
    format!("[[file]]\nname = \"drive.csv\"\n\n[[file]]\nname = \"camera.csv\"\noffset_s = {offset}\n")
}

/// A run that was driven and is still to be logged.
struct Run<'a> {
    file: &'a RobotFile,
    /// The robot in this run.
    setup: Setup,
    plan: &'a Plan,
    logging: &'a Logging,
    seed: u64,
    readings: Vec<Reading>,
    track: Track,
}

impl<'a> Run<'a> {
    fn driven((file, setup): (&'a RobotFile, &Setup), plan: &'a Plan, logging: &'a Logging, seed: u64) -> Self {
        let mut driver = Driver::new(file, plan.voltage, plan.style, seed);
        Self::commanded((file, setup), plan, logging, seed, |time, pose| driver.command(time, pose))
    }

    /// By what a command says at a time [s] and a pose [m, m, rad].
    fn commanded(
        (file, setup): (&'a RobotFile, &Setup),
        plan: &'a Plan,
        logging: &'a Logging,
        seed: u64,
        mut command: impl FnMut(f64, [f64; 3]) -> Vec<f64>,
    ) -> Self {
        let row = 1.0 / plan.rate;
        let pace = Pace { row, steps: (row / setup.step()).ceil() as usize };
        let count = (plan.duration * plan.rate).round() as usize;
        let mut setup = setup.clone().begun_at(Drawn::new(seed ^ OF_CLOCK).between(0.0, DAY));
        if let Some(unrest) = &plan.unrest {
            let coulomb = setup.robot.chassis.friction.coulomb;
            let forces = Forces::drawn(unrest, coulomb, plan.duration, seed ^ OF_FLOOR);
            setup.robot.surroundings.unrest = Some(forces);
        }
        let rows = Rows::jittered(pace, count, logging.jitter, &mut Drawn::new(seed ^ OF_ROWS));
        let (readings, track) = drive_on(&setup, &rows, |k, moving| command(rows.times()[k], moving.pose()));
        Self { file, setup, plan, logging, seed, readings, track }
    }

    /// As a table; with the frames of the camera, where that has no clock of its own.
    fn rows(&self) -> String {
        let mut log = Log::new(self.logging, &self.file.noise, self.plan.gyro, self.seed ^ OF_NOISE)
            .of_set_speeds(self.file.drive.is_some());
        let mut next_frame = 0.0;
        let mut text = log.header(self.file.wheels.len());
        for reading in &self.readings {
            let framed = self.logging.camera.is_none() && reading.time >= next_frame - 1e-9;
            if framed {
                next_frame += 1.0 / self.plan.camera_rate;
            }
            text += &log.row(reading, framed);
        }
        text
    }

    /// A camera's own table: frames when it takes them, stamped by a clock to which so much has to be added to get the
    /// drive's time [s].
    fn frames(&self, offset: f64) -> String {
        let mut log = Log::new(self.logging, &self.file.noise, false, self.seed ^ OF_CAMERA);
        let mut drawn = Drawn::new(self.seed ^ OF_CAMERA ^ OF_ROWS);
        let (apart, jitter) = (1.0 / self.plan.camera_rate, self.logging.jitter);
        let first = drawn.between(jitter, 1.0 - jitter);
        let mut text = Log::camera_header().to_owned();
        for frame in 0.. {
            let time = apart * (f64::from(frame) + first + drawn.between(-jitter, jitter));
            if time >= self.plan.duration {
                return text;
            }
            text += &log.frame((time, time - offset), self.setup.seen(&self.track, time));
        }
        text
    }

    /// How far the clock of a camera is off in this run that nobody looks after [s].
    fn any_offset(&self) -> f64 {
        Drawn::new(self.seed ^ OF_OFFSET).between(-UNKNOWN_S, UNKNOWN_S)
    }
}
