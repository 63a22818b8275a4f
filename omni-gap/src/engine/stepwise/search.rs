//! The search: causes are taken up one by one (forward stepwise selection), and what is left decides the outcome.

use super::earned::earning_their_place;
use super::exchanged::exchanged_for_numbers;
use super::found::Found;
use super::judged::{Judged, Outcome, judged};
use super::round::{Ranking, Tried};
use super::scored::{Data, Scored};
use super::selection::Selection;
use crate::simulate::{Model, SignalGroup};
use crate::vocabulary::Progress;

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
    /// All that was tried: first on top of the re-fitted plain model, then on top of the causes found so far; at the end what was
    /// tried in the place of an effect.
    pub rounds: Vec<Ranking<N>>,
    /// Share of the gap that the causes close: over the re-fitted plain model for effects, over the nominal one for
    /// parameters alone.
    pub closed: f64,
    /// How far what the corrected model misses is on its way from noise (zero) to where it is no longer adequate (one).
    pub inadequate: f64,
    /// What the corrected model leaves, as a multiple of what noise alone would: of the group where it is largest [1].
    pub excess: Option<f64>,
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

/// Searches causes one by one, until a further one explains no more; then each has to earn its place beside the others, and an
/// effect that leaves the file unbelievable numbers may stand for numbers alone.
pub fn search<const N: usize>(data: &Data<'_, N>, nominal: &Model<N>, progress: Progress<'_>) -> Search<N> {
    progress("fitting the plain model within its stated uncertainty");
    let refitted = data.judge(nominal.clone(), None, data.prior, 0);
    let all = Tried { effects: true, numbers: true };
    let selected = Selection::of(&refitted).forward(data, all, progress);
    let selected = exchanged_for_numbers(data, earning_their_place(data, selected, &refitted), &refitted, progress);
    progress("measuring the gap");
    let Selection { found, corrected, rounds } = selected;
    let Judged { outcome, beside, closed, inadequate, excess } = judged(data, nominal, &refitted, &corrected, &found);
    Search { outcome, beside, found, corrected, refitted, rounds, closed, inadequate, excess }
}
