//! All that the sessions of a kind tell together.

use super::answer::Pooled;
use super::changes::changes;
use super::common::{common_causes, of_numbers};
use super::contrasts::contrasts;
use super::evidence::SessionEvidence;
use super::knobs::PoolingKnobs;
use super::place::{Place, matrix};
use super::population::Stated;
use super::robots::{Robots, estimates};

/// Pools the sessions of robots of one kind, whose robot file states the same of all.
pub fn pooled(sessions: &[&SessionEvidence], knobs: &PoolingKnobs) -> Pooled {
    let robots = Robots::of(sessions);
    let numbers = of_numbers(&robots);
    let first = robots.all().flatten().find_map(|session| session.equations.as_ref());
    let stated = first.and_then(|round| Stated::of(&numbers, &matrix(&round.stated), &knobs.in_common));
    let Some(stated) = stated else { return Pooled { robots: robots.count(), ..Pooled::default() } };
    let places = Place::all(sessions);
    Pooled {
        robots: robots.count(),
        in_common: Some(stated.in_common),
        common: common_causes(&places, &robots, &stated, knobs),
        estimates: estimates(&places, &robots, &stated, knobs),
        changes: changes(&places, &robots, &stated, knobs),
        contrasts: contrasts(&places, &robots, &stated, knobs),
    }
}
