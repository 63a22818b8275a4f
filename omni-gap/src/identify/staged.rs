//! Runs whose truth and noise are known, for the tests of this room.

use std::path::Path;

use model_core::plant::Input;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::log::{Catalogue, RobotFile};
use crate::simulate::{AlignedRun, Excitation, FreeRun, MAX_CHANNELS, Model, Row, SensorSetup, excite, record};

/// What is recorded.
#[derive(Clone, Copy)]
pub struct Staging {
    pub runs: usize,
    /// Rows a second [1/s]
    pub rate: f64,
    /// Camera frames a second [1/s]
    pub camera_rate: f64,
    /// Correlation time of each channel's noise [s]; zero is white
    pub correlation_time: Row,
    /// Standard deviation of each channel's noise, in its own sigma
    pub scale: Row,
    /// Which channels are recorded.
    pub channels: u16,
    pub seed: u64,
}

impl Default for Staging {
    fn default() -> Self {
        Self {
            runs: 6,
            rate: 250.0,
            camera_rate: 50.0,
            correlation_time: [0.0; MAX_CHANNELS],
            scale: [1.0; MAX_CHANNELS],
            channels: u16::MAX,
            seed: 7,
        }
    }
}

/// The paper's four-wheel robot.
pub fn robot() -> RobotFile {
    let text = include_str!("../../robots/feup-4w/robot.toml");
    RobotFile::parse(text, Path::new("robot.toml"), &Catalogue::default()).unwrap()
}

/// Runs of 6 s of a model, predicted in the steps that a fit takes, with noise as asked.
pub fn staged(model: &Model<4>, how: &Staging) -> Vec<AlignedRun<4>> {
    let (file, plant) = (robot(), model.plant());
    let recording = SensorSetup {
        steps_a_row: 1,
        camera_rate: how.camera_rate,
        dropouts: 0.05,
        sensors: file.sensors,
        ..SensorSetup::default()
    };
    (0..how.runs as u64)
        .map(|k| {
            let wish = Excitation { duration: 6.0, rate: how.rate, voltage: 8.0 };
            let script = excite(&model.robot().wheels, &wish, how.seed + 100 * k);
            let t: Vec<f64> = (0..script.len()).map(|row| row as f64 / how.rate).collect();
            let input: Vec<Input<4, f64>> = script.into_iter().map(Input::Voltage).collect();
            let run = record(&plant, "run", &t, &input, &recording, how.seed + 100 * k + 1);
            let mut run = AlignedRun::<4>::new(&run, &file).unwrap();
            let mut random = ChaCha8Rng::seed_from_u64(how.seed + 100 * k + 2);
            let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
            let mut noise: Row = std::array::from_fn(|_| normal());
            let blank = run.clone();
            let mut on_the_way = FreeRun::new(&plant, &blank);
            for row in 0..run.rows() {
                let mut says = run.row_of(&on_the_way.pass(row, &run.input(row)));
                for c in 0..MAX_CHANNELS {
                    // x_k = ρ·x_{k−1} + √(1 − ρ²)·n
                    let tau = how.correlation_time[c];
                    let rho = if tau > 0.0 { f64::exp(-1.0 / (how.rate * tau)) } else { 0.0 };
                    noise[c] = rho * noise[c] + (1.0 - rho * rho).sqrt() * normal();
                    says[c] += run.sigma[c] * how.scale[c] * noise[c];
                }
                run.measured[row] = says;
                run.has[row] &= how.channels;
            }
            run
        })
        .collect()
}
