//! A step of a cause between two sets of sessions of one robot, whatever is otherwise so of it.
//!
//! ```text
//! before: x = (a; ln f)        after: x + d·e        d: the step, e: the place's own coordinate
//! ```

use super::place::Place;
use super::population::Stated;
use super::quadratic::Quadratic;

/// The step and its standard error, of what the sessions before and those after say together; none where they do not tell it.
pub(super) fn step(place: &Place, before: &Quadratic, after: &Quadratic, stated: &Stated) -> Option<(f64, f64)> {
    let n = place.coordinates();
    // the step stands first, then the place's own coordinates
    let plain: Vec<Vec<usize>> = (0..n).map(|k| vec![1 + k]).collect();
    let mut stepped = plain.clone();
    stepped[place.coordinate()].push(0);
    let mut all = Quadratic::nothing(n + 1);
    for (seen, places) in [(before, &plain), (after, &stepped), (&stated.of_file(place), &plain)] {
        all.add_at(seen, &places.iter().map(Vec::as_slice).collect::<Vec<_>>());
    }
    all.estimate(0)
}
