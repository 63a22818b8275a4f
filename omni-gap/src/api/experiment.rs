//! Experiment: what to play so that a robot's numbers can be told, and a rehearsal of it.

use crate::log::{RobotFile, Run};
use crate::simulate::{
    Allowed, Experiment, Floor, Lowered, Plan, RichAllowed, RichPlan, Sensing, allowed, rich_allowed,
};
use crate::simulate_experiments::{simulate_rich, simulate_some_experiments};

/// A script, and where it takes the robot.
#[derive(Clone, Debug)]
pub struct PlannedScript {
    /// Its name, which tells its experiment.
    pub name: String,
    /// The experiment.
    pub experiment: Experiment,
    /// The voltages, as a run without measurements.
    pub run: Run,
    /// How long it takes [s]
    pub seconds: f64,
    /// The floor that it needs.
    pub floor: Floor,
}

/// What to play on a robot.
#[derive(Clone, Debug)]
pub struct PlannedExperiments {
    /// The plan, with the voltage that it came to.
    pub plan: Plan,
    /// The scripts, in the order in which they are played.
    pub scripts: Vec<PlannedScript>,
    /// The limits of the robot file that made the voltage less than was asked.
    pub lowered: Vec<Lowered>,
    /// Axes that half of the voltage does not move, by the numbers of the file: with one of them no script is of use.
    pub held: Vec<&'static str>,
}

/// The scripts of these experiments, within the limits of the robot file.
pub fn experiments(robot: &RobotFile, plan: &Plan, wanted: &[Experiment]) -> PlannedExperiments {
    match robot.wheel.len() {
        3 => planned::<3>(robot, plan, wanted),
        _ => planned::<4>(robot, plan, wanted),
    }
}

fn planned<const N: usize>(robot: &RobotFile, plan: &Plan, wanted: &[Experiment]) -> PlannedExperiments {
    let Allowed { scripts, floors, plan, lowered, held } =
        allowed::<N>(robot, plan, |script| Experiment::of(&script.name).is_some_and(|e| wanted.contains(&e)));
    let told = scripts.iter().zip(floors).filter_map(|(script, floor)| {
        Some(PlannedScript {
            name: script.name.clone(),
            experiment: Experiment::of(&script.name)?,
            run: script.to_run(),
            seconds: script.t.len() as f64 / plan.rate,
            floor,
        })
    });
    PlannedExperiments { scripts: told.collect(), plan, lowered, held }
}

/// Plays the experiments of a plan on a robot that is just what its file says, measured so; the same seed gives the same
/// runs.
pub fn rehearse(robot: &RobotFile, plan: &Plan, wanted: &[Experiment], sensing: Sensing, seed: u64) -> Vec<Run> {
    let how = sensing.recording();
    let truth = RobotFile { sensors: how.sensors, ..robot.clone() };
    simulate_some_experiments(&truth, plan, wanted, &how, seed)
}

/// A script of a rich excitation, and where it takes the robot.
#[derive(Clone, Debug)]
pub struct RichScript {
    /// The voltages, as a run without measurements that has the script's name.
    pub run: Run,
    /// How long it takes [s]
    pub seconds: f64,
    /// The floor that it needs.
    pub floor: Floor,
}

/// A rich excitation of a robot.
#[derive(Clone, Debug)]
pub struct PlannedRich {
    /// The plan, with the voltage that it came to.
    pub plan: RichPlan,
    /// The scripts.
    pub scripts: Vec<RichScript>,
    /// The limits of the robot file that made the voltage less than was asked.
    pub lowered: Vec<Lowered>,
    /// Axes that half of the voltage does not move, by the numbers of the file: with one of them no script is of use.
    pub held: Vec<&'static str>,
}

/// Scripts whose recordings show as many causes as they can, within the limits of the robot file: all axes at once, with
/// reversals, rests, creeping and hard acceleration.
pub fn rich(robot: &RobotFile, plan: &RichPlan) -> PlannedRich {
    match robot.wheel.len() {
        3 => planned_rich::<3>(robot, plan),
        _ => planned_rich::<4>(robot, plan),
    }
}

fn planned_rich<const N: usize>(robot: &RobotFile, plan: &RichPlan) -> PlannedRich {
    let RichAllowed { scripts, floors, plan, lowered, held } = rich_allowed::<N>(robot, plan);
    let told = scripts.iter().zip(floors).map(|(script, floor)| RichScript {
        run: script.to_run(),
        seconds: script.t.len() as f64 / plan.rate,
        floor,
    });
    PlannedRich { scripts: told.collect(), plan, lowered, held }
}

/// Plays a rich excitation on a robot that is just what its file says, measured so; the same seed gives the same runs.
pub fn rehearse_rich(robot: &RobotFile, plan: &RichPlan, sensing: Sensing, seed: u64) -> Vec<Run> {
    let how = sensing.recording();
    let truth = RobotFile { sensors: how.sensors, ..robot.clone() };
    simulate_rich(&truth, plan, &how, seed)
}
