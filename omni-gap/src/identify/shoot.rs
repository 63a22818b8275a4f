//! Shooting: one window after another, each from a start of its own.

use std::ops::Range;

use model_core::effects::EffectState;
use model_core::effects::card::Seam;
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::number::scalar::Real;
use model_core::plant::Plant;

use crate::simulate::{AlignedRun, FreeRun, HORIZON_S, MAX_CHANNELS, Model, start_at};

/// The state from which a window starts: x, y, θ, v, vn, ω [m, m, rad, m/s, m/s, rad/s].
pub type StartState = [f64; 6];

/// The starts of all windows of a run.
pub type Starts = Vec<StartState>;

/// Length of a shooting window [s]
pub const WINDOW_S: f64 = HORIZON_S;

/// The windows of a run: the rows at which each begins, and the number of rows as the last entry.
#[derive(Clone, Debug)]
pub struct Windows(Vec<usize>);

impl Windows {
    /// Windows of `horizon` [s], and one more wherever the driving signal is known again; those shorter than half of that join
    /// one beside them, but none goes on over what is not known.
    pub fn new<const N: usize>(run: &AlignedRun<N>, horizon: f64) -> Self {
        let mut rows = run.restart_rows(horizon);
        let near = |a: usize, b: usize| (run.t[a] - run.t[b]).abs() < 0.5 * horizon;
        let (first, last) = (rows.first().copied(), run.rows().saturating_sub(1));
        rows.retain(|row| {
            let by_the_grid = Some(*row) != first && run.resumes.binary_search(row).is_err();
            !(by_the_grid && (near(*row, last) || run.resumes.iter().any(|resumes| near(*row, *resumes))))
        });
        // before the first row that is compared the driving signal may not be known
        if let [first, second, ..] = rows[..]
            && (first..second).all(|row| run.has[row] == 0)
        {
            rows.remove(0);
        }
        rows.push(run.rows());
        Self(rows)
    }

    /// One window: the whole run.
    pub fn whole<const N: usize>(run: &AlignedRun<N>) -> Self {
        Self(vec![0, run.rows()])
    }

    /// How many windows.
    pub fn len(&self) -> usize {
        self.0.len() - 1
    }

    /// True if there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The rows of a window.
    pub fn rows(&self, window: usize) -> Range<usize> {
        self.0[window]..self.0[window + 1]
    }
}

/// Runs, and those of their windows with which they begin.
#[derive(Debug)]
pub struct Shortened<'a, const N: usize> {
    runs: &'a [&'a AlignedRun<N>],
    windows: Vec<Windows>,
}

impl<const N: usize> Shortened<'_, N> {
    /// What a model is compared with.
    pub fn shots(&self) -> Shots<'_, N> {
        Shots { runs: self.runs, windows: &self.windows }
    }
}

/// Runs and their windows: what a model is compared with.
#[derive(Clone, Copy, Debug)]
pub struct Shots<'a, const N: usize> {
    /// The runs.
    pub runs: &'a [&'a AlignedRun<N>],
    /// Each run's windows.
    pub windows: &'a [Windows],
}

impl<'a, const N: usize> Shots<'a, N> {
    /// The first `runs` runs alone, or more until they last `least_s` [s] together.
    pub fn beginning(&self, runs: usize, least_s: f64) -> Self {
        let lengths = self.runs.iter().map(|run| run.dt.iter().sum::<f64>());
        let before = lengths.scan(0.0, |sum, length| Some(std::mem::replace(sum, *sum + length)));
        let count = before.enumerate().take_while(|(k, sum)| *k < runs || *sum < least_s).count();
        Self { runs: &self.runs[..count], windows: &self.windows[..count] }
    }

    /// No longer than `most_s` [s] together and with no more than so many rows, each run giving the same share: whole windows
    /// from its beginning, at least one.
    pub fn shortened(&self, most_s: f64, most_rows: usize) -> Shortened<'a, N> {
        let rows: usize = self.runs.iter().map(|run| run.rows()).sum();
        let lasts_s: f64 = self.runs.iter().flat_map(|run| &run.dt).sum();
        let share = (most_s / lasts_s).min(most_rows as f64 / rows as f64).min(1.0);
        let windows = self.windows.iter().zip(self.runs).map(|(windows, run)| {
            let most = (share * run.rows() as f64) as usize;
            let whole = windows.0.iter().skip(1).take_while(|end| **end <= most).count();
            Windows(windows.0[..=whole.max(1)].to_vec())
        });
        Shortened { runs: self.runs, windows: windows.collect() }
    }

    /// The pieces that a model can be taken along side by side, run by run. Effects carry on from one window to the
    /// next (memory, wheel angles, currents), so that a model with effects takes each run as one piece.
    pub(super) fn pieces(&self, model: &Model<N>) -> Vec<Piece> {
        let most = if model.effects.is_empty() { WINDOWS_A_PIECE } else { usize::MAX };
        let mut pieces = Vec::new();
        for (run, windows) in self.windows.iter().enumerate() {
            let mut first = 0;
            while first < windows.len() {
                let end = windows.len().min(first.saturating_add(most));
                pieces.push(Piece { run, windows: first..end });
                first = end;
            }
        }
        pieces
    }
}

/// Windows of one piece of work, at the most.
const WINDOWS_A_PIECE: usize = 3;

/// Windows of one run that follow each other.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// Their run.
    pub run: usize,
    /// Which of its windows.
    pub windows: Range<usize>,
}

/// Starts from the smoothed measurements, through the inverse of the plant's sensing effects. Where wheels may slip, the plant
/// is taken from each start to the next: how fast a robot is that stands behind its wheels' speeds depends on their slip.
pub fn first_starts<const N: usize>(plant: &Plant<N, f64>, run: &AlignedRun<N>, windows: &Windows) -> Starts {
    let mut on_the_way = FreeRun::new(plant, run);
    let may_slip = !plant.effects().none_at(Seam::Contact);
    (0..windows.len())
        .map(|k| {
            let rows = windows.rows(k);
            let state = start_at(run, rows.start).state(plant, on_the_way.state());
            on_the_way.restart(rows.start, state);
            if may_slip {
                for row in rows {
                    on_the_way.pass(row, &run.input(row));
                }
            }
            let (p, x) = (state.pose, state.twist);
            [p.x, p.y, p.theta, x.v, x.vn, x.w]
        })
        .collect()
}

/// Runs the plant through all windows of a run and hands every row's predicted channels to `each(window, row, channels)`.
///
/// `start` makes the window's start in the plant's number type; `enter` may change the memory at a window's beginning.
pub fn run_windows<const N: usize, T: Real>(
    plant: &Plant<N, T>,
    run: &AlignedRun<N>,
    windows: &Windows,
    start: impl Fn(usize) -> (Pose<T>, BodyTwist<T>),
    enter: impl Fn(&mut [EffectState<T>]),
    each: impl FnMut(usize, usize, &[T; MAX_CHANNELS]),
) {
    run_some_windows(FreeRun::new(plant, run), windows, 0..windows.len(), start, enter, each);
}

/// The same for some windows of a run; `on_the_way` has not begun, so that the first begins with no memory.
///
/// `start` makes the window's start in the plant's number type; `enter` may change the memory at a window's beginning.
pub(super) fn run_some_windows<const N: usize, T: Real>(
    mut on_the_way: FreeRun<'_, N, T>,
    windows: &Windows,
    which: Range<usize>,
    start: impl Fn(usize) -> (Pose<T>, BodyTwist<T>),
    enter: impl Fn(&mut [EffectState<T>]),
    mut each: impl FnMut(usize, usize, &[T; MAX_CHANNELS]),
) {
    let run = on_the_way.run();
    for window in which {
        let rows = windows.rows(window);
        let (pose, twist) = start(window);
        on_the_way.restart_with(rows.start, pose, twist, &enter);
        for row in rows {
            let passed = on_the_way.pass(row, &run.input(row));
            each(window, row, &run.row_of(&passed));
        }
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use model_core::effects::EffectKind;

    use super::super::staged::{Staging, robot, staged};
    use super::*;
    use crate::log::{Catalogue, Channel, Group, RobotFile, Run};
    use crate::simulate::EffectInstance;

    /// A run of three wheels at a hundred rows a second.
    fn lasting(seconds: f64) -> AlignedRun<3> {
        let text = include_str!("../../robots/feup-3w/robot.toml");
        let robot = RobotFile::parse(text, Path::new("robot.toml"), &Catalogue::default()).unwrap();
        let rows = (100.0 * seconds) as usize;
        let still = || Group::new((0..3).map(|_| Channel::from_values((0..rows).map(|_| 0.0))).collect());
        let t_s = (0..rows).map(|row| row as f64 / 100.0).collect();
        AlignedRun::new(&Run { t_s, u: Some(still()), i: Some(still()), ..Run::default() }, &robot).unwrap()
    }

    #[test]
    fn a_beginning_has_more_runs_the_shorter_they_are() {
        for (seconds, count) in [(6.0, 4), (3.0, 4), (1.5, 8), (1.0, 12), (0.2, 40)] {
            let runs: Vec<AlignedRun<3>> = (0..40).map(|_| lasting(seconds)).collect();
            let windows: Vec<Windows> = runs.iter().map(|run| Windows::new(run, WINDOW_S)).collect();
            let runs: Vec<&AlignedRun<3>> = runs.iter().collect();
            let few = Shots { runs: &runs, windows: &windows }.beginning(4, 11.9);
            assert_eq!((few.runs.len(), few.windows.len()), (count, count), "runs of {seconds} s");
        }
    }

    #[test]
    fn long_runs_are_shortened_by_their_length_and_by_their_rows() {
        let runs: Vec<AlignedRun<3>> = (0..4).map(|_| lasting(50.0)).collect();
        let windows: Vec<Windows> = runs.iter().map(|run| Windows::new(run, WINDOW_S)).collect();
        let runs: Vec<&AlignedRun<3>> = runs.iter().collect();
        let all = Shots { runs: &runs, windows: &windows };
        let seconds = |most_s, most_rows| -> Vec<usize> {
            all.shortened(most_s, most_rows).windows.iter().map(|few| few.rows(few.len() - 1).end / 100).collect()
        };
        assert_eq!(seconds(80.0, 20_000), [20; 4]);
        assert_eq!(seconds(1e3, 4_000), [10; 4]);
        assert_eq!(seconds(1e3, 1_000_000), [50; 4]);
        // at least a window of each
        assert_eq!(all.shortened(0.1, 20_000).windows.iter().map(Windows::len).collect::<Vec<_>>(), [1; 4]);
    }

    #[test]
    fn a_robot_whose_wheels_spin_starts_as_slow_as_it_is() {
        let mut model = Model::<4>::nominal(&robot(), 12.0);
        model.add_effect(EffectInstance::typical(EffectKind::WheelSlip.card(), None));
        let quiet = Staging { runs: 1, scale: [0.0; MAX_CHANNELS], ..Staging::default() };
        let (plant, run) = (model.plant(), &staged(&model, &quiet)[0]);
        let windows = Windows::new(run, WINDOW_S);
        let mut truth = FreeRun::new(&plant, run);
        // Σ (m/s)² that the starts, and the speeds of the wheels, are off the robot's velocity
        let (mut starts_off, mut wheels_off) = (0.0, 0.0);
        let off = |v: f64, vn: f64, is: BodyTwist<f64>| (v - is.v).powi(2) + (vn - is.vn).powi(2);
        let starts = first_starts(&plant, run, &windows);
        let mut coming = starts.iter().enumerate().map(|(k, start)| (windows.rows(k).start, start)).peekable();
        for row in 0..run.rows() {
            if let Some((_, [.., v, vn, _])) = coming.next_if(|(start, _)| *start == row) {
                let is = *truth.state();
                let rolling = plant.twist_of_wheel_speeds(is.wheel_speed);
                starts_off += off(*v, *vn, is.twist);
                wheels_off += off(rolling.v, rolling.vn, is.twist);
            }
            truth.pass(row, &run.input(row));
        }
        assert!(wheels_off > 1.0 && starts_off < 0.1 * wheels_off, "{starts_off} {wheels_off}");
    }
}
