//! Forward selection: causes are taken up one by one, the best that convinces first.

use super::accept::{Beside, convincing, look_alikes};
use super::candidate::Cause;
use super::found::Found;
use super::round::{Ranked, Ranking, Tried, explain};
use super::scored::{Data, Scored};
use crate::engine::knobs::SearchKnobs;
use crate::identify::Prior;
use crate::simulate::ROOM_FOR_CAUSES;
use crate::vocabulary::Progress;

/// Causes, the model with them, and all that was tried on the way.
#[derive(Clone, Debug)]
pub(super) struct Selection<const N: usize> {
    /// The causes.
    pub found: Vec<Found>,
    /// The model with them.
    pub corrected: Scored<N>,
    /// What was tried, round by round.
    pub rounds: Vec<Ranking<N>>,
}

impl<const N: usize> Selection<N> {
    /// No cause yet.
    pub fn of(refitted: &Scored<N>) -> Self {
        Self { found: Vec::new(), corrected: refitted.clone(), rounds: Vec::new() }
    }

    /// Takes up further causes among what is tried, until none convinces.
    pub fn forward(mut self, data: &Data<'_, N>, tried: Tried, progress: Progress<'_>) -> Self {
        let knobs = &data.knobs.search;
        loop {
            let room = self.room(tried, knobs);
            if !room.effects && !room.numbers {
                return self;
            }
            progress(match self.found.len() {
                0 => "trying every cause",
                _ => "trying what is left after the causes found",
            });
            let causes = self.found.iter().map(|found| &found.cause);
            let prior = Cause::all_struck_out_of(causes, data.prior, data.knobs.fit.released_sigma);
            self.rounds.push(explain(data, self.corrected.clone(), &prior, room));
            let round = self.rounds.len() - 1;
            let ranking = &self.rounds[round];
            let Some(best) = first_convincing(ranking, &self.found, &prior, knobs) else { return self };
            let earns = ranking.base.score(ranking.scale) - best.scored.score(ranking.scale);
            let not_told_apart_from = look_alikes(best, ranking, knobs);
            self.found.push(Found { cause: best.cause, not_told_apart_from, round, earns });
            self.corrected = best.scored.clone();
        }
    }

    /// What a model with these causes has room for: what is left may be too little for any further effect to be relevant; a
    /// number may still be unbelievable.
    fn room(&self, tried: Tried, knobs: &SearchKnobs) -> Tried {
        let nothing_left = self.corrected.held() < knobs.enough * self.corrected.freedom;
        let numbers = self.found.iter().filter(|found| found.is_parameter()).count();
        let effects = self.found.len() - numbers;
        let most_effects = knobs.most_causes.min(ROOM_FOR_CAUSES - 1);
        Tried {
            effects: tried.effects && (self.found.is_empty() || !nothing_left) && effects < most_effects,
            numbers: tried.numbers && numbers < knobs.most_numbers,
        }
    }
}

/// Of causes that score alike, the first that convinces: a friction wrong on one axis may stand behind all three.
fn first_convincing<'a, const N: usize>(
    ranking: &'a Ranking<N>,
    found: &[Found],
    prior: &Prior,
    knobs: &SearchKnobs,
) -> Option<&'a Ranked<N>> {
    let least = ranking.ranked.first().map_or(0.0, |r| r.scored.score(ranking.scale));
    let alike = ranking.ranked.iter().take_while(|r| r.scored.score(ranking.scale) - least < knobs.tie);
    alike.into_iter().find(|r| convincing(r, ranking, Beside::these(found), prior, knobs))
}
