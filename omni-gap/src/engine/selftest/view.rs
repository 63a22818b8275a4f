//! Recordings by some of their channels alone.

use nalgebra::DMatrix;

use crate::identify::{SeenWindow, WindowLinear};
use crate::simulate::MAX_CHANNELS;

/// What is seen of every run, and what the numbers of the robot move of it.
pub(super) struct View {
    /// The windows of each run.
    pub runs: Vec<Vec<SeenWindow>>,
    /// The products of the numbers' derivatives, starts eliminated, and how many numbers are measured, channel by channel.
    pub channels: [(DMatrix<f64>, usize); MAX_CHANNELS],
}

impl View {
    /// By the channels of a bit mask; of runs that are linearised by so many numbers of the robot.
    pub fn new<'a>(runs: impl Iterator<Item = &'a [WindowLinear]>, mask: u16, numbers: usize) -> Self {
        let seen = |windows: &[WindowLinear]| windows.iter().map(|window| SeenWindow::new(window, mask)).collect();
        let runs: Vec<Vec<SeenWindow>> = runs.map(seen).collect();
        let mut channels = std::array::from_fn(|_| (DMatrix::zeros(numbers, numbers), 0));
        for window in runs.iter().flatten() {
            for (sum, (products, measured)) in channels.iter_mut().zip(window.by_channel()) {
                sum.0 += products;
                sum.1 += measured;
            }
        }
        Self { runs, channels }
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
