//! # Nominal parameters: the numbers of a robot file that can be plainly wrong
//!
//! Beside the effects that a simulator lacks, a gap can come from a number that it has wrong. Each such cause is a
//! [`NominalCard`]: what it is, how it is measured, which numbers of the robot file say it, how sure these are where the
//! file is silent, where a fit of them begins where the file says zero. Several numbers of one kind are one cause: the
//! viscous friction of the three body axes is one, and a diagnosis says on which.
//!
//! A re-fit multiplies the robot by factors, one for each number: those of [`Nominal`], in the order of the cards.

use crate::plant::robot::Nominal;

mod card;
pub use card::{NominalCard, Number, Table};

pub mod body;

pub mod friction;

pub mod motor;

pub mod wheels;

/// Every nominal parameter that can be a cause. Its numbers, one after the other, are those of [`Nominal::ALL`].
pub const NOMINAL: [&NominalCard; 9] = [
    &body::MASS,
    &body::INERTIA,
    &motor::RESISTANCE,
    &motor::TORQUE_CONSTANT,
    &motor::KT_OVER_KV,
    &friction::VISCOUS,
    &friction::COULOMB,
    &wheels::RADIUS,
    &wheels::CENTER_DISTANCE,
];

/// Every nominal number with the card of its cause, in the order of [`Nominal::ALL`].
const NUMBERED: [(&NominalCard, &Number); Nominal::COUNT] = {
    let mut all = [(NOMINAL[0], &NOMINAL[0].numbers[0]); Nominal::COUNT];
    let (mut count, mut card) = (0, 0);
    while card < NOMINAL.len() {
        let numbers = NOMINAL[card].numbers;
        let mut k = 0;
        while k < numbers.len() {
            assert!(numbers[k].own() as usize == count, "numbers stand in the order of their factors");
            all[count] = (NOMINAL[card], &numbers[k]);
            count += 1;
            k += 1;
        }
        card += 1;
    }
    assert!(count == Nominal::COUNT, "every factor has its number");
    all
};

/// Every nominal number, in the order of the robot file: table by table, line by line.
pub const IN_THE_FILE: [&Number; Nominal::COUNT] = {
    let mut all = [NUMBERED[0].1; Nominal::COUNT];
    let mut k = 0;
    while k < all.len() {
        // sorted in: what comes later in the file moves up
        let number = NUMBERED[k].1;
        let mut at = k;
        while at > 0 && number.place() < all[at - 1].place() {
            all[at] = all[at - 1];
            at -= 1;
        }
        all[at] = number;
        k += 1;
    }
    all
};

/// Every nominal number, in the order of [`Nominal::ALL`].
pub fn numbers() -> impl Iterator<Item = &'static Number> {
    NUMBERED.into_iter().map(|(_, number)| number)
}

impl Nominal {
    /// Its number in the robot file.
    pub const fn number(self) -> &'static Number {
        NUMBERED[self as usize].1
    }

    /// The page of its cause.
    pub const fn card(self) -> &'static NominalCard {
        NUMBERED[self as usize].0
    }

    /// The cause that a report names for it.
    pub const fn cause(self) -> &'static str {
        self.card().id
    }

    /// The body axis (v, vn, ω: 0, 1, 2) that a friction belongs to.
    pub const fn axis(self) -> Option<usize> {
        self.number().axis
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_factor_has_its_number_and_every_number_one_place_in_the_file() {
        for (k, (nominal, number)) in Nominal::ALL.into_iter().zip(numbers()).enumerate() {
            assert_eq!((nominal as usize, number.own(), nominal.number().key), (k, nominal, number.key));
            assert!(nominal.card().numbers.iter().any(|n| n.key == number.key));
            assert_eq!(numbers().filter(|n| n.key == number.key).count(), 1, "{}", number.key);
            assert_eq!(numbers().filter(|n| n.place() == number.place()).count(), 1, "{}", number.key);
            // the factors before its own are those of numbers that move with it
            assert!(number.factors.iter().all(|p| p.number().table == number.table));
        }
        assert!(IN_THE_FILE.windows(2).all(|pair| pair[0].place() < pair[1].place()));
    }

    #[test]
    fn a_card_says_all_that_a_person_asks() {
        for card in NOMINAL {
            for sentence in [card.summary, card.measured_by] {
                assert!(sentence.ends_with('.') && sentence.len() > 20, "{}: {sentence}", card.id);
            }
            for words in [card.title, card.settled_by] {
                assert!(!words.is_empty() && !words.ends_with('.'), "{}: {words}", card.id);
            }
            assert_eq!(NOMINAL.iter().filter(|other| other.id == card.id).count(), 1, "{}", card.id);
            let axes: [usize; 3] = core::array::from_fn(|a| card.numbers.iter().filter(|n| n.axis == Some(a)).count());
            assert!(axes == [0; 3] || axes == [1; 3] && card.numbers.len() == 3, "{}: {axes:?}", card.id);
        }
    }

    #[test]
    fn what_may_be_zero_has_a_first_guess_that_a_robot_accepts() {
        for number in numbers() {
            let (low, high) = number.within;
            assert!(low < high && (0.001..1.0).contains(&number.relative_uncertainty), "{}", number.key);
            assert_eq!(low == 0.0, number.first_guess.is_some(), "{}", number.key);
            if let Some(guess) = number.first_guess {
                let guess = guess(2.34, 0.089);
                assert!(guess > low && guess < high, "{}: {guess}", number.key);
            }
        }
    }
}
