//! From what size on an effect moves recordings by so much: looked for at that size, since few effects are straight lines.

use model_core::effects::card::Role;

use super::laid::Laid;
use super::suspects::Column;
use super::view::View;
use crate::engine::knobs::SelftestKnobs;
use crate::simulate::EffectInstance;

/// The multiple of an effect's typical departure from which on its |s⊥|² is `needed` [σ²]; none where it is not within its
/// bounds. `typical` is |s⊥|² at the typical size, in the view.
pub(super) fn size_needed<const N: usize>(
    laid: &Laid<'_, N>,
    effect: &EffectInstance,
    view: &View,
    (typical, needed): (f64, f64),
    knobs: &SelftestKnobs,
) -> Option<f64> {
    let size_at = |times: f64| {
        let scaled = Column::Effect(scaled(effect, times));
        laid.left(&[scaled], std::slice::from_ref(view))[0].size_of(0)
    };
    let above = |size: f64| 0.5 * (size.max(knobs.least_size) / needed).ln();
    let first = Tried { log_times: 0.0, above: above(typical), power: 1.0 };
    let found = searched(first, bounds(effect, knobs.least_times), |times| above(size_at(times)), knobs)?;
    Some(found.log_times.exp())
}

/// The multiple of its typical share from which on something that shows each time happens often enough to be sure of.
///
/// ```text
/// k windows that all say the same, of many that say nothing:  k > z·√k        z: standard errors that are sure
/// ```
pub(super) fn often_enough<const N: usize>(laid: &Laid<'_, N>, effect: &EffectInstance, knobs: &SelftestKnobs) -> f64 {
    let events = knobs.engine.search.tie_errors.powi(2);
    let share = effect.params.first().copied().unwrap_or_default();
    events / (share * laid.telegrams_told(effect.wheel) as f64)
}

/// A multiple that is within an effect's bounds, if it is no more than the largest.
pub(super) fn within_bounds(times: f64, effect: &EffectInstance, knobs: &SelftestKnobs) -> Option<f64> {
    let (low, high) = bounds(effect, knobs.least_times);
    (times.ln() <= high).then(|| times.max(low.exp()))
}

/// A size that was tried.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tried {
    /// The logarithm of its multiple of the typical departure.
    pub log_times: f64,
    /// The logarithm of how far what it does is above what is needed.
    pub above: f64,
    /// The power of the size that what it does is taken for there.
    pub power: f64,
}

/// Searches the size that does what is needed, between two logarithms of its multiple; none where there is none.
///
/// Between two tries what it does is taken for a power of the size: of most effects the first, of a coefficient of friction,
/// which shows the more the smaller it is, a negative one. An effect that is seen at its bound is seen from there on.
pub(super) fn searched(
    first: Tried,
    bounds: (f64, f64),
    above: impl Fn(f64) -> f64,
    knobs: &SelftestKnobs,
) -> Option<Tried> {
    let mut here = first;
    // the nearest tries on both sides
    let (mut seen, mut unseen): (Option<Tried>, Option<Tried>) = (None, None);
    for try_ in 0..knobs.tries {
        *(if here.above >= 0.0 { &mut seen } else { &mut unseen }) = Some(here);
        if here.above.abs() <= knobs.near.ln() {
            return Some(here);
        }
        let most = if try_ == 0 { knobs.first_try } else { knobs.most_a_try };
        let step = (-here.above / here.power).clamp(-most.ln(), most.ln());
        let between = seen.zip(unseen).map(|(a, b)| (a.log_times, b.log_times));
        let next = match between {
            // between the two, if the power leads out of them
            Some((a, b)) if !(a.min(b)..a.max(b)).contains(&(here.log_times + step)) => 0.5 * (a + b),
            _ => (here.log_times + step).clamp(bounds.0, bounds.1),
        };
        if next == here.log_times {
            // at the bound
            return (here.above >= 0.0).then_some(here);
        }
        let there = above(next.exp());
        let found = (there - here.above) / (next - here.log_times);
        let power = if found.abs() > knobs.least_power { found } else { here.power };
        here = Tried { log_times: next, above: there, power };
    }
    seen
}

/// The logarithms of the multiples, `least_times` or more, between which all sizes are within their bounds.
pub(super) fn bounds(effect: &EffectInstance, least_times: f64) -> (f64, f64) {
    let mut bounds = (least_times.ln(), f64::MAX.ln());
    for (p, x) in effect.card().params.iter().zip(&effect.params).filter(|(p, _)| p.role == Role::Size) {
        let times = [p.within.0, p.within.1].map(|bound| ((bound - p.absent) / (x - p.absent)).max(0.0));
        let (low, high) = (times[0].min(times[1]), times[0].max(times[1]));
        bounds = (bounds.0.max(low.ln()), bounds.1.min(high.ln()));
    }
    bounds
}

/// The effect with its sizes at a multiple of their departure from absent.
pub(super) fn scaled(effect: &EffectInstance, times: f64) -> EffectInstance {
    let mut scaled = effect.clone();
    for (p, x) in effect.card().params.iter().zip(&mut scaled.params).filter(|(p, _)| p.role == Role::Size) {
        *x = (p.absent + times * (*x - p.absent)).clamp(p.within.0, p.within.1);
    }
    scaled
}
