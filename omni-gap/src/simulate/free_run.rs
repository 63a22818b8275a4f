//! The free run: a plant taken along a recording, row by row, driven by an input alone and restarted where it is told.
//!
//! Pose and velocity restart; what is hidden (delay lines, currents, heat) runs on from the start of the run. Wheel angles are
//! what the measured speeds turned the wheels by, where these are logged: what depends on them keeps its phase however long
//! a run is, and a window does not depend on how well the windows before it were met.

use std::ops::Range;

use model_core::effects::EffectState;
use model_core::effects::card::Seam;
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
    /// The longest step that its effects allow [s]
    longest_s: f64,
    steps_taken: u64,
}

/// What is hidden of a plant where a free run has come to: all that no measurement tells at a restart.
#[derive(Clone, Debug)]
pub struct Hidden<const N: usize> {
    state: State<N, f64>,
    memory: Vec<EffectState<f64>>,
}

impl<'a, const N: usize, T: Real> FreeRun<'a, N, T> {
    /// At rest where the world begins, with nothing remembered.
    pub fn new(plant: &'a Plant<N, T>, run: &'a AlignedRun<N>) -> Self {
        let state = plant.start(T::zero(), Pose::default(), BodyTwist::default());
        let longest_s = 1.0 / f64::from(plant.needs().steps_per_s);
        Self { plant, run, state, memory: plant.memory().collect(), longest_s, steps_taken: 0 }
    }

    /// What it goes along.
    pub fn run(&self) -> &'a AlignedRun<N> {
        self.run
    }

    /// Where it is.
    pub fn state(&self) -> &State<N, T> {
        &self.state
    }

    /// Goes on from another state at the beginning of a row.
    #[inline]
    pub fn restart(&mut self, row: usize, state: State<N, T>) {
        self.state = state;
        if self.plant.needs().angle
            && let Some(turned) = self.run.turned(row)
        {
            self.state.wheel_angle = turned.map(T::lit);
        }
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
        self.restart(row, state);
    }

    /// Takes the plant through a row with the input held.
    #[inline]
    pub fn pass(&mut self, row: usize, input: &Input<N, T>) -> RowPassed<N, T> {
        let steps = self.run.steps_within(row, self.longest_s);
        self.steps_taken += steps as u64;
        let dt = T::lit(self.run.dt[row] / steps as f64);
        let arrived;
        let input = if self.plant.effects().none_at(Seam::Command) {
            input
        } else {
            arrived = self.plant.receive(&mut self.memory, input, self.run.telegram(row).as_ref());
            &arrived
        };
        let unloaded = self.plant.open_circuit_voltage(&self.state, &self.memory);
        let reading = self.plant.step(&mut self.state, &mut self.memory, input, dt);
        let bus = self.state.bus;
        for _ in 1..steps {
            self.plant.step(&mut self.state, &mut self.memory, input, dt);
        }
        RowPassed { reading, bus, load_drop: bus - unloaded }
    }
}

impl<'a, const N: usize> FreeRun<'a, N, f64> {
    /// Goes on with what is hidden where another recording, of the time before, ended.
    pub fn after(before: &Hidden<N>, plant: &'a Plant<N, f64>, run: &'a AlignedRun<N>) -> Self {
        let Hidden { state, memory } = before.clone();
        let mut on_the_way = Self::new(plant, run);
        (on_the_way.state, on_the_way.memory) = (state, memory);
        on_the_way
    }

    /// What is hidden where it is.
    pub fn hidden(&self) -> Hidden<N> {
        Hidden { state: self.state, memory: self.memory.clone() }
    }

    /// Goes along these rows, restarted from the smoothed measurement at the rows `restarts`, which ascend; `input` drives it,
    /// and `each` takes what it says on each row.
    pub fn drive(
        &mut self,
        rows: Range<usize>,
        restarts: &[usize],
        input: impl Fn(usize) -> Input<N, f64>,
        mut each: impl FnMut(usize, &RowPassed<N, f64>),
    ) {
        let mut coming = restarts.iter().copied().peekable();
        for row in rows {
            if coming.next_if_eq(&row).is_some() {
                let start = start_at(self.run, row).seen_on_both_sides();
                self.restart(row, start.state(self.plant, &self.state));
            }
            each(row, &self.pass(row, &input(row)));
        }
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
    each: impl FnMut(usize, &RowPassed<N, f64>),
) {
    FreeRun::new(plant, run).drive(0..run.rows(), restarts, input, each);
}

#[cfg(test)]
mod tests {
    use model_core::effects::EffectKind;

    use super::super::model::{EffectInstance, Model};
    use super::super::record::{SensorSetup, record};
    use super::*;
    use crate::log::{Catalogue, RobotFile, Run};

    fn robot() -> RobotFile {
        let text = include_str!("../../robots/feup-4w/robot.toml");
        RobotFile::parse(text, std::path::Path::new("robot.toml"), &Catalogue::default()).unwrap()
    }

    fn model(effect: Option<EffectKind>, wheel: Option<usize>) -> Model<4> {
        let mut model = Model::nominal(&robot(), 12.0);
        if let Some(kind) = effect {
            model.add_effect(EffectInstance::typical(kind.card(), wheel));
        }
        model
    }

    /// Two seconds at 100 rows a second.
    fn recorded(model: &Model<4>) -> Run {
        let t: Vec<f64> = (0..200).map(|row| f64::from(row) / 100.0).collect();
        let input: Vec<_> = t.iter().map(|t| Input::Voltage([6.0, 3.0 * t.sin(), -6.0, 2.0])).collect();
        let setup = SensorSetup { sensors: robot().sensors, steps_a_row: 1, ..SensorSetup::default() };
        record(&model.plant(), "run", &t, &input, &setup, 1)
    }

    /// How many steps a model takes through such a row.
    fn steps_a_row(model: &Model<4>) -> u64 {
        let run = AlignedRun::new(&recorded(model), &robot()).unwrap();
        let plant = model.plant();
        let mut on_the_way = FreeRun::new(&plant, &run);
        on_the_way.pass(50, &run.input(50));
        on_the_way.steps_taken
    }

    #[test]
    fn what_swings_within_milliseconds_is_taken_in_steps_that_show_it() {
        let plain = steps_a_row(&model(None, None));
        assert!(plain < 4, "{plain}");
        assert_eq!(steps_a_row(&model(Some(EffectKind::CameraLatency), None)), plain);
        for kind in [EffectKind::ShaftElasticity, EffectKind::Backlash, EffectKind::CurrentLag] {
            let asked = u64::from(model(Some(kind), None).plant().needs().steps_per_s);
            assert_eq!(steps_a_row(&model(Some(kind), None)), asked / 100);
        }
    }

    #[test]
    fn a_finer_run_is_taken_in_so_many_times_as_many_steps() {
        for kind in [None, Some(EffectKind::Backlash)] {
            let model = model(kind, None);
            let run = AlignedRun::<4>::new(&recorded(&model), &robot()).unwrap();
            let steps = |finer: u16| {
                let plant = model.plant();
                let finer = AlignedRun { finer, ..run.clone() };
                let mut on_the_way = FreeRun::new(&plant, &finer);
                on_the_way.pass(50, &run.input(50));
                on_the_way.steps_taken
            };
            assert_eq!(steps(3), 3 * steps(1));
        }
    }

    #[test]
    fn a_window_begins_with_the_angles_that_the_measured_speeds_turned_the_wheels_by() {
        let (rippled, row) = (model(Some(EffectKind::WheelEccentricity), Some(1)), 150);
        let run = AlignedRun::<4>::new(&recorded(&rippled), &robot()).unwrap();
        let plant = rippled.plant();
        let begun_at = |run: &AlignedRun<4>, row: usize| {
            let mut on_the_way = FreeRun::new(&plant, run);
            on_the_way.restart_with(row, Pose::default(), BodyTwist::default(), |_| {});
            on_the_way.state().wheel_angle
        };
        let mut turned = [0.0; 4];
        for k in 0..row {
            for (j, turned) in turned.iter_mut().enumerate() {
                let speed = AlignedRun::<4>::channels().wheel_speed(j);
                *turned += 0.5 * (run.measured[k][speed] + run.measured[k + 1][speed]) * run.dt[k];
            }
        }
        let gap = |a: [f64; 4], b: [f64; 4]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(gap(begun_at(&run, row), turned) < 1e-9 && turned[0].abs() > 1.0);
        // a part of a run keeps the phase of the whole
        assert!(gap(begun_at(&run.part(100..run.rows()), row - 100), turned) < 1e-9);
    }

    #[test]
    fn angles_that_no_effect_asks_for_stay_untold() {
        let plain = model(None, None);
        let run = AlignedRun::<4>::new(&recorded(&plain), &robot()).unwrap();
        let plant = plain.plant();
        let mut on_the_way = FreeRun::new(&plant, &run);
        on_the_way.restart_with(150, Pose::default(), BodyTwist::default(), |_| {});
        assert!(on_the_way.state().wheel_angle.iter().all(|angle| angle.is_nan()));
    }
}
