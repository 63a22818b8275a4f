//! A recording of a robot that is not there: a plant, its sensors, their noise and their gaps.

use model_core::frames::{BodyTwist, Pose};
use model_core::plant::{Input, Plant, Reading};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::log::{Channel, Group, Missing, Run, SensorsFile};

/// How a recording is made.
#[derive(Clone, Copy, Debug)]
pub struct Recording {
    /// Plant steps in a row of mean length; a longer row takes as many more.
    pub steps_a_row: usize,
    /// Camera frames a second [1/s]; a row gets a pose when a frame has come since the row before
    pub camera_rate: f64,
    /// Share of frames that the camera loses
    pub dropouts: f64,
    /// Noise of the sensors.
    pub sensors: SensorsFile,
}

/// Drives the plant with one input a row, `dt` [s] long, and records what its sensors say.
///
/// The noise is white and Gaussian; the same seed gives the same run.
pub fn record<const N: usize>(
    plant: &Plant<N, f64>,
    name: &str,
    t: &[f64],
    input: &[Input<N, f64>],
    how: &Recording,
    seed: u64,
) -> Run {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut noise = |sigma: f64| {
        let x: f64 = StandardNormal.sample(&mut random);
        sigma * x
    };
    let mut gaps = ChaCha8Rng::seed_from_u64(seed ^ 0x9e37_79b9_7f4a_7c15);
    let mut memory = vec![0.0; plant.memory_len()];
    let mut state = plant.start(0.0, Pose::default(), BodyTwist::default());
    let rows = t.len();
    let step = if rows > 1 { (t[rows - 1] - t[0]) / (rows - 1) as f64 } else { 0.0 };
    let mut i = vec![Channel::with_capacity(rows); N];
    let mut w = vec![Channel::with_capacity(rows); N];
    let mut pose = vec![Channel::with_capacity(rows); 3];
    let mut frames = -1.0;
    for (row, held) in input.iter().enumerate().take(rows) {
        let length = t.get(row + 1).map_or(step, |next| next - t[row]);
        let steps = if step > 0.0 { (length / step * how.steps_a_row as f64).round().max(1.0) as usize } else { 1 };
        let dt = length / steps as f64;
        let reading: Reading<N, f64> = plant.step(&mut state, &mut memory, held, dt);
        for _ in 1..steps {
            plant.step(&mut state, &mut memory, held, dt);
        }
        for j in 0..N {
            i[j].push(reading.current[j] + noise(how.sensors.current_noise_a));
            w[j].push(reading.wheel_speed[j] + noise(how.sensors.wheel_speed_noise_rad_s));
        }
        let seen = [
            reading.pose.x + noise(how.sensors.position_noise_m),
            reading.pose.y + noise(how.sensors.position_noise_m),
            reading.pose.theta + noise(how.sensors.heading_noise_rad),
        ];
        let frame = ((t[row] - t[0]) * how.camera_rate + 1e-9).floor();
        let came = frame > frames && !gaps.random_bool(how.dropouts);
        frames = frame;
        for (channel, x) in pose.iter_mut().zip(seen) {
            if came {
                channel.push(x);
            } else {
                channel.push_missing(Missing::Blank);
            }
        }
    }
    let mut u = vec![Vec::with_capacity(rows); N];
    for held in input {
        let held = match held {
            Input::Voltage(x) | Input::Current(x) | Input::Speed(x) => x,
        };
        for (column, x) in u.iter_mut().zip(held) {
            column.push(*x);
        }
    }
    let driving = Some(Group::from_columns(u));
    let mut run = Run {
        name: name.to_owned(),
        t_s: t.to_vec(),
        i: Some(Group::new(i)),
        w: Some(Group::new(w)),
        pose: Some(Group::new(pose)),
        ..Run::default()
    };
    match input.first() {
        Some(Input::Speed(_)) => (run.wset, run.i) = (driving, None),
        Some(Input::Current(_)) => run.i = driving,
        _ => run.u = driving,
    }
    run
}
