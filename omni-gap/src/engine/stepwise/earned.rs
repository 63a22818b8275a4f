//! Causes have to earn their place: each is taken out of the corrected model again, and does not come back if that hardly
//! matters. Those that stay are put in the order of what they earn.

use rayon::prelude::*;

use super::accept::{Beside, asked_of};
use super::candidate::Cause;
use super::found::Found;
use super::scored::{Data, Scored, error_scale};
use super::selection::Selection;

/// The causes that earn their place, the one that earns most first, and the model with them.
pub(super) fn earning_their_place<const N: usize>(
    data: &Data<'_, N>,
    selected: Selection<N>,
    refitted: &Scored<N>,
) -> Selection<N> {
    let Selection { mut found, mut corrected, rounds } = selected;
    while found.len() > 1 {
        let without: Vec<Scored<N>> =
            (0..found.len()).into_par_iter().map(|left_out| without(data, &found, left_out, &corrected)).collect();
        let scale = error_scale(without.iter().chain([&corrected, refitted]));
        for (found, without) in found.iter_mut().zip(&without) {
            found.earns = without.score(scale) - corrected.score(scale);
        }
        let lacks = |k: usize| {
            let beside =
                Beside::these(found.iter().enumerate().filter(|(other, _)| *other != k).map(|(_, found)| found));
            let Found { cause, earns, .. } = &found[k];
            asked_of(cause, cause.freedom(data.prior), beside, &data.knobs.search) - earns
        };
        let worst = (0..found.len()).max_by(|a, b| lacks(*a).total_cmp(&lacks(*b)));
        let Some(worst) = worst.filter(|worst| lacks(*worst) > 0.0) else { break };
        corrected = without[worst].clone();
        found.remove(worst);
    }
    found.sort_by(|a, b| b.earns.total_cmp(&a.earns));
    Selection { found, corrected, rounds }
}

/// The corrected model fitted again without one of its causes.
pub(super) fn without<const N: usize>(
    data: &Data<'_, N>,
    found: &[Found],
    left_out: usize,
    corrected: &Scored<N>,
) -> Scored<N> {
    let mut model = corrected.fit.model.clone();
    if let Cause::Effect(card, wheel) = found[left_out].cause {
        model.effects.retain(|effect| !(effect.id == card.id && effect.wheel == wheel));
    }
    let others = found.iter().enumerate().filter(|(k, _)| *k != left_out).map(|(_, found)| &found.cause);
    let prior = Cause::all_struck_out_of(others, data.prior, data.knobs.fit.released_sigma);
    let extra = corrected.extra - found[left_out].cause.freedom(data.prior);
    data.judge(model, Some(corrected), &prior, extra)
}
