//! How large a gap is: what a robot that is just what its file says would miss of another one's drive, without noise.
//!
//! Free runs of half a second, each begun where the other robot truly is; the group of signals that is missed most counts:
//!
//! ```text
//! max over groups of √(mean of (read − predicted)²)/σ
//! ```

use nalgebra::Vector3;

use crate::driving::Driver;
use crate::followed::Followed;
use crate::reading::{Pace, Reading, apart, drive};
use crate::robot_file::RobotFile;
use crate::setup::Setup;
use crate::simulation::Simulation;

/// How long a prediction goes on its own [s]
const WINDOW_S: f64 = 0.5;

/// Between two rows of the drive on which a gap is measured [s], where nothing depends on them
pub const ROW_S: f64 = 5e-3;

/// The gap between a robot's file, its numbers true, and a robot with something hidden, over its noise [1], on a drive of so
/// many seconds with so many between two rows.
pub fn gap(file: &RobotFile, hidden: &Setup, driver: &mut Driver, (seconds, row): (f64, f64)) -> f64 {
    let pace = Pace { row, steps: (row / hidden.step()).ceil() as usize };
    let rows = (seconds / row).round() as usize;
    let drawn = drive(hidden, pace, rows, |k, moving| driver.command(k as f64 * row, moving.pose()));
    apart(&drawn, &predicted(&file.setup(), &drawn, row), &file.noise)
}

/// What a robot's model says of a drive that was read with so many seconds between rows, from the truth anew every half
/// second. Of drives that control speed it says how wheels and body move.
pub fn predicted(model: &Setup, drawn: &[Reading], row: f64) -> Vec<Reading> {
    let window = (WINDOW_S / row).round() as usize;
    let begins = (0..drawn.len()).step_by(window);
    if let Some(drive) = model.robot.drive {
        let followed = Followed::new(&model.robot, drive);
        return begins.flat_map(|k| followed.predicted(drawn, k, drawn.len().min(k + window))).collect();
    }
    begins.flat_map(|k| pushed(model, &drawn[k..drawn.len().min(k + window)], row)).collect()
}

/// One window of it, of a robot that voltages push.
fn pushed(model: &Setup, rows: &[Reading], row: f64) -> Vec<Reading> {
    let steps = (row / model.step()).ceil() as usize;
    let mut moving = Simulation::new(model.robot.clone(), row / steps as f64);
    moving.set_at(rows[0].pose);
    moving.set_moving(Vector3::from(rows[0].twist));
    let mut said = |row: &Reading| {
        let reading = Reading {
            time: row.time,
            command: row.command.clone(),
            currents: moving.currents(&row.command),
            wheel_speeds: moving.wheel_speeds(),
            pose: moving.pose(),
            twist: moving.twist(),
            gyro: moving.twist()[2],
            ..Reading::default()
        };
        moving.hold(&row.command, steps);
        reading
    };
    rows.iter().map(&mut said).collect()
}
