//! How far: the gap before and after, against its floor.

use model_core::plant::Plant;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::localise::{GROUPS, Measured, floor, measure};
use crate::report::{Gap, HorizonError, Shrink, SignalGap};
use crate::simulate::Recorded;

/// Horizons of the curves [s]
const HORIZONS_S: [f64; 5] = [0.1, 0.25, 0.5, 1.0, 2.0];
/// A gap smaller than this is not divided by [σ].
const TOO_SMALL: f64 = 0.1;
/// Resamplings of the windows for the interval.
const RESAMPLINGS: usize = 400;
const RESAMPLING_SEED: u64 = 1;

pub(super) fn shrink<const N: usize>(
    nominal: &Plant<N, f64>,
    corrected: &Plant<N, f64>,
    refitted: &Plant<N, f64>,
    runner_up: Option<&Plant<N, f64>>,
    held: &[&Recorded<N>],
    horizon: f64,
) -> (Gap, Shrink) {
    let before = measure(nominal, held, horizon);
    let after = measure(corrected, held, horizon);
    let least = floor(corrected, held, horizon);
    let mut gap = Gap::default();
    let of = |m: &Measured, g: usize| m.groups()[g].unwrap_or(0.0);
    for (g, name) in GROUPS.iter().enumerate().filter(|(g, _)| before.groups()[*g].is_some()) {
        let signal = SignalGap { before: of(&before, g), after: of(&after, g), noise_floor: of(&least, g) };
        gap.signals.insert((*name).to_owned(), signal);
    }
    let room = before.total() - least.total();
    let closed_by = |total: f64| (room >= TOO_SMALL).then(|| (before.total() - total) / room);
    let shrink = Shrink {
        before: Some(before.total()),
        after: Some(after.total()),
        noise_floor: Some(least.total()),
        closed: closed_by(after.total()),
        reason: (room < TOO_SMALL)
            .then(|| format!("before − floor is {room:.2} σ, less than {TOO_SMALL} σ: too small to divide by")),
        closed_ci95: (room >= TOO_SMALL).then(|| interval(&before, &after, &least)),
        closed_by_refit_alone: closed_by(measure(refitted, held, horizon).total()),
        closed_by_runner_up: runner_up.and_then(|plant| closed_by(measure(plant, held, horizon).total())),
        closed_by_flexible_model: None,
    };
    (gap, shrink)
}

/// 95 % of the closed share over resamplings of the windows.
fn interval(before: &Measured, after: &Measured, least: &Measured) -> [f64; 2] {
    let n = before.windows.len();
    let mut random = ChaCha8Rng::seed_from_u64(RESAMPLING_SEED);
    let mut closed: Vec<f64> = (0..RESAMPLINGS)
        .filter_map(|_| {
            let pick: Vec<usize> = (0..n).map(|_| random.random_range(0..n)).collect();
            let (b, a, f) = (before.total_of(&pick), after.total_of(&pick), least.total_of(&pick));
            (b - f > 1e-9).then(|| (b - a) / (b - f))
        })
        .collect();
    closed.sort_by(f64::total_cmp);
    let at = |share: f64| closed.get(((closed.len() as f64 - 1.0) * share).round() as usize).copied().unwrap_or(0.0);
    [at(0.025), at(0.975)]
}

/// Total error at each horizon.
pub(super) fn curves<const N: usize>(
    nominal: &Plant<N, f64>,
    corrected: &Plant<N, f64>,
    held: &[&Recorded<N>],
) -> Vec<HorizonError> {
    let longest = held.iter().filter_map(|r| r.t.last()).fold(0.0, |most: f64, t| most.max(*t));
    HORIZONS_S
        .into_iter()
        .filter(|h| *h <= longest)
        .map(|horizon_s| HorizonError {
            horizon_s,
            before: measure(nominal, held, horizon_s).total(),
            after: measure(corrected, held, horizon_s).total(),
            noise_floor: Some(floor(corrected, held, horizon_s).total()),
        })
        .collect()
}
