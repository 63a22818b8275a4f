//! The free run: a plant taken along a recording, row by row, driven by an input alone and restarted where it is told.
//!
//! Pose and velocity restart; what is hidden (wheel angles, delay lines, currents) runs on from the start of the run.

use model_core::effects::EffectState;
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::number::scalar::Real;
use model_core::plant::{Input, Plant, State};

use super::aligned_run::AlignedRun;
use super::effort;
use super::row_passed::RowPassed;
use super::start::start_at;

/// A plant on its way along a recording.
#[derive(Debug)]
pub struct FreeRun<'a, const N: usize, T: Real> {
    plant: &'a Plant<N, T>,
    run: &'a AlignedRun<N>,
    state: State<N, T>,
    memory: Vec<EffectState<T>>,
    steps_taken: u64,
}

impl<'a, const N: usize, T: Real> FreeRun<'a, N, T> {
    /// At rest where the world begins, with nothing remembered.
    pub fn new(plant: &'a Plant<N, T>, run: &'a AlignedRun<N>) -> Self {
        let state = plant.start(T::zero(), Pose::default(), BodyTwist::default());
        Self { plant, run, state, memory: plant.memory().collect(), steps_taken: 0 }
    }

    /// What it goes along.
    pub fn run(&self) -> &'a AlignedRun<N> {
        self.run
    }

    /// Where it is.
    pub fn state(&self) -> &State<N, T> {
        &self.state
    }

    /// Goes on from another state.
    #[inline]
    pub fn restart(&mut self, state: State<N, T>) {
        self.state = state;
        self.plant.restart(&self.state, &mut self.memory);
    }

    /// Goes on with another pose and velocity at the beginning of a row; what is hidden stays, but for what `enter` does
    /// to the memory.
    #[inline]
    pub fn restart_with(
        &mut self,
        row: usize,
        pose: Pose<T>,
        twist: BodyTwist<T>,
        enter: impl Fn(&mut [EffectState<T>]),
    ) {
        let state = self.plant.start_from(&self.state, T::lit(self.run.t[row]), pose, twist);
        enter(&mut self.memory);
        self.restart(state);
    }

    /// Takes the plant through a row with the input held.
    #[inline]
    pub fn pass(&mut self, row: usize, input: &Input<N, T>) -> RowPassed<N, T> {
        let steps = self.run.steps(row);
        self.steps_taken += steps as u64;
        let dt = T::lit(self.run.dt[row] / steps as f64);
        let unloaded = self.plant.open_circuit_voltage(&self.state, &self.memory);
        let reading = self.plant.step(&mut self.state, &mut self.memory, input, dt);
        let bus = self.state.bus;
        for _ in 1..steps {
            self.plant.step(&mut self.state, &mut self.memory, input, dt);
        }
        RowPassed { reading, bus, load_drop: bus - unloaded }
    }
}

impl<const N: usize, T: Real> Drop for FreeRun<'_, N, T> {
    /// Counts its steps, once for all of them, so that it costs nothing.
    fn drop(&mut self) {
        effort::note(self.steps_taken);
    }
}

/// Lets a plant run freely along a whole recording, restarted from the smoothed measurement at the rows `restarts`, which
/// ascend; `input` drives it, and `each` takes what it says on each row.
pub fn free_run<const N: usize>(
    plant: &Plant<N, f64>,
    run: &AlignedRun<N>,
    restarts: &[usize],
    input: impl Fn(usize) -> Input<N, f64>,
    mut each: impl FnMut(usize, &RowPassed<N, f64>),
) {
    let mut on_the_way = FreeRun::new(plant, run);
    let mut coming = restarts.iter().copied().peekable();
    for row in 0..run.rows() {
        if coming.next_if_eq(&row).is_some() {
            on_the_way.restart(start_at(run, row).state(plant, on_the_way.state()));
        }
        each(row, &on_the_way.pass(row, &input(row)));
    }
}
