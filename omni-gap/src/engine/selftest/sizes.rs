//! From what size on an effect moves recordings by so much: looked for at that size, since few effects are straight lines.

use model_core::effects::card::Role;

use super::laid::Laid;
use super::suspects::Column;
use super::view::View;
use crate::engine::knobs::SelftestKnobs;
use crate::simulate::EffectInstance;

/// The multiple of an effect's typical departure from which on its |s⊥|² is `needed` [σ²]; none where it is not within its
/// bounds. `typical` is |s⊥|² at the typical size, in the view.
///
/// Between two tries |s⊥| is taken for a power of the size: of most effects the first, of a coefficient of friction, which
/// shows the more the smaller it is, a negative one. An effect that is seen at its bound is seen from there on.
pub(super) fn size_needed<const N: usize>(
    laid: &Laid<'_, N>,
    effect: &EffectInstance,
    view: &View,
    (typical, needed): (f64, f64),
    knobs: &SelftestKnobs,
) -> Option<f64> {
    let bounds = bounds(effect, knobs.least_times);
    let size_at = |times: f64| {
        let scaled = Column::Effect(scaled(effect, times));
        laid.left(&[scaled], std::slice::from_ref(view))[0].size_of(0).max(knobs.least_size)
    };
    // how far |s⊥| is above what is needed, over the size; both in logarithms
    let above = |size: f64| 0.5 * (size / needed).ln();
    let mut here = (0.0_f64, above(typical.max(knobs.least_size)));
    // the nearest tries on both sides
    let (mut seen, mut unseen) = (None, None);
    let mut power = 1.0;
    for try_ in 0..knobs.tries {
        *(if here.1 >= 0.0 { &mut seen } else { &mut unseen }) = Some(here.0);
        if here.1.abs() <= knobs.near.ln() {
            return Some(here.0.exp());
        }
        let most = if try_ == 0 { knobs.first_try } else { knobs.most_a_try };
        let step = (-here.1 / power).clamp(-most.ln(), most.ln());
        let next = match (seen, unseen) {
            // between the two, if the power leads out of them
            (Some(a), Some(b)) if !(a.min(b)..a.max(b)).contains(&(here.0 + step)) => 0.5 * (a + b),
            _ => (here.0 + step).clamp(bounds.0, bounds.1),
        };
        if next == here.0 {
            // at the bound
            return (here.1 >= 0.0).then_some(here.0.exp());
        }
        let there = (next, above(size_at(next.exp())));
        let found = (there.1 - here.1) / (there.0 - here.0);
        power = if found.abs() > knobs.least_power { found } else { power };
        here = there;
    }
    seen.map(f64::exp)
}

/// The logarithms of the multiples, `least_times` or more, between which all sizes are within their bounds.
fn bounds(effect: &EffectInstance, least_times: f64) -> (f64, f64) {
    let mut bounds = (least_times.ln(), f64::MAX.ln());
    for (p, x) in effect.card().params.iter().zip(&effect.params).filter(|(p, _)| p.role == Role::Size) {
        let times = [p.within.0, p.within.1].map(|bound| ((bound - p.absent) / (x - p.absent)).max(0.0));
        let (low, high) = (times[0].min(times[1]), times[0].max(times[1]));
        bounds = (bounds.0.max(low.ln()), bounds.1.min(high.ln()));
    }
    bounds
}

/// The effect with its sizes at a multiple of their departure from absent.
fn scaled(effect: &EffectInstance, times: f64) -> EffectInstance {
    let mut scaled = effect.clone();
    for (p, x) in effect.card().params.iter().zip(&mut scaled.params).filter(|(p, _)| p.role == Role::Size) {
        *x = (p.absent + times * (*x - p.absent)).clamp(p.within.0, p.within.1);
    }
    scaled
}
