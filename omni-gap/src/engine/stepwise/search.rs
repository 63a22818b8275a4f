//! The search: causes are taken up one by one (forward stepwise selection), and what is left decides the outcome.

use super::accept::{convincing, look_alikes};
use super::candidate::Cause;
use super::round::{Ranking, explain};
use super::scored::{Data, Scored};
use crate::engine::knobs::OutcomeKnobs;
use crate::localise::{Measured, floor, measure};
use crate::simulate::{Model, ROOM_FOR_CAUSES, SignalGroup};
use crate::vocabulary::Progress;

/// A cause of the corrected model.
#[derive(Clone, Debug)]
pub struct Found {
    /// The cause.
    pub cause: Cause,
    /// Causes that the data cannot tell from it.
    pub not_told_apart_from: Vec<Cause>,
    /// The round in which it was found.
    pub round: usize,
}

/// What the data say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The nominal model is as good as noise and stated uncertainty allow.
    NoGap,
    /// The causes found explain the gap; the first one's kind is the verdict.
    Explained,
    /// There is a gap, and the causes found (if any) do not explain it.
    Unknown,
}

/// What a search came to.
#[derive(Clone, Debug)]
pub struct Search<const N: usize> {
    /// What the data say.
    pub outcome: Outcome,
    /// The group beside the totals that they were judged by, where the totals show no gap and it does.
    pub beside: Option<SignalGroup>,
    /// The causes, the one that explains most first.
    pub found: Vec<Found>,
    /// The model with these causes.
    pub corrected: Scored<N>,
    /// The plain model re-fitted within what was stated.
    pub refitted: Scored<N>,
    /// All that was tried: first on top of the re-fitted plain model, then on top of the causes found so far.
    pub rounds: Vec<Ranking<N>>,
    /// Share of the gap that the causes close: over the re-fitted plain model for effects, over the nominal one for
    /// parameters alone.
    pub closed: f64,
}

impl<const N: usize> Search<N> {
    /// The model that a report stands by: with its causes where they explain the gap, else the plain one re-fitted.
    pub fn reported(&self) -> &Scored<N> {
        match self.outcome {
            Outcome::Explained => &self.corrected,
            Outcome::NoGap | Outcome::Unknown => &self.refitted,
        }
    }
}

/// Searches causes one by one, until a further one explains no more.
pub fn search<const N: usize>(data: &Data<'_, N>, nominal: &Model<N>, progress: Progress<'_>) -> Search<N> {
    progress("fitting the plain model within its stated uncertainty");
    let knobs = &data.knobs.search;
    let mut prior = data.prior.clone();
    let refitted = data.judge(nominal.clone(), None, &prior, 0);
    let mut current = refitted.clone();
    let mut found: Vec<Found> = Vec::new();
    let mut rounds: Vec<Ranking<N>> = Vec::new();
    loop {
        // what is left may be too little for any further cause to be relevant
        if !found.is_empty() && current.held() < knobs.enough * current.freedom {
            break;
        }
        progress(match found.len() {
            0 => "trying every cause",
            _ => "trying what is left after the causes found",
        });
        rounds.push(explain(data, current.clone(), &prior));
        let ranking = &rounds[rounds.len() - 1];
        // of causes that score alike, the first that convinces: a friction wrong on one axis may stand behind all three
        let least = ranking.ranked.first().map_or(0.0, |r| r.scored.score(ranking.scale));
        let best = ranking
            .ranked
            .iter()
            .filter(|_| found.len() < knobs.most_causes.min(ROOM_FOR_CAUSES - 1))
            .take_while(|r| r.scored.score(ranking.scale) - least < knobs.tie)
            .find(|r| convincing(r, ranking, !found.is_empty(), &prior, knobs));
        let Some(best) = best else { break };
        if let Cause::Parameter(release) = best.cause {
            prior = prior.without(release, data.knobs.fit.released_sigma);
        }
        current = best.scored.clone();
        let not_told_apart_from = look_alikes(best, ranking, knobs);
        found.push(Found { cause: best.cause, not_told_apart_from, round: rounds.len() - 1 });
    }
    progress("measuring the gap");
    let Judged { outcome, beside, closed } = judged(data, nominal, &refitted, &current, &found);
    Search { outcome, beside, found, corrected: current, refitted, rounds, closed }
}

/// What the causes found come to.
struct Judged {
    outcome: Outcome,
    beside: Option<SignalGroup>,
    closed: f64,
}

/// Whether the causes found explain the gap, and which share of it they close.
fn judged<const N: usize>(
    data: &Data<'_, N>,
    nominal: &Model<N>,
    refitted: &Scored<N>,
    corrected: &Scored<N>,
    found: &[Found],
) -> Judged {
    let OutcomeKnobs { least_closed, inadequate, inadequate_parameters } = data.knobs.outcome;
    let horizon = data.knobs.measure.horizon_s;
    let error = |model: &Model<N>| measure(&model.plant(), &data.held, horizon);
    let (before, after) = (error(&refitted.fit.model), error(&corrected.fit.model));
    let least = floor(&corrected.fit.model.plant(), &data.held, horizon);
    let beside = beside_the_totals(&before, &least, inadequate);
    let of =
        |error: &Measured| beside.map_or_else(|| error.total(), |group| error.groups()[group as usize].unwrap_or(0.0));
    let (after, least) = (of(&after), of(&least));
    let parameters_only = !found.is_empty() && found.iter().all(|f| matches!(f.cause, Cause::Parameter(_)));
    // a re-fit within what was stated already leans towards a wrong parameter's true value
    let from = if parameters_only { of(&error(nominal)) } else { of(&before) };
    // a quotient of less than that would be noise
    let worth_dividing_by = from - least > data.knobs.measure.smallest_room_sigma;
    let closed = if worth_dividing_by { ((from - after) / (from - least)).clamp(0.0, 1.0) } else { 1.0 };
    let outcome = if found.is_empty() {
        if after > inadequate * least { Outcome::Unknown } else { Outcome::NoGap }
    } else if parameters_only {
        if after > inadequate_parameters * least { Outcome::Unknown } else { Outcome::Explained }
    } else if closed < least_closed && after > inadequate * least {
        Outcome::Unknown
    } else {
        Outcome::Explained
    };
    Judged { outcome, beside, closed }
}

/// Where the plain model leaves no gap in the totals, the group beside them in which it leaves the largest, if any.
fn beside_the_totals(before: &Measured, least: &Measured, inadequate: f64) -> Option<SignalGroup> {
    if before.total() > inadequate * least.total() {
        return None;
    }
    let over_floor = |group: SignalGroup| Some(before.groups()[group as usize]? / least.groups()[group as usize]?);
    let beside = SignalGroup::ALL.into_iter().filter(|group| !group.in_totals());
    let gaps = beside.filter_map(|group| Some((group, over_floor(group).filter(|over| *over > inadequate)?)));
    gaps.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(group, _)| group)
}
