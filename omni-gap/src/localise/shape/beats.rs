//! Residuals at angles of their wheels: window by window for what is slow beside a window, and row by row, less each window's line,
//! for what is fast. Rows of a window share the errors of its start, so that together they would look like a low order.

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
    /// The residuals of a wheel's current or speed, less their line over the window.
    pub fn beats(&self, quantity: Quantity, wheel: usize, speed: f64, into: &mut Vec<Beat>) {
        let Self { run, said, rows } = self;
        let channels = AlignedRun::<N>::channels();
        let channel = match quantity {
            Quantity::WheelSpeed => channels.wheel_speed(wheel),
            _ => channels.current(wheel),
        };
        if speed.abs() < TURNS || run.turned.is_empty() {
            return;
        }
        let seen: Vec<usize> = rows.clone().filter(|row| run.saw(*row, channel)).collect();
        let [Some(first), Some(last)] = [seen.first(), seen.last()] else { return };
        let span = run.t[*last] - run.t[*first];
        let each = span / (seen.len() - 1).max(1) as f64;
        let error = |row: usize, model: usize| run.error(row, channel, said[model][row][channel]) * run.sigma[channel];
        let errors: [Vec<f64>; MODELS] =
            std::array::from_fn(|model| without_line(&seen.iter().map(|row| error(*row, model)).collect::<Vec<f64>>()));
        into.extend(seen.iter().enumerate().map(|(k, row)| Beat {
            angle: run.turned[*row][wheel],
            orders: (TAU / (speed.abs() * span), PI / (speed.abs() * each)),
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

/// What windows leave of a quantity, at the angle of the wheel in their middle.
pub(super) fn of_windows(windows: &[Window], (quantity, wheel): (Quantity, usize), window_s: f64) -> Beats {
    let beats = windows.iter().filter_map(|window| {
        let at = &window.when.wheels[wheel];
        let sample = sample(window, at.angle, (quantity, wheel))?;
        let orders = (0.0, PI / (at.speed.abs() * window_s));
        (at.speed.abs() >= TURNS).then_some(Beat { angle: sample.at, orders, residual: sample.residual })
    });
    Beats { quantity, wheel, beats: beats.collect() }
}
