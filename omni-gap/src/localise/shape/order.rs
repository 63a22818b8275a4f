//! The order spectrum: how often a residual comes in a turn of its wheel.
//!
//! ```text
//! r ≈ a·cos(k·θ) + b·sin(k·θ)        least squares over all samples, k = 1, 2, … (Lomb and Scargle's, over an angle)
//! P_k = ½·(Σ r² − Σ (r − …)²)        of white noise: σ²·Exp(1)
//! x   = ν·((T/α)^(1/ν) − 1)          a line: P_k over the mean of its neighbours, which their median tells, is more than that
//! ```
//!
//! T is how many orders were looked at, α the chance of a false one among all of them, and ν how many neighbours' worth a median
//! is: that their mean is itself an estimate makes large quotients more frequent, (1 + x/ν)^−ν in place of e^−x.

use super::model::{Feature, Form, Line, Quantity, Shape, ShapeBin};
use super::settings::ShapeSettings;
use super::window::{BEFORE, CORRECTED, MODELS, NOMINAL};

/// A sample of a residual at an angle of its wheel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beat {
    /// Angle of the wheel [rad]
    pub angle: f64,
    /// The orders that it can tell: lower ones were taken off with the window's line, higher ones turn too far from sample to sample.
    pub orders: (f64, f64),
    /// What each model leaves.
    pub residual: [f64; MODELS],
}

/// The samples of a wheel's quantity.
#[derive(Clone, Debug)]
pub(super) struct Beats {
    /// What.
    pub quantity: Quantity,
    /// Of which wheel.
    pub wheel: usize,
    /// The samples.
    pub beats: Vec<Beat>,
}

/// The median of Exp(1).
const MEDIAN: f64 = std::f64::consts::LN_2;

/// How much a sample counts in a median beside a mean [1]: (ln 2)² for Exp(1).
const WORTH_IN_A_MEDIAN: f64 = MEDIAN * MEDIAN;

/// Fewer samples than this tell no order [samples].
const FEWEST: usize = 100;

/// Lines this close to a stronger one are its leakage [orders].
const LEAKAGE: usize = 2;

/// Lines that are named, at the most.
const MOST_LINES: usize = 3;

/// An order fitted.
#[derive(Clone, Copy, Debug)]
struct Fitted<const M: usize> {
    samples: usize,
    /// Of what the first of so many models leaves.
    power: f64,
    /// Of what each of them leaves.
    amplitude: [f64; M],
}

/// The spectrum that shows most, and how plainly; `None` where no order stands out.
pub(super) fn strongest(all: &[Beats], settings: &ShapeSettings) -> Option<(f64, Shape)> {
    let spectra: Vec<(&Beats, Vec<Fitted<1>>)> =
        all.iter().map(|beats| (beats, spectrum(&beats.beats, settings.highest_order, [BEFORE]))).collect();
    let looked_at = spectra.iter().flat_map(|(_, orders)| orders).filter(|order| order.samples >= FEWEST).count();
    let seen = spectra.iter().filter_map(|(beats, orders)| told(beats, orders, looked_at, settings));
    seen.max_by(|a, b| a.0.total_cmp(&b.0))
}

/// Every order from one on, of what these models leave.
fn spectrum<const M: usize>(beats: &[Beat], highest: usize, models: [usize; M]) -> Vec<Fitted<M>> {
    // of cos², sin², cos·sin, and of each residual with cos and sin
    let mut sums = vec![([0.0; 3], [[0.0; 2]; M], 0_usize); highest];
    for beat in beats {
        let (sin, cos) = beat.angle.sin_cos();
        let (mut c, mut s) = (1.0, 0.0);
        let (first, last) = beat.orders;
        let left = models.map(|model| beat.residual[model]);
        for (k, (own, with, n)) in sums.iter_mut().enumerate() {
            (c, s) = (c * cos - s * sin, c * sin + s * cos);
            let order = (k + 1) as f64;
            if order > last {
                break;
            }
            if order < first {
                continue;
            }
            *own = [own[0] + c * c, own[1] + s * s, own[2] + c * s];
            for (with, r) in with.iter_mut().zip(left) {
                *with = [with[0] + c * r, with[1] + s * r];
            }
            *n += 1;
        }
    }
    sums.into_iter()
        .map(|([cc, ss, cs], with, samples)| {
            let size = cc * ss - cs * cs;
            if samples < FEWEST || size <= 1e-3 * cc * ss {
                return Fitted { samples: 0, power: 0.0, amplitude: [0.0; M] };
            }
            let solved = with.map(|[c, s]| [(c * ss - s * cs) / size, (s * cc - c * cs) / size]);
            let ([c, s], [a, b]) = (with[0], solved[0]);
            Fitted { samples, power: 0.5 * (a * c + b * s), amplitude: solved.map(|[a, b]| a.hypot(b)) }
        })
        .collect()
}

/// What noise would be at an order, by its neighbours, and how many they are.
fn noise<const M: usize>(orders: &[Fitted<M>], at: usize, reach: usize) -> (f64, usize) {
    let near = at.saturating_sub(reach)..(at + reach + 1).min(orders.len());
    let neighbours = near.filter(|k| k.abs_diff(at) > LEAKAGE && orders[*k].samples >= FEWEST);
    let mut powers: Vec<f64> = neighbours.map(|k| orders[k].power).collect();
    powers.sort_by(f64::total_cmp);
    (powers.get(powers.len() / 2).copied().unwrap_or(0.0) / MEDIAN, powers.len())
}

fn told(beats: &Beats, orders: &[Fitted<1>], looked_at: usize, settings: &ShapeSettings) -> Option<(f64, Shape)> {
    let quotient = |k: usize| {
        let (noise, neighbours) = noise(orders, k, settings.order_neighbours);
        let worth = WORTH_IN_A_MEDIAN * neighbours as f64;
        let enough = orders[k].samples >= FEWEST && 2 * neighbours >= settings.order_neighbours && noise > 0.0;
        enough.then(|| (orders[k].power / noise, worth))
    };
    let chance = |x: f64, worth: f64| looked_at as f64 * (1.0 + x / worth).powf(-worth);
    let mut lines: Vec<(usize, f64, f64)> = (0..orders.len())
        .filter_map(|k| quotient(k).map(|(x, worth)| (k, x, chance(x, worth))))
        .filter(|(_, _, chance)| *chance < settings.false_alarm)
        .collect();
    lines.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut kept: Vec<(usize, f64, f64)> = Vec::new();
    for line in lines {
        if kept.len() < MOST_LINES && kept.iter().all(|other| other.0.abs_diff(line.0) > LEAKAGE) {
            kept.push(line);
        }
    }
    let (strongest, _, chance) = *kept.first()?;
    let (noise, neighbours) = noise(orders, strongest, settings.order_neighbours);
    let worth = WORTH_IN_A_MEDIAN * neighbours as f64;
    let least = worth * ((looked_at as f64 / settings.false_alarm).powf(1.0 / worth) - 1.0);
    // a line of amplitude A in n samples has a power of n·A²/4
    let amplitude = |power: f64, samples: usize| (4.0 * power / samples as f64).sqrt();
    let square: f64 = beats.beats.iter().map(|beat| beat.residual[BEFORE].powi(2)).sum();
    let held: f64 = kept.iter().map(|(k, ..)| 2.0 * orders[*k].power).sum();
    let told = spectrum(&beats.beats, orders.len(), [BEFORE, NOMINAL, CORRECTED]);
    let bins = told.iter().enumerate().filter(|(_, order)| order.samples >= FEWEST).map(|(k, order)| {
        let half = 2.0 * amplitude(noise, order.samples) / std::f64::consts::SQRT_2;
        let [before, nominal, corrected] = order.amplitude;
        let interval = |x: f64| [(x - half).max(0.0), x + half];
        ShapeBin {
            low: (k + 1) as f64,
            high: (k + 1) as f64,
            at: (k + 1) as f64,
            y: None,
            n: order.samples,
            nominal,
            nominal_ci95: interval(nominal),
            before,
            before_ci95: interval(before),
            corrected,
            corrected_ci95: interval(corrected),
        }
    });
    let shape = Shape {
        form: Form::Spectrum,
        feature: Feature::Order,
        unit: Feature::Order.unit().to_owned(),
        quantity: beats.quantity,
        quantity_unit: beats.quantity.unit().to_owned(),
        group: beats.quantity.group().name().to_owned(),
        wheel: Some(beats.wheel),
        chance: chance.min(1.0),
        share: (held / square.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0),
        alarm_level: Some(amplitude(least * noise, orders[strongest].samples)),
        lines: kept.iter().map(|(k, ..)| Line { order: k + 1, name: None }).collect(),
        bins: bins.collect(),
    };
    Some((kept.iter().map(|(_, x, _)| 2.0 * x).sum(), shape))
}

#[cfg(test)]
#[path = "order_tests.rs"]
mod tests;
