//! Spells: stretches of time in which something is out of order, drawn from a seed.

use crate::drawn::Drawn;

/// After this the same ones come again [s]
const PERIOD: f64 = 120.0;

/// When each begins and ends [s], in order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spells(Vec<(f64, f64)>);

impl Spells {
    /// Which last between some times [s] and leave between some times [s] free.
    pub fn drawn(lasting: (f64, f64), free: (f64, f64), seed: u64) -> Self {
        let (mut drawn, mut time, mut spells) = (Drawn::new(seed), 0.0, Vec::new());
        while time < PERIOD {
            let from = time + drawn.between(free.0, free.1);
            time = from + drawn.between(lasting.0, lasting.1);
            spells.push((from, time));
        }
        Self(spells)
    }

    /// Whether there is one at a time [s].
    pub fn covers(&self, time: f64) -> bool {
        let time = time.rem_euclid(PERIOD);
        let begun = self.0.partition_point(|(from, _)| *from <= time);
        begun > 0 && time < self.0[begun - 1].1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_cover_as_much_of_the_time_as_they_last_on_average() {
        let spells = Spells::drawn((0.1, 0.3), (0.5, 1.1), 5);
        let count = (0..1_200_000).filter(|k| spells.covers(1e-4 * f64::from(*k))).count();
        // 0.2 of 1.0, over 120 spells whose shares scatter by about 0.06 each
        assert!((count as f64 / 1.2e6 - 0.2).abs() < 4.0 * 0.06 / 120.0_f64.sqrt(), "{count}");
        assert_eq!((0..100).filter(|k| Spells::default().covers(f64::from(*k))).count(), 0);
    }

    #[test]
    fn they_begin_after_a_free_time_and_end_within_what_they_last() {
        let spells = Spells::drawn((0.1, 0.3), (0.5, 1.1), 8);
        assert!(!spells.covers(0.0) && !spells.covers(0.499));
        let first = (0..20_000).map(|k| 1e-4 * f64::from(k)).find(|time| spells.covers(*time)).expect("a spell");
        assert!(first <= 1.1 && !spells.covers(first + 0.3));
    }
}
