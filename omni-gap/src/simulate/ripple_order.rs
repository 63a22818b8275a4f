//! How often an effect comes in a turn of a wheel: the line in the spectrum of its change over the wheel's angle, at constant
//! speed.

use super::channels::Channels;
use super::restarted::RowBeside;

/// The highest order that is looked for, in periods a turn.
const HIGHEST: usize = 500;
/// A change that varies by a smaller share of its mean square is steady.
const STEADY: f64 = 1e-4;
/// A line has this share of all that varies.
const A_LINE: f64 = 0.5;

/// Periods in a turn of the wheel, of rows of a length [s] of which the last before each restart counts; `None` where the
/// change is steady, or goes by anything else than the wheel's angle.
pub(super) fn ripple_order<const N: usize>(
    rows: &[RowBeside<N>],
    wheel: usize,
    (dt, restarted): (f64, usize),
) -> Option<u32> {
    let channels = Channels { wheels: N };
    let rows: Vec<_> = rows.iter().skip(restarted - 1).step_by(restarted).collect();
    let turns = rows.iter().scan(0.0, |angle, row| {
        *angle += row.model.wheel_speed[wheel] * dt * restarted as f64;
        Some(*angle)
    });
    let turns: Vec<f64> = turns.collect();
    // Hann: what is not a whole number of turns long then tells little
    let window: Vec<f64> =
        (0..rows.len()).map(|r| (std::f64::consts::PI * r as f64 / rows.len() as f64).sin().powi(2)).collect();
    let weight: f64 = window.iter().sum();
    let of = |channel: usize| {
        let change: Vec<f64> = rows.iter().map(|row| row.change[channel]).collect();
        let mean = change.iter().zip(&window).map(|(x, w)| x * w).sum::<f64>() / weight;
        let around: Vec<f64> = change.iter().map(|x| x - mean).collect();
        let varies = around.iter().zip(&window).map(|(x, w)| x * x * w).sum::<f64>() / weight;
        (around, varies, mean * mean + varies)
    };
    let seen = [channels.current(wheel), channels.wheel_speed(wheel)].map(of);
    let [current, speed] = &seen;
    let (around, varies, all) = if current.1 > speed.1 { current } else { speed };
    if *varies <= STEADY * all {
        return None;
    }
    let mut spectrum = vec![[0.0; 2]; HIGHEST];
    for ((x, w), angle) in around.iter().zip(&window).zip(&turns) {
        let (sin, cos) = angle.sin_cos();
        let (mut re, mut im) = (x * w, 0.0);
        for line in &mut spectrum {
            (re, im) = (re * cos - im * sin, re * sin + im * cos);
            line[0] += re;
            line[1] += im;
        }
    }
    // a line a·cos has a sum of ½·a·weight, and varies by ½·a²
    let share = |line: &[f64; 2]| 2.0 * (line[0].powi(2) + line[1].powi(2)) / (weight * weight) / varies;
    let (order, most) = spectrum.iter().map(share).enumerate().fold((0, 0.0), |a, b| if b.1 > a.1 { b } else { a });
    (most > A_LINE).then_some(order as u32 + 1)
}
