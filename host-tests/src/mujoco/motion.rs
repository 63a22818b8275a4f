//! Whether the two sides are the same robot: both are driven alike from rest, and end alike.

use model_core::effects::EffectKind;
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::plant::Input;
use model_core::plant::robot::Nominal;
use omni_gap::simulate::{EffectInstance, Model, Slot, along};
use serde_json::{Value, json};

use super::worker::{Worker, array, numbers};
use crate::plant_cases::{STEP_S, command, model};

/// Steps of a motion: one second.
const STEPS: usize = 1000;

/// How a motion ends apart, on the two sides.
#[derive(Clone, Debug)]
pub struct Apart {
    /// Which motion.
    pub name: &'static str,
    /// Between the two places [m]
    pub place: f64,
    /// Between the two headings [rad]
    pub heading: f64,
    /// Between the two velocities [m/s]
    pub speed: f64,
    /// Between the two yaw rates [rad/s]
    pub yaw_rate: f64,
    /// How far the robot went, on this side [m, rad]
    pub went: [f64; 2],
    /// How much is allowed of each [m and rad, or m/s and rad/s]
    pub allowed: f64,
}

/// What is allowed where both sides have the same equations: the two integrators differ by a step's length.
const SAME: f64 = 2e-3;

/// What is allowed where the robot turns while it drives: MuJoCo's joints have the world's axes, and a body pushed along
/// both of two axes has dry friction on each, √2 as much in all.
const TURNING: f64 = 0.1;

/// Compares the motions.
///
/// # Errors
/// Where one ends further apart than is allowed.
pub fn compared(worker: &mut Worker) -> Result<Vec<Apart>, String> {
    let (robot, round) = (model(&[]), alike_all_round());
    let one_axis = |axis| (0..STEPS).map(|k| along(&robot.robot().wheels, axis, forth_and_back(k))).collect();
    let timed = || (0..STEPS).map(command).collect();
    let motions = [
        ("along v", &robot, one_axis(0), SAME),
        ("along vn", &robot, one_axis(1), SAME),
        ("on the spot", &robot, one_axis(2), SAME),
        ("as timed, friction alike on v and vn and never dry", &round, timed(), SAME),
        ("as timed", &robot, timed(), TURNING),
    ];
    motions.into_iter().map(|(name, robot, volts, allowed)| driven(worker, (name, robot), volts, allowed)).collect()
}

/// The robot with nothing that could tell the body's axes from the world's.
fn alike_all_round() -> Model<4> {
    let mut model = model(&[]);
    let [v, vn, _] = model.robot().friction.viscous;
    model.set(Slot::Nominal(Nominal::ViscousVn), v / vn);
    for dry in [Nominal::CoulombV, Nominal::CoulombVn, Nominal::CoulombW] {
        model.set(Slot::Nominal(dry), 0.0);
    }
    model
}

/// A start, a reversal, a slow part and an end at rest [V].
fn forth_and_back(k: usize) -> f64 {
    match k {
        0..350 => 6.0,
        350..600 => -5.0,
        600..800 => 3.0,
        _ => 0.0,
    }
}

/// Asks MuJoCo's side to drive a robot by these voltages, from rest.
pub fn drive(robot: &Model<4>, volts: &[[f64; 4]]) -> Value {
    let robot = robot.robot().scaled(&robot.factor);
    json!({"ask": "drive", "robot": numbers(&robot), "volts": volts, "step": STEP_S})
}

fn driven(
    worker: &mut Worker,
    (name, robot): (&'static str, &Model<4>),
    volts: Vec<[f64; 4]>,
    allowed: f64,
) -> Result<Apart, String> {
    let answer = worker.ask(&drive(robot, &volts))?;
    // what carries the velocity round is in MuJoCo's equations of motion, and an effect here
    let mut robot = robot.clone();
    robot.add_effect(EffectInstance::typical(EffectKind::Coriolis.card(), None));
    let plant = robot.plant();
    let mut memory: Vec<_> = plant.memory().collect();
    let mut state = plant.start(0.0, Pose::default(), BodyTwist::default());
    for u in &volts {
        plant.step(&mut state, &mut memory, &Input::Voltage(*u), STEP_S);
    }
    let [x, y, theta]: [f64; 3] = array(&answer, "pose")?;
    let [v, vn, w]: [f64; 3] = array(&answer, "twist")?;
    let (pose, twist) = (state.pose, state.twist);
    let apart = Apart {
        name,
        place: (pose.x - x).hypot(pose.y - y),
        heading: (pose.theta - theta).abs(),
        speed: (twist.v - v).hypot(twist.vn - vn),
        yaw_rate: (twist.w - w).abs(),
        went: [pose.x.hypot(pose.y), pose.theta.abs()],
        allowed,
    };
    let worst = [apart.place, apart.heading, apart.speed, apart.yaw_rate].into_iter().fold(0.0, f64::max);
    if worst <= allowed {
        return Ok(apart);
    }
    Err(format!(
        "MuJoCo's robot is another one: {name} ends {worst:.4} apart (at most {allowed} in m, rad, m/s and rad/s): {apart:?}"
    ))
}
