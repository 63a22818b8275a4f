//! What the causes found come to: whether they explain the gap, and which share of it they close.

use std::cell::LazyCell;

use super::found::Found;
use super::scored::{Data, Scored};
use crate::engine::knobs::OutcomeKnobs;
use crate::localise::{Measured, excess, floor, measure};
use crate::simulate::{AlignedRun, Model, PerGroup, SignalGroup};

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

/// What the causes found come to.
pub(super) struct Judged {
    /// What the data say.
    pub outcome: Outcome,
    /// The group beside the totals that they are judged by, if any.
    pub beside: Option<SignalGroup>,
    /// Share of the gap that the causes close.
    pub closed: f64,
    /// How far what is left is on its way from noise (zero) to where the model is no longer adequate (one).
    pub inadequate: f64,
    /// The excess of the model with the causes found, of the group in the totals where it is largest [1].
    pub excess: Option<f64>,
}

/// Whether the causes found explain the gap, and which share of it they close.
pub(super) fn judged<const N: usize>(
    data: &Data<'_, N>,
    nominal: &Model<N>,
    refitted: &Scored<N>,
    corrected: &Scored<N>,
    found: &[Found],
) -> Judged {
    let OutcomeKnobs { least_closed, inadequate, inadequate_parameters, .. } = data.knobs.outcome;
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
    let by_error = (after / least - 1.0) / (most - 1.0);
    let excess = Excess::of(data, corrected);
    // a group beside the totals is judged by its error alone
    let left = if beside.is_some() {
        Left::Unclear
    } else {
        excess.left(found, || Excess::of(data, refitted), &data.knobs.outcome)
    };
    let inadequate = match left {
        Left::Noise => by_error.min(0.0),
        Left::Unclear => by_error,
        Left::MoreThanNoise => by_error.max(1.0),
    };
    let adequate = inadequate <= 1.0 && left != Left::MoreThanNoise;
    let outcome = match (found.is_empty(), adequate) {
        (true, true) => Outcome::NoGap,
        (false, true) => Outcome::Explained,
        (false, false) if left == Left::Unclear && !parameters_only && closed >= least_closed => Outcome::Explained,
        (_, false) => Outcome::Unknown,
    };
    Judged { outcome, beside, closed, inadequate, excess: excess.largest() }
}

/// What a model leaves, by its excess.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Left {
    /// No more than noise, in every group.
    Noise,
    /// More than noise, but not so much that it could be nothing else.
    Unclear,
    /// What is no noise, in a group at least.
    MoreThanNoise,
}

/// What a model leaves of all runs, as multiples of what noise alone would.
struct Excess(PerGroup<Option<f64>>);

impl Excess {
    fn of<const N: usize>(data: &Data<'_, N>, model: &Scored<N>) -> Self {
        let runs: Vec<&AlignedRun<N>> = data.fit.iter().chain(&data.held).copied().collect();
        Self(excess(&model.fit.model.plant(), &runs, data.knobs.measure.horizon_s))
    }

    /// What is left, of the groups in the totals.
    fn in_totals(&self) -> impl Iterator<Item = (SignalGroup, f64)> + '_ {
        let groups = SignalGroup::ALL.into_iter().filter(|group| group.in_totals());
        groups.filter_map(|group| Some((group, self.0[group as usize]?)))
    }

    fn largest(&self) -> Option<f64> {
        self.in_totals().map(|(_, excess)| excess).reduce(f64::max)
    }

    /// What is left by a model with the causes found, with that of the plain one where there are any.
    fn left(&self, found: &[Found], plain: impl FnOnce() -> Self, knobs: &OutcomeKnobs) -> Left {
        let over = |most: f64| self.in_totals().filter(move |(_, excess)| *excess > most).map(|(group, _)| group);
        if over(knobs.like_noise).next().is_none() {
            return Left::Noise;
        }
        let no_noise = match found {
            [] => over(knobs.unlike_noise).next().is_some(),
            found if found.iter().all(Found::is_parameter) => over(knobs.unlike_noise_parameters).next().is_some(),
            _ => {
                // asked for by a group that leaves more than noise alone
                let plain = LazyCell::new(plain);
                over(knobs.unlike_noise).any(|group| self.share_of(&plain, group) > knobs.still_there)
            }
        };
        if no_noise { Left::MoreThanNoise } else { Left::Unclear }
    }

    /// The share that this is of what a group shows beyond noise by another model [1]: one where that shows nothing.
    fn share_of(&self, other: &Self, group: SignalGroup) -> f64 {
        let beyond = |of: &Self| of.0[group as usize].map_or(0.0, |r| (r * r - 1.0).max(0.0));
        let all = beyond(other);
        if all > 0.0 { (beyond(self) / all).min(1.0) } else { 1.0 }
    }
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
