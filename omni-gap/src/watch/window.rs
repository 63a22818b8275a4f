//! A window of a run, laid out for the plant by the clock of the whole watch.

use std::ops::Range;

use crate::log::{Channel, RobotFile, Run};
use crate::simulate::AlignedRun;

/// What is needed before a window: the smoother of a restart looks so far back [s]
pub const BEFORE_S: f64 = 0.4;

/// What is needed after a window: the smoother, and the next edge of a slow wheel [s]
pub const AFTER_S: f64 = 0.1;

/// What is due in time by rounding alone [s]
const ROUNDED_S: f64 = 1e-9;

/// A window and what lies around it.
#[derive(Clone, Debug)]
pub struct Window<const N: usize> {
    /// All of it; times are those since the watch began.
    pub run: AlignedRun<N>,
    /// The rows of the window.
    pub rows: Range<usize>,
    /// The rows on which free runs restart.
    pub restarts: Vec<usize>,
}

impl<const N: usize> Window<N> {
    /// The window between two times [s], restarted every `horizon` [s]; `turned` is by how much the wheels have turned before
    /// it [rad]. None where nothing drives a model.
    pub fn laid(
        run: &Run,
        robot: &RobotFile,
        between: Range<f64>,
        horizon: f64,
        turned: Option<[f64; N]>,
    ) -> Option<Self> {
        let around = rows(run, between.start - BEFORE_S..between.end + AFTER_S);
        let part = run.part(around);
        let mut laid = AlignedRun::<N>::new(&part, robot)?;
        let began_s = part.t_s.get(part.driven_span().start)?;
        laid.t.iter_mut().for_each(|t| *t += began_s);
        let at = |time: f64| laid.t.partition_point(|t| *t < time - ROUNDED_S);
        let rows = at(between.start)..at(between.end);
        if let Some((turned, here)) = turned.zip(laid.turned(rows.start)) {
            let by: [f64; N] = std::array::from_fn(|j| turned[j] - here[j]);
            laid.turned.iter_mut().for_each(|angles| (0..N).for_each(|j| angles[j] += by[j]));
        }
        let (mut restarts, mut next) = (Vec::new(), between.start);
        for row in rows.clone().filter(|row| laid.driven[*row]) {
            if laid.t[row] >= next - ROUNDED_S {
                restarts.push(row);
                next = between.start + horizon * (((laid.t[row] - between.start + ROUNDED_S) / horizon).floor() + 1.0);
            }
        }
        (!restarts.is_empty()).then_some(Self { run: laid, rows, restarts })
    }
}

/// The rows of a run between two times [s].
pub fn rows(run: &Run, between: Range<f64>) -> Range<usize> {
    let at = |time: f64| run.t_s.partition_point(|t| *t < time - ROUNDED_S);
    at(between.start)..at(between.end)
}

/// Those of some rows on which nothing at all is there: their records got lost.
pub fn lost(run: &Run, rows: Range<usize>) -> usize {
    let signals = run.signals();
    rows.filter(|row| signals.iter().all(|(_, channel)| channel.get(*row).is_err())).count()
}

/// Rows of channels held: what was not measured on a row is as it was before, at first as it will be; none where one was
/// never measured.
pub fn held<const N: usize>(window: &AlignedRun<N>, channels: Range<usize>) -> Option<Vec<[f64; N]>> {
    let mut held = vec![[0.0; N]; window.rows()];
    for (j, c) in channels.enumerate() {
        let mut last = (0..window.rows()).find(|row| window.saw(*row, c)).map(|row| window.measured[row][c])?;
        for (row, held) in held.iter_mut().enumerate() {
            if window.saw(row, c) {
                last = window.measured[row][c];
            }
            held[j] = last;
        }
    }
    Some(held)
}

/// The mean of a channel's samples on some rows.
pub fn mean(channel: &Channel, rows: Range<usize>) -> Option<f64> {
    let there: Vec<f64> = rows.filter_map(|row| channel.get(row).ok()).collect();
    (!there.is_empty()).then(|| there.iter().sum::<f64>() / there.len() as f64)
}
