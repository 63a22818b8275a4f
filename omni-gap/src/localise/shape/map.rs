//! A map of the floor: the force against the way the robot moves, place by place.

use std::collections::BTreeMap;

use super::bins::{Bin, Sample, clusters};
use super::model::Quantity;
use super::sampled::sample;
use super::settings::ShapeSettings;
use super::window::Window;

/// A sample and where on the floor it was [m].
type Placed = ([f64; 2], Sample);

/// Cells of the floor with enough independent samples; `None` where there are fewer than two.
pub(super) fn floor(windows: &[Window], settings: &ShapeSettings) -> Option<Vec<Bin>> {
    let placed = |window: &Window| {
        let [x, y, _] = window.when.pose;
        sample(window, Some(x), (Quantity::Drag, 0)).map(|sample| ([x, y], sample))
    };
    cells(windows.iter().filter_map(placed).collect(), settings)
}

fn cells(all: Vec<Placed>, settings: &ShapeSettings) -> Option<Vec<Bin>> {
    let ends = |axis: usize| {
        let places = all.iter().map(|(place, _)| place[axis]);
        places.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
    };
    let [x, y] = [ends(0), ends(1)];
    let side = (x.1 - x.0).max(y.1 - y.0) / settings.cells as f64;
    if !side.is_finite() || side <= 0.0 {
        return None;
    }
    let mut cells: BTreeMap<[usize; 2], Vec<Sample>> = BTreeMap::new();
    for (place, sample) in all {
        let cell = [(place[0] - x.0) / side, (place[1] - y.0) / side].map(|at| (at as usize).min(settings.cells - 1));
        cells.entry(cell).or_default().push(sample);
    }
    let bins: Vec<Bin> = cells
        .into_iter()
        .filter_map(|([column, row], mut samples)| {
            let from = |first: f64, at: usize| [first + side * at as f64, first + side * (at + 1) as f64];
            let enough = clusters(&mut samples) >= settings.fewest_independent;
            enough.then(|| Bin::of(&mut samples).between(from(x.0, column), from(y.0, row)))
        })
        .collect();
    (bins.len() > 1).then_some(bins)
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::super::bins::Held;
    use super::super::window::MODELS;
    use super::*;

    /// Places all over a floor of 4 m by 2 m, with a force there and noise of 1 N.
    fn driven(force: impl Fn([f64; 2]) -> f64) -> Vec<Placed> {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let mut each = |cluster: usize| {
            let place = [4.0 * random.random::<f64>(), 2.0 * random.random::<f64>()];
            let noise = 12f64.sqrt() * (random.random::<f64>() - 0.5);
            (place, Sample { at: place[0], cluster, residual: [force(place) + noise; MODELS] })
        };
        (0..3000).map(&mut each).collect()
    }

    #[test]
    fn a_carpet_in_a_corner_is_where_it_lies() {
        let carpet = |[x, y]: [f64; 2]| x > 3.0 && y > 1.0;
        let bins = cells(driven(|place| if carpet(place) { 2.0 } else { 0.0 }), &ShapeSettings::default()).unwrap();
        assert!(Held::of_differences(&bins).chance < 1e-6);
        for bin in bins.iter().map(Bin::told) {
            let middle = [bin.at, bin.y.map_or(0.0, |[low, high]| 0.5 * (low + high))];
            assert_eq!(bin.nominal > 1.0, carpet(middle), "{bin:?}");
        }
    }

    #[test]
    fn what_is_the_same_everywhere_is_no_map() {
        let bins = cells(driven(|_| 2.0), &ShapeSettings::default()).unwrap();
        assert!(Held::of_differences(&bins).chance > 0.01, "{}", Held::of_differences(&bins).chance);
    }

    #[test]
    fn a_place_where_the_robot_has_hardly_been_is_left_out() {
        let mut driven = driven(|_| 0.0);
        driven.retain(|(place, sample)| place[0] < 2.0 || sample.cluster % 200 == 0);
        let bins = cells(driven, &ShapeSettings::default()).unwrap();
        assert!(bins.len() >= 15, "{}", bins.len());
        assert!(bins.iter().all(|bin| bin.told().low < 2.0), "{bins:#?}");
    }
}
