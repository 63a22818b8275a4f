//! The search: causes are taken up one by one (forward stepwise selection), and what is left decides the outcome.

use super::earned::earning_their_place;
use super::exchanged::exchanged_for_numbers;
use super::found::Found;
use super::round::{Ranking, Tried};
use super::scored::{Data, Scored};
use super::selection::Selection;
use crate::engine::knobs::OutcomeKnobs;
use crate::localise::{Measured, floor, measure};
use crate::simulate::{Model, SignalGroup};
use crate::vocabulary::Progress;

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
    /// All that was tried: first on top of the re-fitted plain model, then on top of the causes found so far; at the end what was
    /// tried in the place of an effect.
    pub rounds: Vec<Ranking<N>>,
    /// Share of the gap that the causes close: over the re-fitted plain model for effects, over the nominal one for
    /// parameters alone.
    pub closed: f64,
    /// How far what the corrected model misses is on its way from noise (zero) to where it is no longer adequate (one).
    pub inadequate: f64,
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
    let Judged { outcome, beside, closed, inadequate } = judged(data, nominal, &refitted, &corrected, &found);
    Search { outcome, beside, found, corrected, refitted, rounds, closed, inadequate }
}

/// What the causes found come to.
struct Judged {
    outcome: Outcome,
    beside: Option<SignalGroup>,
    closed: f64,
    inadequate: f64,
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
    let parameters_only = !found.is_empty() && found.iter().all(Found::is_parameter);
    // a re-fit within what was stated already leans towards a wrong parameter's true value
    let from = if parameters_only { of(&error(nominal)) } else { of(&before) };
    // a quotient of less than that would be noise
    let worth_dividing_by = from - least > data.knobs.measure.smallest_room_sigma;
    let closed = if worth_dividing_by { ((from - after) / (from - least)).clamp(0.0, 1.0) } else { 1.0 };
    let most = if parameters_only { inadequate_parameters } else { inadequate };
    let adequate = after <= most * least;
    let outcome = match (found.is_empty(), adequate) {
        (true, true) => Outcome::NoGap,
        (false, true) => Outcome::Explained,
        (false, false) if !parameters_only && closed >= least_closed => Outcome::Explained,
        (_, false) => Outcome::Unknown,
    };
    Judged { outcome, beside, closed, inadequate: (after / least - 1.0) / (most - 1.0) }
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
