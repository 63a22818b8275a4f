//! # Scenario: a robot whose truth is known
//!
//! A robot file says what the simulator believes; the staged robot is something else: its parameters are wrong by what
//! the file states of its uncertainty, and it may have an effect that the file does not know. Recordings of it look like
//! those of a real one: noise, a slow camera that loses frames, and a plant that takes ten times finer steps than any
//! diagnosis. The demo is such a stage, and so are the tests of what the diagnosis promises.

use std::path::{Path, PathBuf};

use model_core::effects::nominal::{self, Number, Table};
use model_core::plant::{Input, Plant};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::error::Result;
use crate::log::{Catalogue, RobotFile, Run, Session, corrected};
use crate::simulate::{EffectInstance, Excitation, Model, NominalKey, SensorSetup, commanded, excite, record};

/// What is staged.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// Effects of the true robot that the robot file does not know.
    pub hidden: Vec<EffectInstance>,
    /// Parameters in which the robot file is plainly wrong: (key, true value over the file's).
    pub wrong: Vec<(&'static str, f64)>,
    /// True: every parameter is off by a draw of its stated relative uncertainty, Gaussian in its logarithm.
    pub uncertain: bool,
    /// Runs.
    pub runs: usize,
    /// Length of each [s]
    pub duration: f64,
    /// Rows a second [1/s]
    pub rate: f64,
    /// Largest voltage that the runs ask for [V]
    pub voltage: f64,
    /// Seed of everything random.
    pub seed: u64,
    /// Whether yaw rate and battery voltage are logged too.
    pub beside: bool,
    /// Whether the drives control wheel speed, and are told those at which the motors would idle at the runs' voltages.
    pub by_set_speed: bool,
}

impl Default for Scenario {
    fn default() -> Self {
        Self {
            hidden: Vec::new(),
            wrong: Vec::new(),
            uncertain: true,
            runs: 10,
            duration: 6.0,
            rate: 500.0,
            voltage: 8.0,
            seed: 1,
            beside: false,
            by_set_speed: false,
        }
    }
}

/// Makes the recordings of a staged robot. `truth` is the text of a robot file with its true parameters; the session's
/// own robot file is that text with its numbers made wrong.
///
/// # Errors
/// Where the text is not a sound robot file.
pub fn synthesize(truth: &str, plan: &Scenario, catalogue: &Catalogue) -> Result<Session> {
    let path = Path::new("robot.toml");
    let file = RobotFile::parse(truth, path, catalogue)?;
    let mut random = ChaCha8Rng::seed_from_u64(plan.seed);
    let mut changes = Vec::new();
    // friction is drawn last
    let (friction, others): (Vec<&Number>, Vec<_>) = nominal::numbers().partition(|n| n.table == Table::Friction);
    for key in others.iter().chain(&friction).map(|number| number.key) {
        let draw: f64 = StandardNormal.sample(&mut random);
        let sigma = file.relative_uncertainty(key).unwrap_or(0.0);
        let off = if plan.uncertain { (sigma * draw).exp() } else { 1.0 };
        let wrong = plan.wrong.iter().find(|(k, _)| *k == key).map_or(1.0, |(_, true_over_file)| 1.0 / true_over_file);
        if off * wrong != 1.0 {
            changes.extend(NominalKey::of(key).into_iter().flat_map(|k| k.scaled(&file, off * wrong)));
        }
    }
    let robot_text = corrected(truth, &changes)?;
    let robot = RobotFile::parse(&robot_text, path, catalogue)?;
    let runs = match file.wheel.len() {
        3 => perform::<3>(&file, plan),
        _ => perform::<4>(&file, plan),
    };
    Ok(Session { robot, robot_text, runs, heldout: Vec::new(), files: Vec::new(), notices: Vec::new() })
}

fn perform<const N: usize>(file: &RobotFile, plan: &Scenario) -> Vec<Run> {
    let mut model = Model::<N>::nominal(file, plan.voltage);
    for effect in &plan.hidden {
        model.add_effect(effect.clone());
    }
    let plant: Plant<N, f64> = model.plant();
    let how = SensorSetup { sensors: file.sensors, gyro: plan.beside, battery: plan.beside, ..SensorSetup::default() };
    (0..plan.runs)
        .map(|k| {
            let seed = plan.seed.wrapping_mul(1000).wrapping_add(k as u64);
            let wish = Excitation { duration: plan.duration, rate: plan.rate, voltage: plan.voltage };
            let script = excite(&model.robot().wheels, &wish, seed);
            let t: Vec<f64> = (0..script.len()).map(|row| row as f64 / plan.rate).collect();
            let input: Vec<Input<N, f64>> = script.into_iter().map(|u| commanded(file, plan.by_set_speed, u)).collect();
            let mut run = record(&plant, &format!("run{k:02}"), &t, &input, &how, seed ^ 0x5eed);
            run.path = PathBuf::from(format!("runs/run{k:02}.csv"));
            run
        })
        .collect()
}
