//! Whether a cause is taken up, and which others the data cannot tell from it.

use model_core::effects::card::Role;

use super::candidate::Cause;
use super::found::Found;
use super::round::{Ranked, Ranking};
use crate::engine::knobs::SearchKnobs;
use crate::identify::Prior;
use crate::simulate::Slot;

/// What stands in a model beside a cause.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beside {
    /// Any cause.
    pub causes: bool,
    /// Numbers of the robot file alone: of a file that is wrong once, another is believed sooner.
    pub numbers_alone: bool,
}

impl Beside {
    /// These causes.
    pub fn these<'a>(causes: impl IntoIterator<Item = &'a Found>) -> Self {
        let mut causes = causes.into_iter().peekable();
        let any = causes.peek().is_some();
        Self { causes: any, numbers_alone: any && causes.all(Found::is_parameter) }
    }
}

/// True if a cause is worth taking up: better by enough, relevant, and of a size that is not zero.
pub(super) fn convincing<const N: usize>(
    best: &Ranked<N>,
    ranking: &Ranking<N>,
    beside: Beside,
    prior: &Prior,
    knobs: &SearchKnobs,
) -> bool {
    let (base, scale) = (&ranking.base, ranking.scale);
    let numbers = best.cause.freedom(prior);
    let (gain, _) = best.scored.better_than(base, scale);
    let sure = best.scored.surely_better_than(base, scale, knobs);
    // of what predicts better by chance only what was stated counts
    let by_chance = if sure { 0.0 } else { (base.held() - best.scored.held()).max(0.0) / scale };
    if gain - by_chance < asked_of(&best.cause, numbers, beside, knobs) {
        return false;
    }
    let no_effect = !beside.causes || beside.numbers_alone;
    let taken = best.scored.share_taken(base);
    let Cause::Effect(card, _) = best.cause else {
        // what was stated is data too: where no effect is known, a parameter need not predict better, only be more believable
        return no_effect || taken > knobs.relevant;
    };
    let least = if beside.causes { knobs.relevant_further } else { knobs.relevant };
    // what an effect is not quite right about is put on numbers beside it: that another spares them says nothing
    let spares = no_effect && base.stated - best.scored.stated > knobs.unbelievable;
    (taken > least || spares || card.shows_event_by_event()) && sure && has_size(best, prior, knobs.size_errors)
}

/// By how much a cause has to better the score.
pub(super) fn asked_of(cause: &Cause, numbers: usize, beside: Beside, knobs: &SearchKnobs) -> f64 {
    let once = match cause {
        Cause::Parameter(_) if beside.numbers_alone => knobs.convincing_further_number,
        Cause::Parameter(_) if !beside.causes => knobs.convincing_number,
        // what an effect is not quite right about is put on numbers beside it
        _ => knobs.convincing,
    };
    once + knobs.convincing_each * numbers as f64
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
