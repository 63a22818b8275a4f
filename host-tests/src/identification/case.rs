//! What is played, and how it is measured.

use std::path::Path;

use omni_gap::known_effects;
use omni_gap::log::RobotFile;
use omni_gap::simulate::{Plan, Sensing, SensorSetup};

use crate::catalogue::sessions::truth;

/// Largest voltage on any motor [V]
pub const VOLTAGE: f64 = 8.0;
/// Side of the free floor [m]
pub const FIELD: f64 = 3.0;

/// What is measured with, and what on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StudyCase {
    /// Wheels of the robot.
    pub wheels: usize,
    /// How it is measured.
    pub sensing: Sensing,
    /// Time over which the camera's errors stay alike [s]; zero: white
    pub camera_correlation: f64,
    /// How often coast-downs and steps are repeated.
    pub repeats: usize,
    /// Trials.
    pub seeds: u64,
}

const fn paper(wheels: usize, camera_correlation: f64) -> StudyCase {
    let seeds = if camera_correlation == 0.0 { 400 } else { 20 };
    StudyCase { wheels, sensing: Sensing::Paper, camera_correlation, repeats: 2, seeds }
}

const fn modern(wheels: usize, sensing: Sensing) -> StudyCase {
    StudyCase { wheels, sensing, camera_correlation: 0.0, repeats: 1, seeds: 8 }
}

/// The cases of the study.
pub const CASES: [StudyCase; 8] = [
    paper(3, 0.0),
    paper(4, 0.0),
    paper(3, 0.15),
    paper(4, 0.15),
    modern(3, Sensing::Modern),
    modern(4, Sensing::Modern),
    modern(3, Sensing::Halls),
    modern(4, Sensing::Halls),
];

impl StudyCase {
    /// What is played.
    pub fn plan(&self) -> Plan {
        Plan { rate: self.sensing.rate(), voltage: VOLTAGE, field: FIELD, repeats: self.repeats, loads: 4 }
    }

    /// How it is recorded.
    pub fn recording(&self) -> SensorSetup {
        SensorSetup { camera_correlation: self.camera_correlation, ..self.sensing.recording() }
    }

    /// The robot as it is, its file stating the noise that it is recorded with.
    ///
    /// # Panics
    /// Never: the examples are part of this repository.
    pub fn truth(&self) -> RobotFile {
        let mut file =
            RobotFile::parse(truth(self.wheels), Path::new("robot.toml"), &known_effects()).expect("a sound example");
        file.sensors = self.recording().sensors;
        file
    }

    /// True if every camera frame's error is its own.
    pub fn is_white(&self) -> bool {
        self.camera_correlation == 0.0
    }

    /// True for the sensing that the promises of accuracy are about: the paper's, white.
    pub fn is_the_papers(&self) -> bool {
        self.sensing == Sensing::Paper && self.is_white()
    }

    /// How it is measured, in words.
    pub fn measured(&self) -> &'static str {
        match self.sensing {
            Sensing::Paper => "as the paper measured",
            Sensing::Modern => "modern sensors",
            Sensing::Halls => "modern, speeds by hall sensors",
        }
    }

    /// The camera's errors in words.
    pub fn camera(&self) -> String {
        if self.is_white() { "white".to_owned() } else { format!("alike over {} s", self.camera_correlation) }
    }

    /// The case in words.
    pub fn title(&self) -> String {
        let camera = if self.is_white() { String::new() } else { format!(", camera errors {}", self.camera()) };
        format!("{} wheels, {}{camera}", self.wheels, self.measured())
    }
}
