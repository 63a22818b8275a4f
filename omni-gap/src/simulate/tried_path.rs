//! A script that is written row by row beside a robot that is just what its model says, and kept within bounds by it.

use model_core::effects::EffectState;
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::plant::{Input, Plant, State};

use super::model::Model;
use super::step_lengths::LONGEST_OF_THE_QUICKEST_S;

/// What a robot is to keep to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Voltage on any motor [V]
    pub voltage: f64,
    /// Current in any motor [A]; infinity where there is no limit
    pub current: f64,
    /// Speed of the body [m/s]; infinity where there is no limit
    pub speed: f64,
    /// How far from where it starts along either axis of the world [m]
    pub out: f64,
}

/// Zero volts bring a robot to a stand within this [s].
const STOP: f64 = 0.8;
/// The longest that a stand is waited for [s]
const MOST_STOP: f64 = 3.0;
/// A robot stands below these [m/s] [rad/s]
const STANDS: (f64, f64) = (1e-3, 1e-2);

/// The rows so far, and where the robot is after them.
pub(super) struct TriedPath<const N: usize> {
    plant: Plant<N, f64>,
    bounds: Bounds,
    rate: f64,
    rows: Vec<[f64; N]>,
    /// How many there will be.
    most: usize,
    here: Here<N>,
}

/// Where the robot is.
#[derive(Clone)]
struct Here<const N: usize> {
    state: State<N, f64>,
    memory: Vec<EffectState<f64>>,
}

impl<const N: usize> TriedPath<N> {
    /// A script of so many rows.
    pub fn new(model: &Model<N>, bounds: Bounds, rate: f64, rows: usize) -> Self {
        let plant = model.plant();
        let state = plant.start(0.0, Pose::default(), BodyTwist::default());
        let here = Here { state, memory: plant.memory().collect() };
        Self { plant, bounds, rate, rows: Vec::with_capacity(rows), most: rows, here }
    }

    /// How far out it may go [m]
    pub fn out(&self) -> f64 {
        self.bounds.out
    }

    /// Whether nothing more can be put but the rest at the end.
    pub fn is_full(&self) -> bool {
        self.left() == 0
    }

    /// Where the robot would come to a stand if these voltages came next; none where it would not keep to the bounds.
    pub fn end(&self, to: [f64; N], ramp: f64, hold: f64) -> Option<[f64; 2]> {
        let mut here = self.here.clone();
        for volts in self.piece(to, ramp, hold) {
            self.go(&mut here, volts);
            self.keeps(&here).then_some(())?;
        }
        for _ in 0..self.count(STOP) {
            self.go(&mut here, [0.0; N]);
            self.keeps(&here).then_some(())?;
        }
        Some([here.state.pose.x, here.state.pose.y])
    }

    /// Puts voltages that go evenly to these and are held, as far as the current allows.
    pub fn put(&mut self, to: [f64; N], ramp: f64, hold: f64) {
        for volts in self.piece(to, ramp, hold) {
            self.put_row(volts);
        }
    }

    /// Puts zero volts until the robot stands, and then for this long [s].
    pub fn rest(&mut self, seconds: f64) {
        for _ in 0..self.count(MOST_STOP).min(self.left()) {
            let BodyTwist { v, vn, w } = self.here.state.twist;
            if v.hypot(vn) < STANDS.0 && w.abs() < STANDS.1 {
                break;
            }
            self.put_row([0.0; N]);
        }
        for _ in 0..self.count(seconds).min(self.left()) {
            self.put_row([0.0; N]);
        }
    }

    /// The rows, with rest at the end.
    pub fn done(mut self) -> Vec<[f64; N]> {
        self.rows.resize(self.most, [0.0; N]);
        self.rows
    }

    /// Rows that may still be put.
    fn left(&self) -> usize {
        self.most.saturating_sub(self.rows.len() + self.count(STOP))
    }

    fn count(&self, seconds: f64) -> usize {
        ((seconds * self.rate).round() as usize).max(1)
    }

    /// Voltages that are to come, before the current has its say.
    fn piece(&self, to: [f64; N], ramp: f64, hold: f64) -> Vec<[f64; N]> {
        let from = self.rows.last().copied().unwrap_or([0.0; N]);
        let ramp = self.count(ramp);
        let between = |k: usize| {
            let share = ((k + 1) as f64 / ramp as f64).min(1.0);
            std::array::from_fn(|j| from[j] + share * (to[j] - from[j]))
        };
        (0..(ramp + self.count(hold)).min(self.left())).map(between).collect()
    }

    fn put_row(&mut self, volts: [f64; N]) {
        let mut here = self.here.clone();
        let volts = self.go(&mut here, volts);
        self.here = here;
        self.rows.push(volts);
    }

    /// Goes on by one row, and says the voltages that it came to.
    fn go(&self, here: &mut Here<N>, wish: [f64; N]) -> [f64; N] {
        let Bounds { voltage, current, .. } = self.bounds;
        let motor = self.plant.robot().motor;
        let volts = std::array::from_fn(|j| {
            let asked = motor.current(wish[j], here.state.wheel_speed[j]);
            let less = (asked.clamp(-current, current) - asked) * motor.resistance;
            (wish[j] + less).clamp(-voltage, voltage)
        });
        let steps = (1.0 / self.rate / LONGEST_OF_THE_QUICKEST_S).ceil();
        for _ in 0..steps as usize {
            self.plant.step(&mut here.state, &mut here.memory, &Input::Voltage(volts), 1.0 / self.rate / steps);
        }
        volts
    }

    fn keeps(&self, here: &Here<N>) -> bool {
        let (State { pose, twist, .. }, Bounds { speed, out, .. }) = (&here.state, self.bounds);
        pose.x.abs().max(pose.y.abs()) <= out && twist.v.hypot(twist.vn) <= speed
    }
}
