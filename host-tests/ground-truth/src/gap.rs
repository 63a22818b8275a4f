//! How large a gap is: what a robot that is just what its file says would miss of another one's drive, without noise.
//!
//! Free runs of half a second, each begun where the other robot truly is; the group of signals that is missed most counts:
//!
//! ```text
//! max over groups of √(mean of (read − predicted)²)/σ
//! ```

use nalgebra::Vector3;

use crate::driving::Driver;
use crate::reading::{Pace, Reading, apart, drive};
use crate::robot_file::RobotFile;
use crate::setup::Setup;
use crate::simulation::Simulation;

/// How long a prediction goes on its own [s]
const WINDOW_S: f64 = 0.5;

/// Between two rows of the drive on which a gap is measured [s]
const ROW_S: f64 = 5e-3;

/// The gap between a robot's file, its numbers true, and a robot with something hidden, over its noise [1], on a drive of so
/// many seconds.
pub fn gap(file: &RobotFile, hidden: &Setup, driver: &mut Driver, seconds: f64) -> f64 {
    let pace = Pace { row: ROW_S, steps: (ROW_S / hidden.step()).ceil() as usize };
    let rows = (seconds / ROW_S).round() as usize;
    let drawn = drive(hidden, pace, rows, |k, moving| driver.command(k as f64 * ROW_S, moving.pose()));
    apart(&drawn, &predicted(&file.setup(), &drawn), &file.noise)
}

/// What a robot's model says of a drive that was read, from the truth anew every half second.
pub fn predicted(model: &Setup, drawn: &[Reading]) -> Vec<Reading> {
    let window = (WINDOW_S / ROW_S).round() as usize;
    let mut all = Vec::with_capacity(drawn.len());
    for rows in drawn.chunks(window) {
        let steps = (ROW_S / model.step()).ceil() as usize;
        let mut moving = Simulation::new(model.robot.clone(), ROW_S / steps as f64);
        moving.set_at(rows[0].pose);
        moving.set_moving(Vector3::from(rows[0].twist));
        for row in rows {
            all.push(Reading {
                time: row.time,
                command: row.command.clone(),
                currents: moving.currents(&row.command),
                wheel_speeds: moving.wheel_speeds(),
                pose: moving.pose(),
                twist: moving.twist(),
                gyro: moving.twist()[2],
                ..Reading::default()
            });
            moving.hold(&row.command, steps);
        }
    }
    all
}
