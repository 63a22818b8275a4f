//! How far predictions miss what was measured, channel by channel.

use crate::simulate::Row;

/// Σ error² of some numbers, by the channels that they belong to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Misfit {
    /// Σ error² of each channel [σ²]
    pub by_channel: Row,
    /// How many numbers were compared.
    pub numbers: usize,
}

impl Misfit {
    /// Σ error² of all channels [σ²]
    pub fn cost(&self) -> f64 {
        self.by_channel.iter().sum()
    }

    /// Adds a number that was missed by so much [σ].
    #[inline]
    pub fn add(&mut self, channel: usize, error: f64) {
        self.by_channel[channel] += error * error;
        self.numbers += 1;
    }

    /// Of the numbers of both.
    #[must_use]
    pub fn and(mut self, other: Self) -> Self {
        for (sum, more) in self.by_channel.iter_mut().zip(other.by_channel) {
            *sum += more;
        }
        self.numbers += other.numbers;
        self
    }
}
