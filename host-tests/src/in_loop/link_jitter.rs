//! # Link jitter: commands that are late, each by another time
//!
//! ```text
//! arrives = max(sent + u, arrival of the one before),   u ~ U(0, most)
//! ```
//!
//! As on a radio whose packets wait for their slot, or a bus that others use too. Nothing is lost and nothing overtakes.

use std::collections::VecDeque;

use model_core::link::command::Command;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Commands on their way.
#[derive(Clone, Debug)]
pub struct LinkJitter {
    most: u32,
    rng: ChaCha8Rng,
    /// Period in which it arrives, and what
    waiting: VecDeque<(u32, Command<'static>)>,
}

impl LinkJitter {
    /// Commands are late by up to so many periods.
    pub fn new(most: u32, seed: u64) -> Self {
        Self { most, rng: ChaCha8Rng::seed_from_u64(seed), waiting: VecDeque::new() }
    }

    /// A command is sent in a period.
    pub fn send(&mut self, now: u32, command: Command<'static>) {
        let before = self.waiting.back().map_or(0, |(due, _)| *due);
        let due = before.max(now + self.rng.random_range(0..=self.most));
        self.waiting.push_back((due, command));
    }

    /// The commands that have arrived by a period.
    pub fn due(&mut self, now: u32) -> impl Iterator<Item = Command<'static>> {
        let arrived = self.waiting.iter().take_while(|(due, _)| *due <= now).count();
        self.waiting.drain(..arrived).map(|(_, command)| command)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use model_core::geometry::frames::BodyTwist;

    #[test]
    fn commands_arrive_in_their_order_within_the_most_and_spread_over_it() {
        let mut jitter = LinkJitter::new(100, 1);
        let mut lates = Vec::new();
        for now in 0..40_000 {
            if now % 200 == 0 {
                jitter.send(now, Command::Drive { sequence: (now / 200) as u16, twist: BodyTwist::default() });
            }
            for command in jitter.due(now) {
                let Command::Drive { sequence, .. } = command else { panic!("{command:?}") };
                assert_eq!(usize::from(sequence), lates.len());
                lates.push(now - 200 * u32::from(sequence));
            }
        }
        assert_eq!(lates.len(), 200);
        assert!(lates.iter().all(|late| *late <= 100));
        let mean = f64::from(lates.iter().sum::<u32>()) / 200.0;
        // 50, less or more by four times 29/√200
        assert!((mean - 50.0).abs() < 8.2, "{mean}");
    }
}
