//! Which wheel is which: all orders and signs of the wheels, tried one by one.

use crate::log::permutations;

/// One guess: relation j holds for the channel `place[j]`, times `sign[j]`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Order {
    pub place: Vec<usize>,
    pub sign: Vec<f64>,
}

impl Order {
    pub fn is_as_given(&self) -> bool {
        self.changes() == 0
    }

    /// How many things went wrong: exchanges of two wheels, and signs, all signs at once being one.
    pub fn changes(&self) -> usize {
        let n = self.place.len();
        let mut seen = vec![false; n];
        let mut cycles = 0;
        for start in 0..n {
            cycles += usize::from(!seen[start]);
            let mut j = start;
            while !seen[j] {
                seen[j] = true;
                j = self.place[j];
            }
        }
        let flipped = self.sign.iter().filter(|sign| **sign < 0.0).count();
        (n - cycles) + if flipped == n { 1 } else { flipped }
    }

    pub fn changed(&self, wheel: usize) -> bool {
        self.place[wheel] != wheel || self.sign[wheel] < 0.0
    }

    pub fn moved(&self) -> bool {
        (0..self.place.len()).any(|j| self.place[j] != j)
    }

    /// In words: which channel is really which wheel.
    pub fn words(&self, stem: &str) -> String {
        let wheel = |j: usize| {
            let minus = if self.sign[j] < 0.0 { "minus " } else { "" };
            format!("{stem}{} is {minus}wheel {j}", self.place[j])
        };
        (0..self.place.len()).filter(|&j| self.changed(j)).map(wheel).collect::<Vec<_>>().join(", ")
    }
}

/// All orders and signs of `wheels` wheels, the given one first.
pub(super) fn all(wheels: usize) -> Vec<Order> {
    let signs = |place: &Vec<usize>| {
        let place = place.clone();
        (0..1u32 << wheels).map(move |bits| {
            let sign = (0..wheels).map(|j| if bits >> j & 1 == 1 { -1.0 } else { 1.0 }).collect();
            Order { place: place.clone(), sign }
        })
    };
    permutations(wheels).iter().flat_map(signs).collect()
}

/// The guess that explains best; among those nearly as good, the one that changes least, and moves rather than flips.
///
/// `slack` is a cost that does not matter.
pub(super) fn best<T: Clone>(guesses: &[(T, usize, bool, f64)], slack: f64) -> Option<(T, f64)> {
    let least = guesses.iter().map(|guess| guess.3).fold(f64::INFINITY, f64::min);
    let good = guesses.iter().filter(|guess| guess.3 <= 1.5 * least + slack);
    let simple = good.min_by(|a, b| (a.1, !a.2).cmp(&(b.1, !b.2)).then(a.3.total_cmp(&b.3)))?;
    Some((simple.0.clone(), simple.3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_are_as_many_orders_as_there_should_be_and_the_given_one_is_first() {
        assert_eq!((all(3).len(), all(4).len()), (48, 384));
        assert!(all(4)[0].is_as_given());
    }
}
