//! A map of the floor: the force against the way the robot moves, place by place.

use std::collections::BTreeMap;

use super::bins::{Bin, Sample, clusters};
use super::model::Quantity;
use super::sampled::sample;
use super::settings::ShapeSettings;
use super::window::Window;

/// Cells of the floor with enough independent samples; `None` where there are fewer than two.
pub(super) fn floor(windows: &[Window], settings: &ShapeSettings) -> Option<Vec<Bin>> {
    let ends = |axis: usize| {
        let places = windows.iter().map(|window| window.when.pose[axis]);
        places.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
    };
    let [x, y] = [ends(0), ends(1)];
    let side = (x.1 - x.0).max(y.1 - y.0) / settings.cells as f64;
    if !side.is_finite() || side <= 0.0 {
        return None;
    }
    let mut cells: BTreeMap<(usize, usize), Vec<Sample>> = BTreeMap::new();
    for window in windows {
        let [at_x, at_y, _] = window.when.pose;
        let cell = (((at_x - x.0) / side) as usize, ((at_y - y.0) / side) as usize);
        cells.entry(cell).or_default().extend(sample(window, Some(at_x), (Quantity::Drag, 0)));
    }
    let bins: Vec<Bin> = cells
        .into_iter()
        .filter_map(|((column, row), mut samples)| {
            let from = |first: f64, at: usize| [first + side * at as f64, first + side * (at + 1) as f64];
            let enough = clusters(&mut samples) >= settings.fewest_independent;
            enough.then(|| Bin::of(&mut samples).between(from(x.0, column), from(y.0, row)))
        })
        .collect();
    (bins.len() > 1).then_some(bins)
}
