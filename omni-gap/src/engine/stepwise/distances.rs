//! How far: the gap before and after, against its floor.

use model_core::plant::Plant;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::scored::Data;
use crate::engine::findings::{Gap, HorizonError, Shrink, SignalGap};
use crate::engine::knobs::MeasureKnobs;
use crate::localise::flexible::flexible;
use crate::localise::{Measured, floor, measure};
use crate::simulate::{AlignedRun, SignalGroup};

/// The plants that are measured against each other.
#[derive(Debug)]
pub(super) struct Plants<const N: usize> {
    /// What the robot file says.
    pub nominal: Plant<N, f64>,
    /// What the findings stand by.
    pub corrected: Plant<N, f64>,
    /// The nominal one, re-fitted within what was stated.
    pub refitted: Plant<N, f64>,
    /// The best that was found, stood by or not.
    pub best: Plant<N, f64>,
    /// The best fitted cause that is neither found nor a look-alike of one that was.
    pub runner_up: Option<Plant<N, f64>>,
}

/// The gap of each signal group, and how far it closes.
pub(super) fn shrink<const N: usize>(plants: &Plants<N>, data: &Data<'_, N>) -> (Gap, Shrink) {
    let (held, knobs) = (&data.held[..], &data.knobs.measure);
    let MeasureKnobs { horizon_s: horizon, smallest_room_sigma: too_small, .. } = *knobs;
    let Plants { nominal, corrected, refitted, best, runner_up } = plants;
    let before = measure(nominal, held, horizon);
    let after = measure(corrected, held, horizon);
    let least = floor(corrected, held, horizon);
    let curves = curves(plants, held, knobs);
    let mut gap = Gap { horizons_s: curves.iter().map(|c| c.horizon_s).collect(), curves, ..Gap::default() };
    let of = |m: &Measured, group: SignalGroup| m.groups()[group as usize].unwrap_or(0.0);
    for group in SignalGroup::ALL.into_iter().filter(|group| before.groups()[*group as usize].is_some()) {
        let signal = SignalGap { before: of(&before, group), after: of(&after, group), noise_floor: of(&least, group) };
        gap.signals.insert(group.name().to_owned(), signal);
    }
    let room = before.total() - least.total();
    let closed_by = |total: f64| (room >= too_small).then(|| (before.total() - total) / room);
    let flexible = flexible(best, (&data.fit, held), horizon, &data.knobs.flexible).total();
    let shrink = Shrink {
        before: Some(before.total()),
        after: Some(after.total()),
        noise_floor: Some(least.total()),
        closed: closed_by(after.total()),
        reason: (room < too_small)
            .then(|| format!("before − floor is {room:.2} σ, less than {too_small} σ: too small to divide by")),
        closed_ci95: (room >= too_small).then(|| interval(&before, &after, &least, knobs)),
        closed_by_refit_alone: closed_by(measure(refitted, held, horizon).total()),
        closed_by_runner_up: runner_up.as_ref().and_then(|plant| closed_by(measure(plant, held, horizon).total())),
        closed_by_flexible_model: Some((before.total() - flexible) / room.max(too_small)),
        ..Shrink::default()
    };
    (gap, shrink)
}

/// The middle of the closed share over resamplings of the windows.
fn interval(before: &Measured, after: &Measured, least: &Measured, knobs: &MeasureKnobs) -> [f64; 2] {
    let n = before.windows.len();
    let mut random = ChaCha8Rng::seed_from_u64(knobs.resampling_seed);
    let mut closed: Vec<f64> = (0..knobs.resamplings)
        .filter_map(|_| {
            let pick: Vec<usize> = (0..n).map(|_| random.random_range(0..n)).collect();
            let (b, a, f) = (before.total_of(&pick), after.total_of(&pick), least.total_of(&pick));
            (b - f > 1e-9).then(|| (b - a) / (b - f))
        })
        .collect();
    closed.sort_by(f64::total_cmp);
    let at = |share: f64| closed.get(((closed.len() as f64 - 1.0) * share).round() as usize).copied().unwrap_or(0.0);
    [at(knobs.interval.0), at(knobs.interval.1)]
}

/// Total error at each horizon.
fn curves<const N: usize>(plants: &Plants<N>, held: &[&AlignedRun<N>], knobs: &MeasureKnobs) -> Vec<HorizonError> {
    let Plants { nominal, corrected, .. } = plants;
    let longest = held.iter().filter_map(|r| r.t.last()).fold(0.0, |most: f64, t| most.max(*t));
    knobs
        .horizons_s
        .iter()
        .copied()
        .filter(|h| *h <= longest)
        .map(|horizon_s| HorizonError {
            horizon_s,
            before: measure(nominal, held, horizon_s).total(),
            after: measure(corrected, held, horizon_s).total(),
            noise_floor: Some(floor(corrected, held, horizon_s).total()),
        })
        .collect()
}
