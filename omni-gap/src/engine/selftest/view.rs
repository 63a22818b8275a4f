//! Recordings by some of their channels alone.

use nalgebra::DMatrix;

use crate::identify::{SeenWindow, WindowLinear};
use crate::simulate::MAX_CHANNELS;

/// What is seen of every run, and what the numbers of the robot move of it.
pub(in crate::engine) struct View {
    /// The windows of each run.
    pub runs: Vec<Vec<SeenWindow>>,
    /// What the numbers move in them.
    pub seen: Seen,
}

/// What the numbers of the robot move of what is seen: the products of their derivatives, starts eliminated, and how many
/// numbers are measured, channel by channel.
#[derive(Clone)]
pub(in crate::engine) struct Seen {
    pub channels: [(DMatrix<f64>, usize); MAX_CHANNELS],
}

impl View {
    /// By the channels of a bit mask; of runs that are linearised by so many numbers of the robot.
    pub fn new<'a>(runs: impl Iterator<Item = &'a [WindowLinear]>, mask: u16, numbers: usize) -> Self {
        let seen = |windows: &[WindowLinear]| windows.iter().map(|window| SeenWindow::new(window, mask)).collect();
        let runs: Vec<Vec<SeenWindow>> = runs.map(seen).collect();
        let seen = runs.iter().flatten().fold(Seen::nothing(numbers), |seen, window| seen.and(&window.by_channel()));
        Self { runs, seen }
    }
}

impl Seen {
    /// Of so many numbers of the robot, over no window yet.
    pub fn nothing(numbers: usize) -> Self {
        Self { channels: std::array::from_fn(|_| (DMatrix::zeros(numbers, numbers), 0)) }
    }

    /// With what is seen in other windows.
    #[must_use]
    pub fn and(mut self, more: &[(DMatrix<f64>, usize); MAX_CHANNELS]) -> Self {
        for (sum, (products, measured)) in self.channels.iter_mut().zip(more) {
            sum.0 += products;
            sum.1 += measured;
        }
        self
    }

    /// Of so many times as many samples like these, channel by channel.
    #[must_use]
    pub fn times(mut self, times: &[f64; MAX_CHANNELS]) -> Self {
        for ((products, measured), times) in self.channels.iter_mut().zip(times) {
            *products *= *times;
            *measured = (*measured as f64 * times).round() as usize;
        }
        self
    }

    /// How many numbers are measured.
    pub fn measured(&self) -> usize {
        self.channels.iter().map(|(_, measured)| measured).sum()
    }

    /// The products of the numbers' derivatives over all channels.
    pub fn products(&self) -> DMatrix<f64> {
        let [(first, _), others @ ..] = &self.channels;
        others.iter().fold(first.clone(), |sum, (more, _)| sum + more)
    }
}
