//! A drive, and what a log of it would hold without noise.

use crate::drawn::Drawn;
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

/// When rows are written.
#[derive(Clone, Debug, PartialEq)]
pub struct Rows {
    /// A step of the simulator [s]
    step: f64,
    /// Of each row [s]
    times: Vec<f64>,
    /// Steps of the simulator up to each row, and up to the end.
    steps: Vec<usize>,
}

impl Rows {
    /// So many, one like the other.
    pub fn even(pace: Pace, rows: usize) -> Self {
        let times = (0..rows).map(|row| row as f64 * pace.row).collect();
        let steps = (0..=rows).map(|row| row * pace.steps).collect();
        Self { step: pace.row / pace.steps as f64, times, steps }
    }

    /// So many, each but the first earlier or later than its turn by up to a part of a row [1], in whole steps.
    pub fn jittered(pace: Pace, rows: usize, part: f64, drawn: &mut Drawn) -> Self {
        let most = (part * pace.steps as f64) as u32;
        let mut even = Self::even(pace, rows);
        if most > 0 {
            for row in 1..rows {
                even.steps[row] = even.steps[row] + drawn.below(2 * most + 1) as usize - most as usize;
                even.times[row] = even.steps[row] as f64 * even.step;
            }
        }
        even
    }

    /// Of each row [s]
    pub fn times(&self) -> &[f64] {
        &self.times
    }
}

/// What is read on one row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reading {
    /// Since the beginning [s]
    pub time: f64,
    /// What is commanded from this row on [V], or the speed that is set or demanded [rad/s]
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

/// Drives a robot from rest by what `command` says of each row and where the robot truly is, and reads it.
pub fn drive(
    setup: &Setup,
    pace: Pace,
    rows: usize,
    command: impl FnMut(usize, &Simulation) -> Vec<f64>,
) -> Vec<Reading> {
    drive_on(setup, &Rows::even(pace, rows), command).0
}

/// The same with rows at any times; and where its marker was, of which [`Setup::seen`] makes poses.
pub fn drive_on(
    setup: &Setup,
    rows: &Rows,
    mut command: impl FnMut(usize, &Simulation) -> Vec<f64>,
) -> (Vec<Reading>, Track) {
    let (sensors, step) = (&setup.sensors, rows.step);
    let mut moving = Simulation::new(setup.robot.clone(), step);
    let mut followed_currents = vec![0.0; sensors.currents.len()];
    let mut followed_speeds = vec![0.0; sensors.encoders.len()];
    let mut leaning = Leaning::default();
    let mut track = Track { step, poses: vec![moving.pose()] };
    let mut readings = Vec::with_capacity(rows.times.len());
    for (row, time) in rows.times.iter().enumerate() {
        let u = command(row, &moving);
        let currents = moving.currents(&u);
        let current = |(j, now): (usize, f64)| sensors.currents[j].read(now, followed_currents[j]);
        let speed = |(j, followed): (usize, &f64)| sensors.misread.counted(sensors.encoders[j].read(*followed));
        let mut currents: Vec<f64> = currents.into_iter().enumerate().map(current).collect();
        sensors.misread.mix(&mut currents);
        readings.push(Reading {
            time: *time,
            currents,
            wheel_speeds: followed_speeds.iter().enumerate().map(speed).collect(),
            gyro: moving.twist()[2] + sensors.gyro_bias,
            twist: moving.twist(),
            wheel_angles: moving.wheel_angles(),
            command: moving.demanded(&u),
            pose: [0.0; 3],
        });
        for _ in rows.steps[row]..rows.steps[row + 1] {
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
        reading.pose = setup.seen(&track, reading.time);
    }
    (readings, track)
}

impl Setup {
    /// The pose that the camera stamps with a time [s], of a marker that was there.
    pub fn seen(&self, track: &Track, time: f64) -> [f64; 3] {
        self.sensors.misread.bent(self.sensors.camera.read(track, time))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn jittered_rows_lie_within_a_part_of_a_row_of_their_turn_on_whole_steps_and_in_order() {
        let pace = Pace { row: 8e-3, steps: 80 };
        let rows = Rows::jittered(pace, 1000, 0.2, &mut Drawn::new(5));
        let off: Vec<f64> = rows.times().iter().enumerate().map(|(k, t)| (t - k as f64 * 8e-3) / 8e-3).collect();
        assert!(off.iter().all(|off| off.abs() < 0.2 + 1e-9) && off[0] == 0.0);
        // even between −0.2 and 0.2: a variance of 0.4²/12, in 33 steps a little more
        let variance = off.iter().map(|off| off * off).sum::<f64>() / 1000.0;
        assert!((variance / (0.16 / 12.0) - 1.0).abs() < 0.15, "{variance}");
        assert!(rows.steps.windows(2).all(|pair| pair[0] < pair[1]));
        for (time, steps) in rows.times().iter().zip(&rows.steps) {
            assert!((time - *steps as f64 * 1e-4).abs() < 1e-12);
        }
        assert_eq!(Rows::jittered(pace, 9, 0.0, &mut Drawn::new(5)), Rows::even(pace, 9));
    }

    #[test]
    fn a_row_that_is_late_is_read_when_it_is_written() {
        let setup = crate::robot_file::RobotFile::paper(0.0).setup();
        let pace = Pace { row: 1e-2, steps: 100 };
        let rows = Rows::jittered(pace, 60, 0.2, &mut Drawn::new(8));
        let held = |_: usize, _: &Simulation| vec![6.0, -2.0, -6.0, 2.0];
        let fine = drive(&setup, Pace { row: 1e-4, steps: 1 }, 6001, held);
        for reading in drive_on(&setup, &rows, held).0 {
            let at = &fine[(reading.time / 1e-4).round() as usize];
            assert_eq!(reading.wheel_speeds, at.wheel_speeds);
            assert!(reading.pose.iter().zip(at.pose).all(|(a, b)| (a - b).abs() < 1e-12));
        }
    }
}
