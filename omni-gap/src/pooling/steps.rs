//! A step of a cause between two sets of sessions of one robot, whatever is otherwise so of it.
//!
//! ```text
//! before: x = (a; ln f)        after: x + d·e        d: the step, e: the place's own coordinate
//! ```

use super::evidence::SessionEvidence;
use super::place::Place;
use super::population::Stated;
use super::quadratic::Quadratic;

/// The step and its standard error; none where the sessions do not tell it.
pub(super) fn step(
    place: &Place,
    before: &[&SessionEvidence],
    after: &[&SessionEvidence],
    stated: &Stated,
) -> Option<(f64, f64)> {
    let n = place.coordinates();
    // the step stands first, then the place's own coordinates
    let plain: Vec<Vec<usize>> = (0..n).map(|k| vec![1 + k]).collect();
    let mut stepped = plain.clone();
    stepped[place.coordinate()].push(0);
    let mut all = Quadratic::nothing(n + 1);
    for (sessions, places) in [(before, &plain), (after, &stepped)] {
        for seen in sessions.iter().filter_map(|session| place.seen_in(session)) {
            all.add_at(&seen, &places.iter().map(Vec::as_slice).collect::<Vec<_>>());
        }
    }
    let held = Quadratic { hess: stated.whole(place)?, ..Quadratic::nothing(n) };
    all.add_at(&held, &plain.iter().map(Vec::as_slice).collect::<Vec<_>>());
    all.estimate(0)
}
