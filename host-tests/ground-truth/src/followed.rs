//! What a robot's model says whose wheels follow the speeds that are set: no forces, and no voltages.
//!
//! ```text
//! T·dw/dt + w = w_set(t − t_d)                 each wheel by itself; at once where T is 0
//! (v, vn, ω) = arg min Σ_j (r_j·w_j − row_j·(v, vn, ω))²
//! ```
//!
//! That is what the paper's kinematics leave of a robot that is told speeds.

use nalgebra::{Matrix3, Vector2, Vector3};

use crate::contact::floor_row;
use crate::reading::Reading;
use crate::robot::Robot;
use crate::rotated::rotated;
use crate::speed_drive::SpeedDrive;

/// Parts of a row in which a lag is followed.
const PARTS: u32 = 4;

/// Two times that are no further apart are the same [s]: sums of steps round.
const ROUNDED: f64 = 1e-9;

/// Wheels that follow their drives, and a body that follows its wheels.
#[derive(Clone, Debug)]
pub struct Followed<'a> {
    robot: &'a Robot,
    drive: SpeedDrive,
    /// (GᵀG)⁻¹
    inverse: Matrix3<f64>,
    rows: Vec<Vector3<f64>>,
}

impl<'a> Followed<'a> {
    /// A robot's, by a drive of its.
    pub fn new(robot: &'a Robot, drive: SpeedDrive) -> Self {
        let rows: Vec<_> = robot.wheels.iter().map(|wheel| floor_row(wheel.contact, wheel.heading)).collect();
        let gram: Matrix3<f64> = rows.iter().map(|row| row * row.transpose()).sum();
        let inverse = gram.try_inverse().expect("wheels that move a body along every axis");
        Self { robot, drive, inverse, rows }
    }

    /// v, vn, ω of a body that comes nearest to rolling on wheels with these speeds [rad/s].
    pub fn twist(&self, speeds: &[f64]) -> Vector3<f64> {
        let along = |((row, wheel), w): ((&Vector3<f64>, &crate::robot::Wheel), &f64)| row * (wheel.radius * w);
        self.inverse * self.rows.iter().zip(&self.robot.wheels).zip(speeds).map(along).sum::<Vector3<f64>>()
    }

    /// Rows of a drive from one of them up to another, begun as that was read.
    pub fn predicted(&self, drawn: &[Reading], from: usize, to: usize) -> Vec<Reading> {
        let mut speeds = drawn[from].wheel_speeds.clone();
        let mut pose = drawn[from].pose;
        let mut all = Vec::with_capacity(to - from);
        for k in from..to {
            let now = &drawn[k];
            // a lag of nothing is read as it is told
            self.follow(drawn, k, now.time, 0.0, &mut speeds);
            let twist = self.twist(&speeds);
            all.push(Reading {
                time: now.time,
                command: now.command.clone(),
                wheel_speeds: speeds.clone(),
                pose,
                twist: twist.into(),
                gyro: twist.z,
                ..Reading::default()
            });
            let Some(next) = drawn.get(k + 1) else { break };
            let part = (next.time - now.time) / f64::from(PARTS);
            for p in 0..PARTS {
                let before = self.twist(&speeds);
                self.follow(drawn, k, now.time + (f64::from(p) + 0.5) * part, part, &mut speeds);
                let mean = 0.5 * (before + self.twist(&speeds));
                let way = part * rotated(pose[2] + 0.5 * part * mean.z, Vector2::new(mean.x, mean.y));
                pose = [pose[0] + way.x, pose[1] + way.y, pose[2] + part * mean.z];
            }
        }
        all
    }

    /// Lets wheels follow for a while [s] what was set a dead time before a time [s], which is in row k.
    fn follow(&self, drawn: &[Reading], k: usize, time: f64, during: f64, speeds: &mut [f64]) {
        let heard = drawn[..=k].iter().rev().find(|row| row.time <= time - self.drive.dead_time + ROUNDED);
        let left = match self.drive.smoothing {
            lag if lag > 0.0 => libm::exp(-during / lag),
            _ => 0.0,
        };
        for (j, speed) in speeds.iter_mut().enumerate() {
            let set = heard.map_or(0.0, |row| row.command[j]);
            *speed = set + left * (*speed - set);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot_file::{RobotFile, SpeedLoop};

    fn file(dead_time: f64, lag: f64) -> RobotFile {
        RobotFile { drive: Some(SpeedLoop { dead_time, lag, line: 0.0 }), ..RobotFile::paper(0.0) }
    }

    /// Rows of 10 ms at rest, all wheels told a turn on the spot [rad/s].
    fn told(speed: f64, rows: usize) -> Vec<Reading> {
        let row = |k: usize| Reading {
            time: 0.01 * k as f64,
            command: vec![speed; 4],
            wheel_speeds: vec![0.0; 4],
            ..Reading::default()
        };
        (0..rows).map(row).collect()
    }

    fn predicted(file: &RobotFile, drawn: &[Reading]) -> Vec<Reading> {
        let setup = file.setup();
        let drive = setup.robot.drive.expect("a drive");
        Followed::new(&setup.robot, drive).predicted(drawn, 0, drawn.len())
    }

    #[test]
    fn wheels_that_follow_at_once_turn_the_body_by_the_arc_that_they_roll() {
        let rows = predicted(&file(0.0, 0.0), &told(10.0, 51));
        assert_eq!(rows[0].wheel_speeds, [10.0; 4]);
        // ω = r·w/d
        let expected = 0.5 * 10.0 * 0.0325 / 0.089;
        assert!((rows[50].pose[2] - expected).abs() < 1e-12, "{:?}", rows[50].pose);
        assert!(libm::hypot(rows[50].pose[0], rows[50].pose[1]) < 1e-12);
    }

    #[test]
    fn a_dead_time_and_a_lag_are_those_of_the_closed_form() {
        let rows = predicted(&file(0.1, 0.04), &told(10.0, 60));
        for row in &rows {
            let expected = 10.0 * -libm::expm1(-(row.time - 0.1).max(0.0) / 0.04);
            assert!((row.wheel_speeds[1] - expected).abs() < 1e-9, "{} s: {:?}", row.time, row.wheel_speeds);
        }
    }
}
