//! The frames of a simulated robot: a plant looked at 20 000 times a second, through the codes of converters and the edges of halls.

use std::f64::consts::TAU;

use model_core::control::calibration::{AdcCode, Calibration};
use model_core::control::phases::{DirectQuadrature, Rotation, q_current};
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::link::record::{OperatingState, TelemetryRecord};
use model_core::plant::Input;
use omni_gap::known_effects;
use omni_gap::log::RobotFile;
use omni_gap::simulate::{Excitation, Model, excite};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Normal};

use crate::frames::{POLE_PAIRS, ZERO, sent};

/// Looks at the halls in a record, which comes every millisecond.
const LOOKS: u32 = 20;

/// The robot of a file.
pub fn robot(text: &str) -> RobotFile {
    RobotFile::parse(text, std::path::Path::new("robot.toml"), &known_effects()).unwrap()
}

/// The frames of a robot that drives for some seconds as one of these after the other, a piece a second.
pub fn streamed(robots: &[(&RobotFile, u32)], volts: f64) -> Vec<Vec<u8>> {
    let plants: Vec<_> = robots.iter().map(|(file, _)| Model::<4>::nominal(file, 12.0).plant()).collect();
    let seconds: u32 = robots.iter().map(|(_, seconds)| seconds).sum();
    let plan = Excitation { duration: f64::from(seconds), rate: 1000.0, voltage: volts };
    let input = excite(&plants[0].robot().wheels, &plan, 1);
    let mut noise = Noise::of(robots[0].0.sensors.current_noise_a);
    let edges_a_radian = 6.0 * f64::from(POLE_PAIRS) * robots[0].0.motor.gear_ratio / TAU;
    let mut state = plants[0].start(0.0, Pose::default(), BodyTwist::default());
    let (mut angle, mut edges, mut since) = ([0.0; 4], [0_i64; 4], [u16::MAX; 4]);
    let mut records = Vec::new();
    for (k, u) in input.iter().enumerate() {
        let at = robots.iter().scan(0, |end, (_, seconds)| {
            *end += *seconds as usize * 1000;
            Some(*end)
        });
        let plant = &plants[at.filter(|end| *end <= k).count()];
        let mut amps = [0.0; 4];
        for _ in 0..LOOKS {
            let reading = plant.step(&mut state, &mut [], &Input::Voltage(*u), 1e-3 / f64::from(LOOKS));
            amps = reading.current;
            for j in 0..4 {
                angle[j] += reading.wheel_speed[j] * 1e-3 / f64::from(LOOKS);
                let now = (angle[j] * edges_a_radian).floor() as i64;
                since[j] = if now == edges[j] { since[j].saturating_add(1) } else { 0 };
                edges[j] = now;
            }
        }
        records.push(record(k as u32, *u, amps.map(|i| i + noise.next()), edges, since));
    }
    records.chunks(1000).map(|second| sent(second.iter().copied())).collect()
}

/// The record that ends a turn, k from 0.
fn record(k: u32, volts: [f64; 4], amps: [f64; 4], edges: [i64; 4], since_edge: [u16; 4]) -> TelemetryRecord {
    let calibration = Calibration::of_board(POLE_PAIRS);
    let mut record = TelemetryRecord {
        sequence: k,
        time: LOOKS * (k + 1),
        state: OperatingState::Driving,
        enabled: 0b1111,
        bus: AdcCode(1354),
        edges: edges.map(|count| count as i16),
        since_edge,
        interval: [100; 4],
        voltage: volts.map(|u| u as f32),
        ..TelemetryRecord::default()
    };
    for (j, i) in amps.into_iter().enumerate() {
        // any angle will do that the codes belong to
        record.angle[j] = (k * 997 + 20_000 * j as u32) as u16;
        let turned = Rotation::of_angle((f64::from(record.angle[j]) / 65_536.0 * TAU) as f32);
        let phases = turned.inverse_park(DirectQuadrature { d: 0.0, q: q_current(i as f32) }).inverse_clarke();
        record.phases[j] = phases.map(|x| calibration.current_code(x, f32::from(ZERO)));
    }
    record
}

/// What a current sensor adds.
struct Noise(Normal<f64>, ChaCha8Rng);

impl Noise {
    fn of(sigma: f64) -> Noise {
        Noise(Normal::new(0.0, sigma).unwrap(), ChaCha8Rng::seed_from_u64(7))
    }

    fn next(&mut self) -> f64 {
        self.0.sample(&mut self.1)
    }
}
