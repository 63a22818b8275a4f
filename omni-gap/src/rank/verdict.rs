//! The verdict: which causes a corrected model needs, and when to say that nothing known explains the gap.

use model_core::effects::card::Role;

use super::candidate::Cause;
use super::order::{Data, ENOUGH, Ranked, Ranking, Scored, explain};
use crate::identify::Prior;
use crate::localise::{floor, measure};
use crate::simulate::{Model, Slot};

/// Causes that one corrected model may need, at the most.
const MOST_CAUSES: usize = 3;
/// A cause has to better the score by this, and by as much again for each free number or statement that it adds
/// (one number: a chance of 1 in 2,000 when nothing is there).
const CONVINCING: f64 = 8.0;
const CONVINCING_EACH: f64 = 2.0;
/// An effect has to take this share off Σ error²: a significant but tiny improvement explains nothing.
const RELEVANT: f64 = 0.01;
/// A further cause has to take this share off what the first causes left.
const RELEVANT_FURTHER: f64 = 0.05;
/// Score within which two causes are not told apart, and standard errors of their difference that count as none.
const TIE: f64 = 8.0;
const TIE_ERRORS: f64 = 2.0;
/// Standard errors by which an effect's size has to be away from absent.
const SIZE_ERRORS: f64 = 3.0;
/// Least share of the gap that known causes have to close; with less the answer is `unknown`.
pub const LEAST_CLOSED: f64 = 0.6;
/// Free-run error over its floor above which a re-fitted plain model leaves a gap.
const INADEQUATE: f64 = 1.15;

/// A cause of the corrected model.
#[derive(Clone, Debug)]
pub struct Found<const N: usize> {
    /// The cause.
    pub cause: Cause,
    /// Causes that the data cannot tell from it.
    pub not_told_apart_from: Vec<Cause>,
    /// All that was tried when it was found.
    pub ranking: Ranking<N>,
}

/// What the data say.
#[derive(Clone, Debug)]
pub enum Outcome {
    /// The nominal model is as good as noise and stated uncertainty allow.
    NoGap,
    /// The causes found explain the gap; the first one's kind is the verdict.
    Explained,
    /// There is a gap, and the causes found (if any) do not explain it.
    Unknown,
}

/// The result of the search.
#[derive(Clone, Debug)]
pub struct Verdict<const N: usize> {
    /// What the data say.
    pub outcome: Outcome,
    /// The causes, the one that explains most first.
    pub found: Vec<Found<N>>,
    /// The model with these causes.
    pub corrected: Scored<N>,
    /// The plain model re-fitted within what was stated.
    pub refitted: Scored<N>,
    /// What was tried last, on top of the corrected model.
    pub last: Ranking<N>,
    /// Share of the gap that the causes close: over the re-fitted plain model for effects, over the nominal one for
    /// parameters alone.
    pub closed: f64,
}

impl<const N: usize> Verdict<N> {
    /// The model that a report stands by: with its causes where they explain the gap, else the plain one re-fitted.
    pub fn reported(&self) -> &Scored<N> {
        match self.outcome {
            Outcome::Explained => &self.corrected,
            Outcome::NoGap | Outcome::Unknown => &self.refitted,
        }
    }
}

/// Searches causes one by one, until a further one explains no more.
pub fn decide<const N: usize>(
    data: &Data<'_, N>,
    nominal: &Model<N>,
    horizon: f64,
    progress: &dyn Fn(&str),
) -> Verdict<N> {
    progress("fitting the plain model within its stated uncertainty");
    let mut prior = data.prior.clone();
    let refitted = data.judge(nominal.clone(), None, &prior, 0);
    let mut current = refitted.clone();
    let mut found: Vec<Found<N>> = Vec::new();
    let last = loop {
        // what is left may be too little for any further cause to be relevant
        if let Some(f) = found.last().filter(|_| current.held() < ENOUGH * current.freedom) {
            break f.ranking.clone();
        }
        progress(match found.len() {
            0 => "trying every cause",
            _ => "trying what is left after the causes found",
        });
        let ranking = explain(data, current.clone(), &prior);
        // of causes that score alike, the first that convinces: a friction wrong on one axis may stand behind all three
        let least = ranking.ranked.first().map_or(0.0, |r| r.scored.score(ranking.scale));
        let best = ranking
            .ranked
            .iter()
            .filter(|_| found.len() < MOST_CAUSES)
            .take_while(|r| r.scored.score(ranking.scale) - least < TIE)
            .find(|r| convincing(r, &ranking, !found.is_empty(), &prior));
        let Some(best) = best else { break ranking };
        if let Cause::Parameter(release) = best.cause {
            prior = prior.without(release);
        }
        let not_told_apart_from = look_alikes(best, &ranking);
        current = best.scored.clone();
        found.push(Found { cause: best.cause, not_told_apart_from, ranking });
    };
    progress("measuring the gap");
    let total = |scored: &Scored<N>| measure(&scored.fit.model.plant(), &data.held, horizon).total();
    let (before, after) = (total(&refitted), total(&current));
    let least = floor(&current.fit.model.plant(), &data.held, horizon).total();
    let parameters_only = !found.is_empty() && found.iter().all(|f| matches!(f.cause, Cause::Parameter(_)));
    // a re-fit within what was stated already leans towards a wrong parameter's true value
    let from = if parameters_only { measure(&nominal.plant(), &data.held, horizon).total() } else { before };
    let closed = if from > least { ((from - after) / (from - least)).clamp(0.0, 1.0) } else { 1.0 };
    let outcome = if found.is_empty() {
        if after > INADEQUATE * least { Outcome::Unknown } else { Outcome::NoGap }
    } else if parameters_only {
        if after > 2.0 * INADEQUATE * least { Outcome::Unknown } else { Outcome::Explained }
    } else if closed < LEAST_CLOSED && after > INADEQUATE * least {
        Outcome::Unknown
    } else {
        Outcome::Explained
    };
    Verdict { outcome, found, corrected: current, refitted, last, closed }
}

fn convincing<const N: usize>(best: &Ranked<N>, ranking: &Ranking<N>, further: bool, prior: &Prior) -> bool {
    let (base, scale) = (&ranking.base, ranking.scale);
    let numbers = best.cause.freedom(prior);
    let (gain, error) = best.scored.better_than(base, scale);
    if gain < CONVINCING + CONVINCING_EACH * numbers as f64 {
        return false;
    }
    let taken = (base.held() - best.scored.held()) / base.held();
    match best.cause {
        // what was stated is data too: a parameter need not predict better, only be more believable
        Cause::Parameter(_) => !further || taken > RELEVANT,
        Cause::Effect(..) => {
            let least = if further { RELEVANT_FURTHER } else { RELEVANT };
            taken > least && gain > TIE_ERRORS * error && has_size(best)
        }
    }
}

/// True if a size of the effect is away from absent by more than its uncertainty allows.
fn has_size<const N: usize>(ranked: &Ranked<N>) -> bool {
    let Cause::Effect(card, wheel) = ranked.cause else { return true };
    let fit = &ranked.scored.fit;
    let Some(at) = fit.model.effects.iter().position(|e| e.id == card.id && e.wheel == wheel) else { return true };
    let mut numbers = card.params.iter().enumerate().filter(|(_, p)| p.role != Role::Fixed).peekable();
    // an effect without free numbers is there or not
    numbers.peek().is_none()
        || numbers.any(|(k, p)| {
            let std = fit.std(Slot::Param(at, k)).unwrap_or(0.0);
            (fit.model.effects[at].params[k] - p.absent).abs() > SIZE_ERRORS * std
        })
}

/// Causes whose models do as well, by the data, as the best one.
fn look_alikes<const N: usize>(best: &Ranked<N>, ranking: &Ranking<N>) -> Vec<Cause> {
    let mut alike: Vec<Cause> = Vec::new();
    for other in &ranking.ranked {
        let (behind, error) = best.scored.better_than(&other.scored, ranking.scale);
        let data = (other.scored.held() - best.scored.held()) / ranking.scale;
        let close = behind < TIE || (data < TIE && behind < TIE_ERRORS * error);
        let new = !other.cause.same_id(&best.cause) && !alike.iter().any(|a| a.same_id(&other.cause));
        // a cause that is no better than having none is no look-alike of one that is
        let explains = ranking.base.score(ranking.scale) - other.scored.score(ranking.scale) > CONVINCING;
        if close && new && explains {
            alike.push(other.cause);
        }
    }
    alike
}
