//! A recording of a robot that is not there: a plant, its sensors, their noise and their gaps.

use model_core::effects::telegram::Telegram;
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::plant::{Input, Plant, Reading};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::halls::Halls;
use crate::log::{Channel, Group, Missing, Run, SensorsFile, retimed};

/// How a recording is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorSetup {
    /// Plant steps in a row of mean length; a longer row takes as many more.
    pub steps_a_row: usize,
    /// Camera frames a second [1/s]; a row gets a pose when a frame has come since the row before
    pub camera_rate: f64,
    /// Share of frames that the camera loses
    pub dropouts: f64,
    /// Noise of the sensors.
    pub sensors: SensorsFile,
    /// Time over which the camera's errors stay alike [s]; zero: each frame's are its own
    pub camera_correlation: f64,
    /// Where wheel speeds come from.
    pub speed: SpeedSensor,
    /// Whether the yaw rate is logged too, as a gyro tells it
    pub gyro: bool,
    /// Whether the bus voltage is logged too
    pub battery: bool,
}

/// Where wheel speeds come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpeedSensor {
    /// There is none.
    None,
    /// An encoder fine enough to count as continuous.
    Encoder,
    /// Hall sensors: the time between edges, as the reader of a log makes of it.
    Halls {
        /// Edges in a turn of the wheel.
        edges_per_turn: f64,
    },
}

impl Default for SensorSetup {
    /// What a diagnosis is staged with: ten plant steps a row, a camera of 60 frames a second that loses some, encoders.
    fn default() -> Self {
        Self {
            steps_a_row: 10,
            camera_rate: 60.0,
            dropouts: 0.03,
            sensors: SensorsFile::default(),
            camera_correlation: 0.0,
            speed: SpeedSensor::Encoder,
            gyro: false,
            battery: false,
        }
    }
}

/// Noise of a gyro and of a battery reading whose robot file states none [rad/s] [V]
pub(super) const GYRO_NOISE_RAD_S: f64 = 0.01;
pub(super) const BATTERY_NOISE_V: f64 = 0.05;

/// What makes the seed of lost telegrams another than a run's.
pub const LOSSES: u64 = 0xbb67_ae85_84ca_a73b;

/// Drives the plant with one input a row, `dt` [s] long, and records what its sensors say.
///
/// The noise is Gaussian, and white unless the camera's is said to be otherwise; the same seed gives the same run.
pub fn record<const N: usize>(
    plant: &Plant<N, f64>,
    name: &str,
    t: &[f64],
    input: &[Input<N, f64>],
    how: &SensorSetup,
    seed: u64,
) -> Run {
    let rows = t.len();
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut noise = |sigma: f64| {
        let x: f64 = StandardNormal.sample(&mut random);
        sigma * x
    };
    let mut gaps = ChaCha8Rng::seed_from_u64(seed ^ 0x9e37_79b9_7f4a_7c15);
    let mut beside = ChaCha8Rng::seed_from_u64(seed ^ 0x6a09_e667_f3bc_c908);
    let mut losses = ChaCha8Rng::seed_from_u64(seed ^ LOSSES);
    let (mut gyro, mut vbat) = (Channel::with_capacity(rows), Channel::with_capacity(rows));
    let mut memory = plant.memory().collect::<Vec<_>>();
    let mut state = plant.start(0.0, Pose::default(), BodyTwist::default());
    let step = if rows > 1 { (t[rows - 1] - t[0]) / (rows - 1) as f64 } else { 0.0 };
    let mut i = vec![Channel::with_capacity(rows); N];
    let mut w = vec![Channel::with_capacity(rows); N];
    let mut pose = vec![Channel::with_capacity(rows); 3];
    let mut halls = [Halls::default(); N];
    let (mut frames, mut wander, mut wandered) = (-1.0, [0.0; 3], f64::NEG_INFINITY);
    for (row, held) in input.iter().enumerate().take(rows) {
        let length = t.get(row + 1).map_or(step, |next| next - t[row]);
        let steps = if step > 0.0 { (length / step * how.steps_a_row as f64).round().max(1.0) as usize } else { 1 };
        let dt = length / steps as f64;
        let arrived = plant.receive(&mut memory, held, Some(&Telegram::drawn(losses.random())));
        let reading: Reading<N, f64> = plant.step(&mut state, &mut memory, &arrived, dt);
        let mut of = |sigma: f64| -> f64 { sigma * Distribution::<f64>::sample(&StandardNormal, &mut beside) };
        gyro.push(reading.gyro + of(how.sensors.gyro_noise_rad_s.unwrap_or(GYRO_NOISE_RAD_S)));
        vbat.push(state.bus + of(how.sensors.battery_noise_v.unwrap_or(BATTERY_NOISE_V)));
        for j in 0..N {
            i[j].push(reading.current[j] + noise(how.sensors.current_noise_a));
            let speed_noise = noise(how.sensors.wheel_speed_noise_rad_s);
            match how.speed {
                SpeedSensor::None => {}
                SpeedSensor::Encoder => w[j].push(reading.wheel_speed[j] + speed_noise),
                SpeedSensor::Halls { .. } => w[j].push(halls[j].read(speed_noise)),
            }
        }
        let mut turn = |reading: &Reading<N, f64>, k: usize| {
            let SpeedSensor::Halls { edges_per_turn } = how.speed else { return };
            for (halls, speed) in halls.iter_mut().zip(reading.wheel_speed) {
                halls.turn(t[row] - t[0] + k as f64 * dt, speed, dt, edges_per_turn);
            }
        };
        turn(&reading, 0);
        for k in 1..steps {
            let reading = plant.step(&mut state, &mut memory, &arrived, dt);
            turn(&reading, k);
        }
        // an Ornstein–Uhlenbeck process: n ← ρ·n + √(1 − ρ²)·white, ρ = e^(−Δt/τ)
        let rho =
            if how.camera_correlation > 0.0 { (-(t[row] - wandered) / how.camera_correlation).exp() } else { 0.0 };
        let sigmas = [how.sensors.position_noise_m, how.sensors.position_noise_m, how.sensors.heading_noise_rad];
        for (wander, sigma) in wander.iter_mut().zip(sigmas) {
            *wander = rho * *wander + (1.0 - rho * rho).sqrt() * noise(sigma);
        }
        wandered = t[row];
        let seen = [reading.pose.x + wander[0], reading.pose.y + wander[1], reading.pose.theta + wander[2]];
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
    let driven = |wheel: usize, held: &Input<N, f64>| match held {
        Input::Bridges(x) => x[wheel].ok_or(Missing::Open),
        Input::Voltage(x) | Input::Current(x) | Input::Speed(x) | Input::SetSpeed(x) => Ok(x[wheel]),
    };
    let opens = |held: &Input<N, f64>| (0..N).all(|wheel| driven(wheel, held) == Err(Missing::Open));
    let column = |wheel: usize| input.iter().map(|held| driven(wheel, held)).collect();
    let driving = Some(Group::new((0..N).map(column).collect()));
    if let SpeedSensor::Halls { edges_per_turn } = how.speed {
        w = w.iter().map(|held| retimed(held, t, edges_per_turn)).collect();
    }
    let mut run = Run {
        name: name.to_owned(),
        t_s: t.to_vec(),
        i: Some(Group::new(i)),
        w: (how.speed != SpeedSensor::None).then(|| Group::new(w)),
        pose: Some(Group::new(pose)),
        gyro: how.gyro.then_some(gyro),
        vbat: how.battery.then_some(vbat),
        ..Run::default()
    };
    if input.iter().any(opens) {
        run.enable = Some(Channel::from_values(input.iter().map(|held| if opens(held) { 0.0 } else { 1.0 })));
    }
    match input.first() {
        Some(Input::Speed(_) | Input::SetSpeed(_)) => (run.wset, run.i) = (driving, None),
        Some(Input::Current(_)) => run.i = driving,
        _ => run.u = driving,
    }
    run
}
