//! # Rehearse: the experiments, played by a robot that is just what its file says
//!
//! What a person gets from a morning with the real robot, from one whose truth is known: to see what the experiments can
//! tell before doing them, and to measure how good the estimators are.

use std::path::PathBuf;

use model_core::plant::Input;

use crate::log::{RobotFile, Run};
use crate::simulate::{Experiment, Model, Plan, RichPlan, Script, SensorSetup, record, rich_allowed, scripts};

/// What each further run of the motor experiment drags, as a share of the motors' torque at the largest voltage.
const LOAD: f64 = 0.2;

/// Plays the scripts of all experiments on the robot of a file, and records them.
///
/// The runs of the motor experiment drag more and more, as dry friction about ω.
pub fn simulate_experiments(truth: &RobotFile, plan: &Plan, how: &SensorSetup, seed: u64) -> Vec<Run> {
    simulate_some_experiments(truth, plan, &Experiment::ALL, how, seed)
}

/// The same with the scripts of some experiments only; a run is the same with and without the others.
pub fn simulate_some_experiments(
    truth: &RobotFile,
    plan: &Plan,
    some: &[Experiment],
    how: &SensorSetup,
    seed: u64,
) -> Vec<Run> {
    match truth.wheel.len() {
        3 => of_wheels::<3>(truth, plan, some, how, seed),
        _ => of_wheels::<4>(truth, plan, some, how, seed),
    }
}

/// Plays the rich scripts of a plan on the robot of a file, within its limits, and records them.
pub fn simulate_rich(truth: &RobotFile, plan: &RichPlan, how: &SensorSetup, seed: u64) -> Vec<Run> {
    match truth.wheel.len() {
        3 => rich_of_wheels::<3>(truth, plan, how, seed),
        _ => rich_of_wheels::<4>(truth, plan, how, seed),
    }
}

/// The torque about the vertical axis by which each further run of the motor experiment is braked more [N·m].
pub fn drag_a_load(truth: &RobotFile, plan: &Plan) -> f64 {
    LOAD * stall_torque(truth, plan.voltage)
}

fn of_wheels<const N: usize>(
    truth: &RobotFile,
    plan: &Plan,
    some: &[Experiment],
    how: &SensorSetup,
    seed: u64,
) -> Vec<Run> {
    let robot = *Model::<N>::nominal(truth, plan.voltage).robot();
    let wanted = |script: &Script<N>| Experiment::of(&script.name).is_some_and(|e| some.contains(&e));
    let played = scripts(&robot, plan).into_iter().enumerate().filter(|(_, script)| wanted(script));
    played.map(|(k, script)| play(truth, plan, &script, how, seed.wrapping_mul(1000).wrapping_add(k as u64))).collect()
}

fn rich_of_wheels<const N: usize>(truth: &RobotFile, plan: &RichPlan, how: &SensorSetup, seed: u64) -> Vec<Run> {
    let all = rich_allowed::<N>(truth, plan);
    let model = Model::<N>::nominal(truth, all.plan.voltage);
    let seed_of = |k: usize| seed.wrapping_mul(1000).wrapping_add(k as u64);
    all.scripts.iter().enumerate().map(|(k, script)| played(&model, script, how, seed_of(k))).collect()
}

fn play<const N: usize>(truth: &RobotFile, plan: &Plan, script: &Script<N>, how: &SensorSetup, seed: u64) -> Run {
    let mut dragging = truth.clone();
    let load = script.name.rsplit('-').next().and_then(|word| word.parse::<f64>().ok()).unwrap_or(0.0);
    if Experiment::of(&script.name) == Some(Experiment::Motor) {
        dragging.friction.coulomb_w_nm += load * drag_a_load(truth, plan);
    }
    played(&Model::<N>::nominal(&dragging, plan.voltage), script, how, seed)
}

fn played<const N: usize>(model: &Model<N>, script: &Script<N>, how: &SensorSetup, seed: u64) -> Run {
    let input: Vec<Input<N, f64>> = script.inputs().collect();
    let mut run = record(&model.plant(), &script.name, &script.t, &input, how, seed);
    run.path = PathBuf::from(format!("runs/{}.csv", script.name));
    run
}

/// Torque of all motors at rest about the vertical axis [N·m]: Σ d·l·K_t·u/(r·R).
fn stall_torque(file: &RobotFile, volts: f64) -> f64 {
    let motor = &file.motor;
    let kt = motor.gear_ratio * motor.torque_constant_nm_per_a / motor.resistance_ohm;
    file.wheel.iter().map(|wheel| wheel.distance_m / wheel.radius_m * kt * volts).sum()
}
