//! Self-test: what recordings of a robot could show, before anybody drives.

use model_core::plant::Input;

use crate::engine::findings::{Confusion, SelfTest};
use crate::engine::knobs::SelftestKnobs;
use crate::engine::selftest::{self as engine, Sensors};
use crate::error::Result;
use crate::log::{RobotFile, Run};
use crate::simulate::{
    AlignedRun, Excitation, Model, RunPlan, SensorSetup, SignalGroup, drivable, excite, supply_seen,
};
use crate::vocabulary::Progress;

/// Recordings that somebody means to make.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedRuns {
    /// What drives the robot.
    pub driven: Driven,
    /// What is logged.
    pub logged: Vec<SignalGroup>,
    /// Camera frames a second [1/s]
    pub camera_rate: f64,
}

/// What drives the robot.
#[derive(Clone, Debug, PartialEq)]
pub enum Driven {
    /// Random steps of all three axes at once, with rests and reversals: so many runs.
    Random {
        /// Runs.
        runs: usize,
        /// Length of each [s]
        duration: f64,
        /// Rows a second [1/s]
        rate: f64,
        /// Largest voltage on any motor [V]
        voltage: f64,
    },
    /// The inputs of runs, each on its clock.
    Scripts(Vec<Run>),
}

/// What is logged where nothing else is said.
const USUAL: [SignalGroup; 3] = [SignalGroup::Current, SignalGroup::WheelSpeed, SignalGroup::Pose];
/// Frames a second where nothing else is said [1/s]
const USUAL_CAMERA: f64 = 60.0;

impl PlannedRuns {
    /// Runs with the sensors that most robots have: currents, wheel speeds, and a camera of 60 frames a second.
    pub fn usual(driven: Driven) -> Self {
        Self { driven, logged: USUAL.to_vec(), camera_rate: USUAL_CAMERA }
    }

    /// Those of scripts: what any of them logs is logged, and as many frames a second as they have together.
    pub fn of_scripts(scripts: Vec<Run>) -> Self {
        let has = |group: &SignalGroup| {
            scripts.iter().any(|script| match group {
                SignalGroup::Current => script.i.is_some(),
                SignalGroup::WheelSpeed => script.w.is_some(),
                SignalGroup::Pose => script.pose.is_some(),
                SignalGroup::Gyro => script.gyro.is_some(),
                SignalGroup::Battery => script.vbat.is_some(),
            })
        };
        let logged = SignalGroup::ALL.into_iter().filter(has).collect();
        let frames_of = |script: &Run| script.pose.as_ref().map_or(0, |pose| pose.channels[0].present().count());
        let length_of =
            |script: &Run| script.t_s.last().zip(script.t_s.first()).map_or(0.0, |(last, first)| last - first);
        let frames: usize = scripts.iter().map(frames_of).sum();
        let duration: f64 = scripts.iter().map(length_of).sum();
        let camera_rate = if duration > 0.0 { frames as f64 / duration } else { 0.0 };
        Self { driven: Driven::Scripts(scripts), logged, camera_rate }
    }
}

/// The camera that might be had in place of the planned one, and how many times as fast it is.
const FASTER_CAMERA: (&str, f64) = ("a camera twice as fast", 2.0);
/// Seed of the excitation; a self-test is the same whenever it is asked.
const SEED: u64 = 1;

/// What recordings could show, and what a further sensor would add, a faster camera among them.
///
/// # Errors
/// Where nothing in one of the scripts can drive the model.
pub fn selftest(robot: &RobotFile, plan: &PlannedRuns, knobs: &SelftestKnobs) -> Result<SelfTest> {
    let runs = planned(robot, plan, plan.camera_rate)?;
    let mut sensors = Sensors {
        logged: plan.logged.clone(),
        might_be_added: SignalGroup::ALL.into_iter().filter(|group| !plan.logged.contains(group)).collect(),
        might_replace: Vec::new(),
    };
    if plan.logged.contains(&SignalGroup::Pose) && plan.camera_rate > 0.0 {
        let (name, times) = FASTER_CAMERA;
        sensors.might_replace.push((name, planned(robot, plan, times * plan.camera_rate)?));
    }
    Ok(engine::selftest(robot, &runs, &sensors, knobs))
}

/// Which cause of typical size would be taken for which in such recordings: the angle of each to every other. The rivals of
/// [`selftest`](fn@selftest) are those of these that are not told apart.
///
/// # Errors
/// Where nothing in a script can drive the model.
pub fn confusion(robot: &RobotFile, plan: &PlannedRuns, knobs: &SelftestKnobs) -> Result<Confusion> {
    Ok(engine::confusion(robot, &planned(robot, plan, plan.camera_rate)?, &plan.logged, knobs))
}

/// Finds for every cause of an answer of [`selftest`](fn@selftest) from what size on simulated recordings show it: robots
/// that have the cause are recorded as planned and judged by the engine itself. This takes minutes.
///
/// # Errors
/// Where nothing in a script can drive the model.
pub fn verify(
    robot: &RobotFile,
    plan: &PlannedRuns,
    said: &mut SelfTest,
    knobs: &SelftestKnobs,
    progress: Progress<'_>,
) -> Result<()> {
    let rate = plan.camera_rate;
    match robot.wheel.len() {
        3 => engine::verify(robot, &run_plans::<3>(robot, plan, rate)?, &plan.logged, said, (knobs, progress)),
        _ => engine::verify(robot, &run_plans::<4>(robot, plan, rate)?, &plan.logged, said, (knobs, progress)),
    }
    Ok(())
}

fn planned(robot: &RobotFile, plan: &PlannedRuns, camera_rate: f64) -> Result<Vec<Run>> {
    match robot.wheel.len() {
        3 => recorded::<3>(robot, plan, camera_rate),
        _ => recorded::<4>(robot, plan, camera_rate),
    }
}

/// By a robot that is just what the file says.
fn recorded<const N: usize>(robot: &RobotFile, plan: &PlannedRuns, camera_rate: f64) -> Result<Vec<Run>> {
    let (model, plans) = run_plans::<N>(robot, plan, camera_rate)?;
    let plant = model.plant();
    Ok(plans.iter().map(|plan| plan.recorded_of(&plant)).collect())
}

/// What is planned, run by run, and the model of the file.
fn run_plans<const N: usize>(
    robot: &RobotFile,
    plan: &PlannedRuns,
    camera_rate: f64,
) -> Result<(Model<N>, Vec<RunPlan<N>>)> {
    let how = SensorSetup {
        camera_rate,
        dropouts: 0.0,
        sensors: robot.sensors,
        gyro: true,
        battery: true,
        ..SensorSetup::default()
    };
    match &plan.driven {
        Driven::Random { runs, duration, rate, voltage } => {
            let model = Model::<N>::nominal(robot, *voltage);
            let wish = Excitation { duration: *duration, rate: *rate, voltage: *voltage };
            let one = |k: usize| {
                let seed = SEED + k as u64;
                let input: Vec<Input<N, f64>> =
                    excite(&model.robot().wheels, &wish, seed).into_iter().map(Input::Voltage).collect();
                let t = (0..input.len()).map(|row| row as f64 / rate).collect();
                RunPlan { name: format!("run{k:02}"), t, input, how, seed }
            };
            let plans = (0..*runs).map(one).collect();
            Ok((model, plans))
        }
        Driven::Scripts(scripts) => {
            let aligned = scripts.iter().map(|script| drivable::<N>(script, robot)).collect::<Result<Vec<_>>>()?;
            let model = Model::<N>::nominal(robot, supply_seen(&aligned));
            let one = |(k, run): (usize, &AlignedRun<N>)| {
                let rows = run.rows();
                let mean: usize = (0..rows).map(|row| usize::from(run.steps[row])).sum::<usize>().div_ceil(rows);
                let how = SensorSetup { steps_a_row: mean * how.steps_a_row, ..how };
                let input = (0..rows).map(|row| run.input(row)).collect();
                RunPlan { name: run.name.clone(), t: run.t.clone(), input, how, seed: SEED + k as u64 }
            };
            let plans = aligned.iter().enumerate().map(one).collect();
            Ok((model, plans))
        }
    }
}
