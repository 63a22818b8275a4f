//! Whether a cause is taken up, and which others the data cannot tell from it.

use model_core::effects::card::Role;

use super::candidate::Cause;
use super::round::{Ranked, Ranking};
use crate::engine::knobs::SearchKnobs;
use crate::identify::Prior;
use crate::simulate::Slot;

/// True if a cause is worth taking up: better by enough, relevant, and of a size that is not zero.
pub(super) fn convincing<const N: usize>(
    best: &Ranked<N>,
    ranking: &Ranking<N>,
    further: bool,
    prior: &Prior,
    knobs: &SearchKnobs,
) -> bool {
    let (base, scale) = (&ranking.base, ranking.scale);
    let numbers = best.cause.freedom(prior);
    let (gain, _) = best.scored.better_than(base, scale);
    if gain < knobs.convincing + knobs.convincing_each * numbers as f64 {
        return false;
    }
    let taken = best.scored.share_taken(base);
    match best.cause {
        // what was stated is data too: a parameter need not predict better, only be more believable
        Cause::Parameter(_) => !further || taken > knobs.relevant,
        Cause::Effect(card, _) => {
            let least = if further { knobs.relevant_further } else { knobs.relevant };
            (taken > least || card.shows_event_by_event())
                && best.scored.surely_better_than(base, scale, knobs)
                && has_size(best, prior, knobs.size_errors)
        }
    }
}

/// True if a size of the effect is away from absent by more than so many of its standard errors, its shapes held: of an effect
/// that is absent no data tell a shape, so a size may not seem absent because its shape is uncertain.
fn has_size<const N: usize>(ranked: &Ranked<N>, prior: &Prior, errors: f64) -> bool {
    let Cause::Effect(card, wheel) = ranked.cause else { return true };
    let fit = &ranked.scored.fit;
    let Some(at) = fit.model.effects.iter().position(|e| e.id == card.id && e.wheel == wheel) else { return true };
    let of_role = |role| card.params.iter().enumerate().filter(move |(_, p)| p.role == role);
    let shapes: Vec<Slot> = of_role(Role::Shape).map(|(k, _)| Slot::Param(at, k)).collect();
    let mut sizes = of_role(Role::Size).peekable();
    // an effect without a size is there or not
    sizes.peek().is_none()
        || sizes.any(|(k, p)| {
            let std = fit.std_beside(Slot::Param(at, k), &shapes, prior).unwrap_or(0.0);
            (fit.model.effects[at].params[k] - p.absent).abs() > errors * std
        })
}

/// Causes whose models do as well, by the data, as the best one.
pub(super) fn look_alikes<const N: usize>(best: &Ranked<N>, ranking: &Ranking<N>, knobs: &SearchKnobs) -> Vec<Cause> {
    let mut alike: Vec<Cause> = Vec::new();
    for other in &ranking.ranked {
        let (behind, error) = best.scored.better_than(&other.scored, ranking.scale);
        let data = (other.scored.held() - best.scored.held()) / ranking.scale;
        let close = behind < knobs.tie || (data < knobs.tie && behind < knobs.tie_errors * error);
        let new = !other.cause.same_id(&best.cause) && !alike.iter().any(|a| a.same_id(&other.cause));
        // a cause that is no better than having none is no look-alike of one that is
        let explains = ranking.base.score(ranking.scale) - other.scored.score(ranking.scale) > knobs.convincing;
        if close && new && explains {
            alike.push(other.cause);
        }
    }
    alike
}
