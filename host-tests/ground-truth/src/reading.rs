//! A drive, and what a log of it would hold without noise.

use crate::misread::Leaning;
use crate::robot_file::Noise;
use crate::sensors::follows;
use crate::setup::Setup;
use crate::simulation::Simulation;
use crate::track::Track;

/// How a robot is driven and read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pace {
    /// Between two rows [s]
    pub row: f64,
    /// Steps of the simulator in a row.
    pub steps: usize,
}

/// What is read on one row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reading {
    /// Since the beginning [s]
    pub time: f64,
    /// What is commanded from this row on [V]
    pub command: Vec<f64>,
    /// Just after that [A]
    pub currents: Vec<f64>,
    /// [rad/s]
    pub wheel_speeds: Vec<f64>,
    /// x, y, θ [m, m, rad], θ not wrapped
    pub pose: [f64; 3],
    /// [rad/s]
    pub gyro: f64,
    /// How far the wheels have truly turned [rad]
    pub wheel_angles: Vec<f64>,
    /// v, vn, ω as they truly are [m/s, m/s, rad/s]: no log has them
    pub twist: [f64; 3],
}

/// RMS difference of the group of signals in which two drives differ most, over its noise [1]: currents, wheel speeds,
/// position, heading, yaw rate.
pub fn apart(a: &[Reading], b: &[Reading], noise: &Noise) -> f64 {
    let group = |sigma: f64, of: fn(&Reading) -> &[f64]| {
        let pairs = a.iter().zip(b).flat_map(|(a, b)| of(a).iter().zip(of(b)));
        let (sum, count) = pairs.fold((0.0, 0.0), |(sum, count), (a, b)| (sum + (a - b) * (a - b), count + 1.0));
        (sum / f64::max(count, 1.0)).sqrt() / sigma
    };
    let groups = [
        group(noise.current, |reading| &reading.currents),
        group(noise.wheel_speed, |reading| &reading.wheel_speeds),
        group(noise.position, |reading| &reading.pose[..2]),
        group(noise.heading, |reading| &reading.pose[2..]),
        group(noise.gyro, |reading| std::slice::from_ref(&reading.gyro)),
    ];
    groups.into_iter().fold(0.0, f64::max)
}

/// Drives a robot from rest by what `command` says of each row and time [s] and where the robot truly is, and reads it.
pub fn drive(
    setup: &Setup,
    pace: Pace,
    rows: usize,
    mut command: impl FnMut(usize, &Simulation) -> Vec<f64>,
) -> Vec<Reading> {
    let (sensors, step) = (&setup.sensors, pace.row / pace.steps as f64);
    let mut moving = Simulation::new(setup.robot.clone(), step);
    let mut followed_currents = vec![0.0; sensors.currents.len()];
    let mut followed_speeds = vec![0.0; sensors.encoders.len()];
    let mut leaning = Leaning::default();
    let mut track = Track { step, poses: vec![moving.pose()] };
    let mut readings = Vec::with_capacity(rows);
    for row in 0..rows {
        let u = command(row, &moving);
        let currents = moving.currents(&u);
        let current = |(j, now): (usize, f64)| sensors.currents[j].read(now, followed_currents[j]);
        let speed = |(j, followed): (usize, &f64)| sensors.misread.counted(sensors.encoders[j].read(*followed));
        let mut currents: Vec<f64> = currents.into_iter().enumerate().map(current).collect();
        sensors.misread.mix(&mut currents);
        readings.push(Reading {
            time: row as f64 * pace.row,
            currents,
            wheel_speeds: followed_speeds.iter().enumerate().map(speed).collect(),
            gyro: moving.twist()[2] + sensors.gyro_bias,
            twist: moving.twist(),
            wheel_angles: moving.wheel_angles(),
            command: u.clone(),
            pose: [0.0; 3],
        });
        for _ in 0..pace.steps {
            moving.hold(&u, 1);
            if let Some(lean) = &sensors.misread.lean {
                leaning = leaning.after(lean, moving.acceleration(), step);
            }
            track.poses.push(sensors.misread.leant(moving.pose(), &leaning));
            for (j, followed) in followed_currents.iter_mut().enumerate() {
                *followed = follows(*followed, moving.driving_currents()[j], sensors.currents[j].lag, step);
            }
            for (j, followed) in followed_speeds.iter_mut().enumerate() {
                *followed = follows(*followed, moving.wheel_speed(j), sensors.encoders[j].lag, step);
            }
        }
    }
    for reading in &mut readings {
        reading.pose = sensors.misread.bent(sensors.camera.read(&track, reading.time));
    }
    readings
}
