//! Robots that are stepped one by one: whatever effects they have.

use std::sync::Arc;

use model_core::effects::telegram::Telegram;
use model_core::effects::{Effect, EffectSet};
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::plant::{Input, Plant, Reading, State};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::reset::Reset;
use crate::log::RobotFile;
use crate::simulate::{LOSSES, Model};

/// Plant steps in a call from which on it is worth to wake other threads.
const WORTH_THREADS: usize = 256;

type Memory = <Effect<f64> as EffectSet<f64>>::State;

/// The robots.
#[derive(Clone, Debug)]
pub(super) struct Alone<const N: usize>(Vec<One<N>>);

#[derive(Clone, Debug)]
struct One<const N: usize> {
    plant: Arc<Plant<N, f64>>,
    state: State<N, f64>,
    memory: Vec<Memory>,
    losses: ChaCha8Rng,
    reading: Reading<N, f64>,
}

impl<const N: usize> Alone<N> {
    pub fn of(robots: &[&RobotFile], supply: f64) -> Self {
        let mut all: Vec<One<N>> = Vec::with_capacity(robots.len());
        for (k, robot) in robots.iter().enumerate() {
            let same = all.last().filter(|_| std::ptr::eq(robots[k - 1], *robot)).map(|one| one.plant.clone());
            let plant = same.unwrap_or_else(|| Arc::new(Model::<N>::nominal(robot, supply).plant()));
            all.push(One::begun(plant, k, &Reset::default()));
        }
        Self(all)
    }

    pub fn reset(&mut self, to: &Reset<'_>) {
        for (k, one) in self.0.iter_mut().enumerate() {
            *one = One::begun(one.plant.clone(), k, to);
        }
    }

    pub fn step(&mut self, voltage: &[f64], dt: f64, steps: usize) {
        let rows = voltage.as_chunks::<N>().0;
        match self.0.len() * steps < WORTH_THREADS {
            true => self.0.iter_mut().zip(rows).for_each(|(one, volts)| one.step(volts, dt, steps)),
            false => self.0.par_iter_mut().zip(rows).for_each(|(one, volts)| one.step(volts, dt, steps)),
        }
    }

    pub fn states(&self) -> impl Iterator<Item = [f64; 6]> {
        self.0.iter().map(|one| {
            let ([v, vn, w], pose) = (one.state.twist.to_array(), one.state.pose);
            [pose.x, pose.y, pose.theta, v, vn, w]
        })
    }

    pub fn readings(&self) -> impl Iterator<Item = Reading<N, f64>> {
        self.0.iter().map(|one| one.reading)
    }
}

impl<const N: usize> One<N> {
    /// Robot `k` where it is to begin.
    fn begun(plant: Arc<Plant<N, f64>>, k: usize, to: &Reset<'_>) -> Self {
        let [x, y, theta, v, vn, w] = to.states.get(k).copied().unwrap_or_default();
        let state = plant.start(0.0, Pose { x, y, theta }, BodyTwist { v, vn, w });
        let memory = plant.memory().collect();
        let losses = ChaCha8Rng::seed_from_u64(to.seed.wrapping_add(k as u64) ^ LOSSES);
        let reading = Reading { current: [0.0; N], wheel_speed: [0.0; N], pose: Pose::default(), gyro: 0.0 };
        Self { plant, state, memory, losses, reading }
    }

    fn step(&mut self, volts: &[f64; N], dt: f64, steps: usize) {
        let Self { plant, state, memory, losses, reading } = self;
        let arrived = plant.receive(memory, &Input::Voltage(*volts), Some(&Telegram::drawn(losses.random())));
        for k in 0..steps {
            let said = plant.step(state, memory, &arrived, dt);
            if k == 0 {
                *reading = said;
            }
        }
    }
}
