//! By how much a model and a window are apart: per group driven by the command alone, per stage driven by its own measured
//! input.

use model_core::plant::{Input, Plant};

use super::window::{Window, held};
use crate::localise::{FLOOR_SEED, Link, replay};
use crate::simulate::{AlignedRun, FreeRun, Hidden, PerGroup, Row, SignalGroup};

/// The errors of a window, RMS in units of sigma; none of what was not measured.
#[derive(Clone, Copy, Debug, Default)]
pub struct Errors {
    /// Of each group.
    pub groups: PerGroup<Option<f64>>,
    /// Of each stage, in signal order.
    pub stages: [Option<f64>; 3],
}

/// A model on its way through the windows.
#[derive(Clone, Debug)]
pub struct Model<const N: usize> {
    plant: Plant<N, f64>,
    hidden: Option<Hidden<N>>,
}

impl<const N: usize> Model<N> {
    /// A model that starts cold.
    pub fn new(plant: Plant<N, f64>) -> Self {
        Self { plant, hidden: None }
    }

    /// The errors of a window.
    pub fn errors(&self, window: &Window<N>) -> Errors {
        self.errors_of(window, &window.run)
    }

    /// The errors that it would have, were the model the truth; another `draw` has other noise.
    pub fn simulated(&self, window: &Window<N>, draw: u64) -> Errors {
        let run = replay(self.at(&window.run), FLOOR_SEED.wrapping_add(draw));
        self.errors_of(window, &run)
    }

    /// Goes on to the end of a window.
    pub fn pass(&mut self, window: &Window<N>) {
        let mut on_the_way = self.at(&window.run);
        on_the_way.drive(window.rows.clone(), &window.restarts, |row| window.run.input(row), |_, _| {});
        let hidden = on_the_way.hidden();
        drop(on_the_way);
        self.hidden = Some(hidden);
    }

    /// A plant that begins a window.
    fn at<'a>(&'a self, run: &'a AlignedRun<N>) -> FreeRun<'a, N, f64> {
        match &self.hidden {
            Some(hidden) => FreeRun::after(hidden, &self.plant, run),
            None => FreeRun::new(&self.plant, run),
        }
    }

    fn errors_of(&self, window: &Window<N>, run: &AlignedRun<N>) -> Errors {
        let channels = AlignedRun::<N>::channels();
        let mut groups = [Sum::default(); SignalGroup::COUNT];
        let along = |restarts: &[usize], input: &dyn Fn(usize) -> Input<N, f64>, each: &mut dyn FnMut(usize, Row)| {
            let rows = window.rows.clone();
            self.at(run).drive(rows, restarts, input, |row, passed| each(row, run.row_of(passed)));
        };
        let command = |row: usize| run.input(row);
        along(&window.restarts, &command, &mut |row, says| {
            for (group, sum) in SignalGroup::ALL.into_iter().zip(&mut groups) {
                channels.of(group).for_each(|c| sum.note(run, row, c, says[c]));
            }
        });
        let group = |group: SignalGroup| groups[group as usize].rms();
        let stage = |link: Link| {
            group(link.end())?;
            let mut sum = Sum::default();
            let mut each = |row: usize, says: Row| channels.of(link.end()).for_each(|c| sum.note(run, row, c, says[c]));
            match link {
                Link::Electrical => {
                    let every: Vec<usize> = window.rows.clone().filter(|row| run.driven[*row]).collect();
                    along(&every, &command, &mut each);
                }
                Link::Motion => match held(run, channels.of(SignalGroup::Current)).filter(|_| !run.unsigned_current) {
                    Some(amps) => along(&window.restarts, &|row| Input::Current(amps[row]), &mut each),
                    None => return group(link.end()),
                },
                Link::Contact => match held(run, channels.of(SignalGroup::WheelSpeed)) {
                    Some(speeds) => along(&window.restarts, &|row| Input::Speed(middle(&speeds, row)), &mut each),
                    None => return group(link.end()),
                },
            }
            sum.rms()
        };
        Errors { groups: SignalGroup::ALL.map(group), stages: Link::ALL.map(stage) }
    }
}

/// A measured speed changes evenly from row to row: the middle.
fn middle<const N: usize>(speeds: &[[f64; N]], row: usize) -> [f64; N] {
    let next = speeds.get(row + 1).unwrap_or(&speeds[row]);
    std::array::from_fn(|j| 0.5 * (speeds[row][j] + next[j]))
}

/// A sum of squares.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    squares: f64,
    count: f64,
}

impl Sum {
    fn note<const N: usize>(&mut self, run: &AlignedRun<N>, row: usize, channel: usize, says: f64) {
        if run.saw(row, channel) {
            self.squares += run.error(row, channel, says).powi(2);
            self.count += 1.0;
        }
    }

    fn rms(&self) -> Option<f64> {
        (self.count > 0.0).then(|| (self.squares / self.count).sqrt())
    }
}
