//! The angles of all tables, pair by pair, and what the cards say of look-alikes.

use std::collections::{BTreeMap, BTreeSet};

use model_core::effects::EffectKind;
use omni_gap::api::Confusion;

/// Two causes, in the order of the alphabet.
pub type Pair = (&'static str, &'static str);

/// A pair in that order.
pub fn pair(a: &'static str, b: &'static str) -> Pair {
    if a < b { (a, b) } else { (b, a) }
}

/// The angle of every pair of causes [rad]: the smaller one of the two that each has to the other. An angle counts only
/// where its cause is seen at its typical size.
pub fn angles(confusion: &Confusion) -> BTreeMap<Pair, f64> {
    let mut angles = BTreeMap::new();
    for cause in confusion.causes.iter().filter(|cause| cause.seen) {
        for other in &cause.others {
            let nearest = angles.entry(pair(cause.cause, other.cause)).or_insert(f64::INFINITY);
            *nearest = other.angle_rad.min(*nearest);
        }
    }
    angles
}

/// The same over several: the smallest of each pair.
pub fn smallest<'a>(all: impl IntoIterator<Item = &'a Confusion>) -> BTreeMap<Pair, f64> {
    let mut smallest = BTreeMap::new();
    for (pair, angle) in all.into_iter().flat_map(angles) {
        let nearest = smallest.entry(pair).or_insert(f64::INFINITY);
        *nearest = angle.min(*nearest);
    }
    smallest
}

/// The pairs of causes that cards state as look-alikes.
pub fn stated() -> BTreeSet<Pair> {
    let cards = EffectKind::ALL.iter().map(|effect| effect.card());
    cards.flat_map(|card| card.look_alikes.iter().map(|like| pair(card.id, like.with))).collect()
}

/// How many of a pair are numbers of the robot file, and no effects.
pub fn numbers_in((a, b): &Pair) -> usize {
    [a, b].iter().filter(|id| EffectKind::find(id).is_none()).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use omni_gap::engine::findings::{ConfusedCause, Rival};
    use omni_gap::report::Kind;

    fn cause(cause: &'static str, seen: bool, others: &[(&'static str, f64)]) -> ConfusedCause {
        let other = |(cause, angle_rad): &(&'static str, f64)| Rival {
            cause,
            axis: None,
            angle_rad: *angle_rad,
            told_times: None,
        };
        let others = others.iter().map(other).collect();
        ConfusedCause { cause, kind: Kind::Effect, wheel: None, axis: None, sigma: 1.0, seen, others }
    }

    #[test]
    fn a_pair_has_its_smaller_angle_of_causes_that_are_seen() {
        let causes = vec![
            cause("b", true, &[("a", 0.5), ("c", 0.9)]),
            cause("a", true, &[("b", 0.3), ("c", 0.8)]),
            cause("c", false, &[("a", 0.1), ("b", 0.1)]),
        ];
        let all = Confusion { robot: String::new(), logged: Vec::new(), numbers: 1, causes };
        let expected = BTreeMap::from([(("a", "b"), 0.3), (("a", "c"), 0.8), (("b", "c"), 0.9)]);
        assert_eq!(angles(&all), expected);
        assert_eq!(smallest([&all, &all]), expected);
    }

    #[test]
    fn look_alikes_are_stated_once_a_pair() {
        let stated = stated();
        assert!(stated.iter().all(|(a, b)| a < b && !stated.contains(&(*b, *a))));
        assert!(stated.contains(&("creep", "wheel_slip")) && stated.contains(&("dead_time", "resistance")));
    }
}
