//! A curve: residuals over a feature in bins of equal counts, none too narrow and none with too few independent samples.

use std::collections::BTreeSet;

use super::bins::{Bin, Sample};
use super::settings::ShapeSettings;

/// The bins of a feature; `None` where the samples are too few for two, or all alike.
pub(super) fn curve(mut samples: Vec<Sample>, settings: &ShapeSettings) -> Option<Vec<Bin>> {
    samples.sort_by(|a, b| a.at.total_cmp(&b.at));
    let (first, last) = (samples.first()?.at, samples.last()?.at);
    let inner = |share: f64| samples[((samples.len() - 1) as f64 * share) as usize].at;
    let width = settings.least_width * (inner(0.99) - inner(0.01));
    if width <= 1e-6 * first.abs().max(last.abs()) {
        return None;
    }
    let full = samples.len().div_ceil(settings.bins);
    let mut bins: Vec<Vec<Sample>> = Vec::new();
    let (mut open, mut independent) = (Vec::<Sample>::new(), BTreeSet::new());
    for sample in samples {
        let wide = open.first().is_some_and(|first| sample.at - first.at >= width);
        if wide && open.len() >= full && independent.len() >= settings.fewest_independent {
            bins.push(std::mem::take(&mut open));
            independent.clear();
        }
        open.push(sample);
        independent.insert(sample.cluster);
    }
    let enough = 2 * open.len() >= full && independent.len() >= settings.fewest_independent;
    match bins.last_mut() {
        Some(last) if !enough => last.append(&mut open),
        _ => bins.push(open),
    }
    (bins.len() > 1).then(|| bins.iter_mut().map(|bin| Bin::of(bin)).collect())
}
