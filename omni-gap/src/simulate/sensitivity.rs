//! # Sensitivity: which numbers of a robot file the motion depends on
//!
//! The paper's question (section 5.4), for any robot and with the effects of its file: from rest, a step of voltage
//! drives one axis after the other. What pushes and what brakes is the axis' own equation,
//!
//! ```text
//! dv/dt = drive − brake·v − viscous·v − coulomb·sign(v)
//! ```
//!
//! and what the numbers p of the robot file do to the speed is d ln v / d ln p: per cent of speed for one per cent of
//! the number. The derivatives are those of the plant's own steps, carried along by dual numbers; the instant at which an
//! effect switches counts as fixed.

use model_core::effects::EffectState;
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::number::dual::Dual;
use model_core::number::scalar::Real;
use model_core::plant::robot::{Nominal, Robot};
use model_core::plant::{Input, Plant, State};
use nalgebra::{DMatrix, DVector};
use schemars::JsonSchema;
use serde::Serialize;

use super::keys::NOMINAL_KEYS;
use super::model::{Model, Slot};
use super::script::{AXES, along};
use super::terms::{Terms, terms};
use crate::log::RobotFile;

/// Numbers of a robot file.
const KEYS: usize = NOMINAL_KEYS.len();
/// One derivative for each factor.
type D = Dual<{ Nominal::COUNT }>;
/// (value, d ln value / d ln number for every key)
type Valued = (f64, [f64; KEYS]);

/// The voltage of a step where none is asked for [V]: the paper's.
pub const PAPER_VOLTAGE: f64 = 6.0;
/// Longest step of the plant [s]
const STEP_S: f64 = 1e-3;
/// Steps to the stated time at the least.
const FEWEST_STEPS: usize = 400;
/// Points of a curve.
const POINTS: usize = 100;
/// The end is where speed and sensitivities have stayed the same over this time [s], to this part.
const STILL: (f64, f64) = (1.0, 1e-6);
/// What has not settled after so long does not [s].
const LONGEST_S: f64 = 60.0;

/// A step of voltage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepPlan {
    /// On the motor that gets most [V]
    pub voltage: f64,
    /// When the speed is looked at [s]
    pub time: f64,
}

impl StepPlan {
    /// The paper's 6 V, or the supply where that is less, and one second.
    pub fn usual(file: &RobotFile) -> Self {
        Self { voltage: file.supply.map_or(PAPER_VOLTAGE, |s| s.voltage_v.min(PAPER_VOLTAGE)), time: 1.0 }
    }
}

/// How the motion of a robot depends on the numbers of its file.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct Sensitivity {
    /// The robot's name.
    pub robot: String,
    /// Voltage on the motor that gets most [V]
    #[serde(rename = "voltage_V")]
    pub voltage: f64,
    /// When the speed is looked at [s]
    pub time_s: f64,
    /// Ids of the effects that take part.
    pub effects: Vec<&'static str>,
    /// v, vn and ω.
    pub axes: Vec<AxisSensitivity>,
}

/// One axis.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct AxisSensitivity {
    /// `v`, `vn` or `w`.
    pub axis: &'static str,
    /// Voltage of every motor [V]
    #[serde(rename = "motors_V")]
    pub motors: Vec<f64>,
    /// The terms of the axis' equation.
    pub terms: Terms,
    /// Speed at the stated time [m/s or rad/s]
    pub speed: f64,
    /// Distance covered by then, along the axis [m or rad]
    pub distance: f64,
    /// Speed in the end [m/s or rad/s]; none where the motion does not settle
    pub final_speed: Option<f64>,
    /// Every number of the robot file, the one that the speed depends on most first; none where the axis does not move.
    pub influences: Vec<Influence>,
    /// The way there.
    #[serde(skip)]
    pub curve: Vec<CurvePoint>,
}

/// What one number of the robot file does: per cent for one per cent of the number.
#[derive(Clone, Copy, Debug, PartialEq, JsonSchema, Serialize)]
pub struct Influence {
    /// Its key.
    pub key: &'static str,
    /// The file's number (of the first wheel, for a wheel's key), in SI units.
    pub value: f64,
    /// d ln(speed at the stated time) / d ln(number) [1]
    pub speed: f64,
    /// d ln(distance) / d ln(number) [1]
    pub distance: f64,
    /// d ln(final speed) / d ln(number) [1]
    pub final_speed: Option<f64>,
}

/// One moment on the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// Time since the step [s]
    pub time: f64,
    /// Speed [m/s or rad/s]
    pub speed: f64,
    /// d ln(speed) / d ln(number) [1], in the order of [`NOMINAL_KEYS`]
    pub slopes: [f64; KEYS],
}

/// How the motion of this robot depends on the numbers of its file.
pub fn sensitivity(file: &RobotFile, plan: &StepPlan) -> Sensitivity {
    match file.wheel.len() {
        3 => of_model(file, &Model::<3>::nominal(file, plan.voltage), plan),
        _ => of_model(file, &Model::<4>::nominal(file, plan.voltage), plan),
    }
}

fn of_model<const N: usize>(file: &RobotFile, model: &Model<N>, plan: &StepPlan) -> Sensitivity {
    let plant = model.plant_with::<D>(|slot, x| match slot {
        Slot::Nominal(p) => D::variable(x, p as usize),
        Slot::Param(..) => D::constant(x),
    });
    let keys = KeySlopes::new();
    Sensitivity {
        robot: file.name.clone(),
        voltage: plan.voltage,
        time_s: plan.time,
        effects: model.effects.iter().map(|e| e.id).collect(),
        axes: (0..3).map(|axis| of_axis(file, model.robot(), &plant, &keys, axis, plan)).collect(),
    }
}

fn of_axis<const N: usize>(
    file: &RobotFile,
    robot: &Robot<N, f64>,
    plant: &Plant<N, D>,
    keys: &KeySlopes,
    axis: usize,
    plan: &StepPlan,
) -> AxisSensitivity {
    let motors = along(&robot.wheels, axis, plan.voltage);
    let mut ride = Ride::new(plant, axis, motors);
    let dt = STEP_S.min(plan.time / FEWEST_STEPS as f64);
    let steps = (plan.time / dt).round().max(1.0) as usize;
    let dt = plan.time / steps as f64;
    let mut curve = Vec::new();
    let mut shown = 0;
    for k in 1..=steps {
        ride.step(dt);
        if k * POINTS >= (shown + 1) * steps {
            shown += 1;
            let (speed, slopes) = keys.relative(ride.speed());
            curve.push(CurvePoint { time: k as f64 * dt, speed, slopes });
        }
    }
    let (speed, by_speed) = keys.relative(ride.speed());
    let (distance, by_distance) = keys.relative(ride.distance);
    let last = ride.settled(keys);
    let influence = |k: usize| Influence {
        key: NOMINAL_KEYS[k].key,
        value: NOMINAL_KEYS[k].value(file),
        speed: by_speed[k],
        distance: by_distance[k],
        final_speed: last.map(|(_, slopes)| slopes[k]),
    };
    let mut influences: Vec<Influence> = if speed == 0.0 { vec![] } else { (0..KEYS).map(influence).collect() };
    influences.sort_by(|a, b| b.speed.abs().total_cmp(&a.speed.abs()));
    AxisSensitivity {
        axis: AXES[axis],
        motors: motors.to_vec(),
        terms: terms(robot, axis, motors),
        speed,
        distance,
        final_speed: last.map(|(speed, _)| speed),
        influences,
        curve,
    }
}

/// A robot on its way after the step.
struct Ride<'a, const N: usize> {
    plant: &'a Plant<N, D>,
    axis: usize,
    input: Input<N, D>,
    state: State<N, D>,
    memory: Vec<EffectState<D>>,
    distance: D,
}

impl<'a, const N: usize> Ride<'a, N> {
    fn new(plant: &'a Plant<N, D>, axis: usize, motors: [f64; N]) -> Self {
        let zero = D::zero();
        let state = plant.start(zero, Pose::default(), BodyTwist::default());
        let mut memory = plant.memory().collect::<Vec<_>>();
        plant.restart(&state, &mut memory);
        Self { plant, axis, input: Input::Voltage(motors.map(D::constant)), state, memory, distance: zero }
    }

    fn speed(&self) -> D {
        self.state.twist.to_array()[self.axis]
    }

    fn step(&mut self, dt: f64) {
        let before = self.speed();
        self.plant.step(&mut self.state, &mut self.memory, &self.input, D::constant(dt));
        // s⁺ = s + Δt·(v + v⁺)/2
        self.distance += (before + self.speed()) * D::constant(0.5 * dt);
    }

    /// Goes on until nothing changes any more.
    fn settled(&mut self, keys: &KeySlopes) -> Option<Valued> {
        let (still, part) = STILL;
        let mut before = keys.relative(self.speed());
        for _ in 0..(LONGEST_S / still) as usize {
            for _ in 0..(still / STEP_S) as usize {
                self.step(STEP_S);
            }
            let now = keys.relative(self.speed());
            if now.0 == 0.0 {
                return None;
            }
            let change = (now.0 - before.0).abs() / now.0.abs();
            if now.1.iter().zip(&before.1).fold(change, |most, (a, b)| most.max((a - b).abs())) < part {
                return Some(now);
            }
            before = now;
        }
        None
    }
}

/// From the factors of a model to the numbers of a file.
///
/// A number is a product of factors, n_k = Π f, so that `d ln q/d ln f = Σ_k (f in n_k)·d ln q/d ln n_k`; solved for the
/// latter.
struct KeySlopes(DMatrix<f64>);

impl KeySlopes {
    fn new() -> Self {
        let holds = |factor: usize, key: usize| NOMINAL_KEYS[key].factors.contains(&Nominal::ALL[factor]);
        let matrix = DMatrix::from_fn(Nominal::COUNT, KEYS, |f, k| f64::from(u8::from(holds(f, k))));
        Self(matrix.try_inverse().expect("the file's numbers and the factors say the same"))
    }

    /// A value and d ln(value) / d ln(number); factors are one, so d ln f = df. A value of zero has none.
    fn relative(&self, x: D) -> Valued {
        if x.re == 0.0 {
            return (0.0, [0.0; KEYS]);
        }
        let slopes = &self.0 * DVector::from_fn(Nominal::COUNT, |f, _| x.eps[f] / x.re);
        (x.re, std::array::from_fn(|k| slopes[k]))
    }
}
