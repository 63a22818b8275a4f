//! The robots, and how they are driven.

use std::path::Path;

use omni_gap::api::{Confusion, Driven, PlannedRuns, SelftestKnobs, confusion};
use omni_gap::error::Result;
use omni_gap::known_effects;
use omni_gap::log::{Channel, Group, RobotFile, Run};
use omni_gap::simulate::{AXES, Excitation, Model, SignalGroup, along, excite, usual_voltage};

use crate::catalogue::sessions::truth;

/// What is planned: rows a second [1/s] and camera frames a second [1/s].
pub const RATE: f64 = 200.0;
/// See [`RATE`].
pub const CAMERA: f64 = 60.0;
/// By how much the wheels of the X layout are turned [°]
const TURNED_DEG: f64 = 45.0;

/// What is logged.
const LOGGED: [SignalGroup; 3] = [SignalGroup::Current, SignalGroup::WheelSpeed, SignalGroup::Pose];

/// A robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// The paper's three wheels.
    Three,
    /// The paper's four wheels, two along each axis.
    Plus,
    /// The same robot with its wheels turned by 45°.
    X,
}

/// How it is driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// On all three axes at once: random steps with rests and reversals.
    AllAxes,
    /// The same steps along v, then along vn, then about ω.
    OneAxis,
}

/// A robot that is driven so.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ConfusionCase {
    /// The robot.
    pub layout: Layout,
    /// How it is driven.
    pub motion: Motion,
}

/// How much is recorded: pieces and the length of each [s].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Amount {
    /// Runs of random motion; where one axis is driven at a time, pieces of one run. A multiple of three.
    pub pieces: usize,
    /// Length of each [s]
    pub duration: f64,
}

impl Amount {
    /// As much of random motion on all axes at once, up to a voltage [V].
    pub fn at_random(self, voltage: f64) -> Driven {
        Driven::Random { runs: self.pieces, duration: self.duration, rate: RATE, voltage }
    }
}

/// Recordings that are driven so, with what is logged.
pub fn logged(driven: Driven) -> PlannedRuns {
    PlannedRuns { driven, logged: LOGGED.to_vec(), camera_rate: CAMERA }
}

/// What the page is made of.
pub const WHOLE: Amount = Amount { pieces: 6, duration: 10.0 };

/// All of them, in the order of the page.
pub fn cases() -> Vec<ConfusionCase> {
    let of = |layout| [Motion::AllAxes, Motion::OneAxis].map(|motion| ConfusionCase { layout, motion });
    [Layout::Three, Layout::Plus, Layout::X].into_iter().flat_map(of).collect()
}

impl Layout {
    /// The text of its robot file.
    pub fn text(self) -> String {
        match self {
            Layout::Three => truth(3).to_owned(),
            Layout::Plus => truth(4).to_owned(),
            Layout::X => truth(4).lines().map(|line| turned(line) + "\n").collect(),
        }
    }

    /// Its robot file.
    ///
    /// # Errors
    /// Where that is not sound.
    pub fn robot(self) -> Result<RobotFile> {
        RobotFile::parse(&self.text(), Path::new("robot.toml"), &known_effects())
    }

    /// Its name for people.
    pub fn title(self) -> &'static str {
        match self {
            Layout::Three => "three wheels",
            Layout::Plus => "four wheels, +",
            Layout::X => "four wheels, X",
        }
    }
}

/// A line of a robot file, with its wheel turned.
fn turned(line: &str) -> String {
    let angle = line.strip_prefix("drive_angle_deg = ").and_then(|angle| angle.trim().parse::<f64>().ok());
    angle.map_or(line.to_owned(), |angle| format!("drive_angle_deg = {:.1}", angle + TURNED_DEG))
}

impl ConfusionCase {
    /// Its name for people.
    pub fn title(self) -> String {
        let motion = match self.motion {
            Motion::AllAxes => "all axes at once",
            Motion::OneAxis => "one axis at a time",
        };
        format!("{}, {motion}", self.layout.title())
    }

    /// The name of its picture in the folder of golden pages.
    pub fn picture(self) -> String {
        let layout = match self.layout {
            Layout::Three => "3w",
            Layout::Plus => "4w",
            Layout::X => "4w-x",
        };
        let motion = match self.motion {
            Motion::AllAxes => "all-axes",
            Motion::OneAxis => "one-axis",
        };
        format!("confusion-{layout}-{motion}.svg")
    }

    /// Which cause would be taken for which in so many recordings.
    ///
    /// # Errors
    /// Where the robot file is not sound.
    pub fn confusion(self, amount: Amount) -> Result<Confusion> {
        let file = self.layout.robot()?;
        let voltage = usual_voltage(&file);
        let driven = match (self.motion, self.layout) {
            (Motion::AllAxes, _) => amount.at_random(voltage),
            (Motion::OneAxis, Layout::Three) => one_axis::<3>(&file, amount, voltage),
            (Motion::OneAxis, Layout::Plus | Layout::X) => one_axis::<4>(&file, amount, voltage),
        };
        confusion(&file, &logged(driven), &SelftestKnobs::default())
    }
}

/// The random motion's own voltages, of each piece one axis alone: first v, then vn, then ω.
fn one_axis<const N: usize>(file: &RobotFile, amount: Amount, voltage: f64) -> Driven {
    let wheels = Model::<N>::nominal(file, voltage).robot().wheels;
    let wish = Excitation { duration: amount.duration, rate: RATE, voltage };
    let rows: Vec<[f64; N]> = (0..amount.pieces)
        .flat_map(|piece| {
            let along = along(&wheels, piece * AXES.len() / amount.pieces, 1.0);
            let square: f64 = along.iter().map(|a| a * a).sum();
            excite(&wheels, &wish, 1 + piece as u64).into_iter().map(move |u| {
                let share = u.iter().zip(&along).map(|(u, a)| u * a).sum::<f64>() / square;
                along.map(|a| a * share)
            })
        })
        .collect();
    let volts = (0..N).map(|j| Channel::from_values(rows.iter().map(|u| u[j]))).collect();
    let t_s = (0..rows.len()).map(|row| row as f64 / RATE).collect();
    let name = "one axis at a time".to_owned();
    Driven::Scripts(vec![Run { name, t_s, u: Some(Group::new(volts)), ..Run::default() }])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_wheels_of_the_x_layout_stand_between_the_axes() {
        let file = Layout::X.robot().unwrap();
        let angles: Vec<f64> = file.wheel.iter().map(|wheel| wheel.drive_angle_deg).collect();
        assert_eq!(angles, [135.0, 225.0, 315.0, 45.0]);
    }

    #[test]
    fn a_piece_of_one_axis_drives_the_others_not_at_all() {
        let file = Layout::Three.robot().unwrap();
        let Driven::Scripts(runs) = one_axis::<3>(&file, Amount { pieces: 3, duration: 2.0 }, 8.0) else {
            panic!("a script");
        };
        let u = runs[0].u.as_ref().expect("voltages");
        let at = |row: usize| -> [f64; 3] { std::array::from_fn(|j| u.channels[j].get(row).unwrap()) };
        for row in 0..1200 {
            let [a, b, c] = at(row);
            // wheels at 150°, 270° and 30°: forwards, the middle one stands still
            match row / 400 {
                0 => assert!(b.abs() < 1e-9 && (a + c).abs() < 1e-9, "row {row}: {:?}", at(row)),
                1 => assert!((a - c).abs() < 1e-9 && (a + b + c).abs() < 1e-9, "row {row}: {:?}", at(row)),
                _ => assert!((a - b).abs() < 1e-9 && (a - c).abs() < 1e-9, "row {row}: {:?}", at(row)),
            }
        }
        assert!((0..3).all(|axis| (0..400).any(|row| at(400 * axis + row)[0].abs() > 0.5)));
    }
}
