//! Plain robots on the same wheels, some in each register of the processor.

use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::plant::robot::Robot;
use model_core::plant::{Batch, BatchReading, BatchState, Reading};

use super::reset::Reset;
use crate::log::RobotFile;
use crate::simulate::robot_of;

/// Robots in a register.
const LANES: usize = 4;

/// The robots, by registers; the last is filled up with copies of the last robot.
#[derive(Clone, Debug)]
pub(super) struct SideBySide<const N: usize> {
    count: usize,
    registers: Vec<Register<N>>,
}

#[derive(Clone, Debug)]
struct Register<const N: usize> {
    batch: Batch<N, LANES>,
    state: BatchState<N, LANES>,
    reading: Option<BatchReading<N, LANES>>,
}

impl<const N: usize> SideBySide<N> {
    /// None where one has effects, or axes that couple, or where those of a register stand on other wheels.
    pub fn of(robots: &[&RobotFile], supply: f64) -> Option<Self> {
        if robots.iter().any(|robot| !robot.effects.is_empty()) {
            return None;
        }
        let plain: Vec<Robot<N, f64>> = robots.iter().map(|robot| robot_of(robot, supply)).collect();
        let register = |robots: &[Robot<N, f64>]| {
            let batch = Batch::new(&std::array::from_fn(|lane| robots[lane.min(robots.len() - 1)]))?;
            let state = batch.start(&Default::default(), &Default::default());
            Some(Register { batch, state, reading: None })
        };
        Some(Self { count: robots.len(), registers: plain.chunks(LANES).map(register).collect::<Option<_>>()? })
    }

    pub fn reset(&mut self, to: &Reset<'_>) {
        for (k, register) in self.registers.iter_mut().enumerate() {
            let of = |lane: usize| to.states.get(k * LANES + lane).copied().unwrap_or_default();
            let pose = |[x, y, theta, ..]: [f64; 6]| Pose { x, y, theta };
            let twist = |[_, _, _, v, vn, w]: [f64; 6]| BodyTwist { v, vn, w };
            let (poses, twists) =
                (std::array::from_fn(|lane| pose(of(lane))), std::array::from_fn(|lane| twist(of(lane))));
            register.state = register.batch.start(&poses, &twists);
            register.reading = None;
        }
    }

    pub fn step(&mut self, voltage: &[f64], dt: f64, steps: usize) {
        let rows = voltage.as_chunks::<N>().0;
        for (register, rows) in self.registers.iter_mut().zip(rows.chunks(LANES)) {
            let volts = std::array::from_fn(|j| std::array::from_fn(|lane| rows[lane.min(rows.len() - 1)][j]));
            for k in 0..steps {
                let said = register.batch.step(&mut register.state, &volts, dt);
                if k == 0 {
                    register.reading = Some(said);
                }
            }
        }
    }

    pub fn states(&self) -> impl Iterator<Item = [f64; 6]> {
        self.by_robot(|register, lane| {
            let ([v, vn, w], pose) = (register.state.twist(lane).to_array(), register.state.pose(lane));
            [pose.x, pose.y, pose.theta, v, vn, w]
        })
    }

    pub fn readings(&self) -> impl Iterator<Item = Reading<N, f64>> {
        let nothing = Reading { current: [0.0; N], wheel_speed: [0.0; N], pose: Pose::default(), gyro: 0.0 };
        self.by_robot(move |register, lane| register.reading.as_ref().map_or(nothing, |reading| reading.of(lane)))
    }

    fn by_robot<T>(&self, told: impl Fn(&Register<N>, usize) -> T + Copy) -> impl Iterator<Item = T> {
        let all = self.registers.iter().flat_map(move |register| (0..LANES).map(move |lane| told(register, lane)));
        all.take(self.count)
    }
}
