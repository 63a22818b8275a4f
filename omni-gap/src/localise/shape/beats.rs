//! Residuals at angles of their wheels: row by row for currents and speeds, window by window for forces.

use std::f64::consts::{PI, TAU};
use std::ops::Range;

use super::model::Quantity;
use super::order::{Beat, Beats};
use super::sampled::sample;
use super::window::{MODELS, Window};
use crate::simulate::{AlignedRun, Row};

/// A wheel that turns more slowly stays at one angle for long [rad/s]
const TURNS: f64 = 0.5;

/// Rows of a window of a run: what the models say of them, and how fast the wheels turn.
#[derive(Clone, Debug)]
pub(super) struct Rows<'a, const N: usize> {
    /// The run.
    pub run: &'a AlignedRun<N>,
    /// What each model says of every row of the run.
    pub said: [&'a [Row]; MODELS],
    /// The window.
    pub rows: Range<usize>,
}

impl<const N: usize> Rows<'_, N> {
    /// The residuals of a wheel's current, or of its speed less its line over the window.
    pub fn beats(&self, quantity: Quantity, wheel: usize, speed: f64, into: &mut Vec<Beat>) {
        let Self { run, said, rows } = self;
        let channels = AlignedRun::<N>::channels();
        let of_speed = quantity == Quantity::WheelSpeed;
        let channel = if of_speed { channels.wheel_speed(wheel) } else { channels.current(wheel) };
        if speed.abs() < TURNS || run.turned.is_empty() {
            return;
        }
        let seen: Vec<usize> = rows.clone().filter(|row| run.saw(*row, channel)).collect();
        let [Some(first), Some(last)] = [seen.first(), seen.last()] else { return };
        let span = run.t[*last] - run.t[*first];
        let each = span / (seen.len() - 1).max(1) as f64;
        let error = |row: usize, model: usize| run.error(row, channel, said[model][row][channel]) * run.sigma[channel];
        let errors: [Vec<f64>; MODELS] = std::array::from_fn(|model| {
            let errors: Vec<f64> = seen.iter().map(|row| error(*row, model)).collect();
            if of_speed { without_line(&errors) } else { errors }
        });
        let lowest = if of_speed { TAU / (speed.abs() * span) } else { 0.0 };
        into.extend(seen.iter().enumerate().map(|(k, row)| Beat {
            angle: run.turned[*row][wheel],
            orders: (lowest, PI / (speed.abs() * each)),
            residual: std::array::from_fn(|model| errors[model][k]),
        }));
    }
}

/// Values at even distances less their least-squares line.
fn without_line(values: &[f64]) -> Vec<f64> {
    let n = values.len() as f64;
    let (mean, middle) = (values.iter().sum::<f64>() / n, 0.5 * (n - 1.0));
    let (xx, xy) = values.iter().enumerate().fold((0.0, 0.0), |(xx, xy), (k, y)| {
        let x = k as f64 - middle;
        (xx + x * x, xy + x * (y - mean))
    });
    let slope = if xx > 0.0 { xy / xx } else { 0.0 };
    values.iter().enumerate().map(|(k, y)| y - mean - slope * (k as f64 - middle)).collect()
}

/// The forces that windows need, at the angle of each wheel in their middle.
pub(super) fn of_forces(windows: &[Window], wheel: usize, window_s: f64) -> Beats {
    let beats = windows.iter().filter_map(|window| {
        let at = &window.when.wheels[wheel];
        let sample = sample(window, at.angle, (Quantity::NeededForce, wheel))?;
        let orders = (0.0, PI / (at.speed.abs() * window_s));
        (at.speed.abs() >= TURNS).then_some(Beat { angle: sample.at, orders, residual: sample.residual })
    });
    Beats { quantity: Quantity::NeededForce, wheel, beats: beats.collect() }
}
