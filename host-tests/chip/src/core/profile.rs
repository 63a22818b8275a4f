//! # Profile: how long each exception took at the most
//!
//! From its entry to its return, what interrupted it taken off.

use std::collections::BTreeMap;

/// How long something took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Spent {
    /// Core cycles
    pub cycles: u64,
    /// Instructions
    pub instructions: u64,
}

impl Spent {
    fn since(self, before: Self) -> Self {
        Self { cycles: self.cycles - before.cycles, instructions: self.instructions - before.instructions }
    }
}

/// An exception that has begun.
#[derive(Clone, Copy, Debug)]
struct Begun {
    number: u16,
    at: Spent,
    /// What interrupted it
    others: Spent,
}

/// Exceptions that have begun, and how long each took at the most.
#[derive(Clone, Debug, Default)]
pub struct Profile {
    begun: Vec<Begun>,
    /// The longest, by the number in the vector table
    pub longest: BTreeMap<u16, Spent>,
}

impl Profile {
    /// One begins.
    pub(super) fn enter(&mut self, number: u16, now: Spent) {
        self.begun.push(Begun { number, at: now, others: Spent::default() });
    }

    /// The one that began last ends.
    pub(super) fn leave(&mut self, now: Spent) {
        let Some(Begun { number, at, others }) = self.begun.pop() else { return };
        let whole = now.since(at);
        let longest = self.longest.entry(number).or_default();
        *longest = (*longest).max(whole.since(others));
        if let Some(below) = self.begun.last_mut() {
            below.others.cycles += whole.cycles;
            below.others.instructions += whole.instructions;
        }
    }

    /// What has begun never ends: the chip is reset.
    pub(super) fn reset(&mut self) {
        self.begun.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(cycles: u64) -> Spent {
        Spent { cycles, instructions: cycles / 2 }
    }

    #[test]
    fn what_interrupts_is_taken_off_and_the_longest_is_kept() {
        let mut profile = Profile::default();
        profile.enter(22, at(100));
        profile.enter(34, at(150));
        profile.leave(at(250));
        profile.leave(at(300));
        profile.enter(34, at(400));
        profile.leave(at(440));
        assert_eq!(profile.longest, BTreeMap::from([(22, at(100)), (34, at(100))]));
    }
}
