//! # A channel: one signal over the rows of a run
//!
//! A column of numbers in which every hole has a reason; it never shows a NaN.

use std::borrow::Cow;

/// Why a sample is missing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, schemars::JsonSchema, serde::Serialize)]
pub enum Missing {
    /// The field was left empty: nothing was measured on this row.
    Blank,
    /// A sample was due and never arrived, or was not a number.
    Lost,
    /// The sensor was at its limit.
    Saturated,
    /// The sensor repeated an old value.
    Stale,
    /// The telegram failed its checksum.
    BadCrc,
    /// The row is an instant of another clock of the run: nothing was due.
    NotDue,
    /// The wheel's bridge was open, or was opened within the row: no voltage was applied throughout.
    Open,
    /// A number was there, and it jumped away from its neighbours and back: it was set aside.
    Outlier,
}

const REASONS: [Missing; 8] = [
    Missing::Blank,
    Missing::Lost,
    Missing::Saturated,
    Missing::Stale,
    Missing::BadCrc,
    Missing::NotDue,
    Missing::Open,
    Missing::Outlier,
];

/// One signal over the rows of a run. Values are finite; a hole has a reason.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Channel {
    values: Vec<f64>,
    // 0 = present, 1.. = index into REASONS plus one; empty while there is no hole at all
    holes: Vec<u8>,
}

impl Channel {
    /// An empty channel with room for `rows`.
    pub fn with_capacity(rows: usize) -> Channel {
        Channel { values: Vec::with_capacity(rows), holes: Vec::new() }
    }

    /// A channel of numbers in SI units; one that is not finite becomes a hole, [`Missing::Lost`].
    pub fn from_values(values: impl IntoIterator<Item = f64>) -> Channel {
        values.into_iter().map(Ok).collect()
    }

    /// Adds a sample in SI units. A number that is not finite is recorded as [`Missing::Lost`].
    pub fn push(&mut self, value: f64) {
        if !value.is_finite() {
            return self.push_missing(Missing::Lost);
        }
        self.values.push(value);
        if !self.holes.is_empty() {
            self.holes.push(0);
        }
    }

    /// Adds a hole.
    pub fn push_missing(&mut self, reason: Missing) {
        if self.holes.is_empty() {
            self.holes.reserve(self.values.capacity());
            self.holes.resize(self.values.len(), 0);
        }
        self.values.push(0.0);
        self.holes.push(reason as u8 + 1);
    }

    /// The sample on `row`, in SI units, or why there is none.
    ///
    /// # Panics
    /// Where the channel has no such row.
    #[inline]
    pub fn get(&self, row: usize) -> std::result::Result<f64, Missing> {
        match self.holes.get(row) {
            None | Some(0) => Ok(self.values[row]),
            Some(&code) => Err(REASONS[usize::from(code) - 1]),
        }
    }

    /// Whether a sample was due on `row`: whether the row is one of the clock that the channel was recorded by.
    #[inline]
    pub fn is_due(&self, row: usize) -> bool {
        self.holes.get(row).is_none_or(|&code| code != Missing::NotDue as u8 + 1)
    }

    /// The same signal held: what was true on the last row on which it was due stays true until the next.
    pub fn held(&self) -> Cow<'_, Channel> {
        if (0..self.len()).all(|row| self.is_due(row)) {
            return Cow::Borrowed(self);
        }
        let mut last = Err(Missing::NotDue);
        let hold = |row| {
            last = if self.is_due(row) { self.get(row) } else { last };
            last
        };
        Cow::Owned((0..self.len()).map(hold).collect())
    }

    /// How many rows it has, holes included.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Whether it has no rows.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Whether no row has a sample.
    pub fn is_blank(&self) -> bool {
        self.present().next().is_none()
    }

    /// Whether every row has a sample.
    pub fn is_whole(&self) -> bool {
        self.holes.iter().all(|&code| code == 0)
    }

    /// The samples that are there: row and value.
    pub fn present(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.values
            .iter()
            .enumerate()
            .filter(|(row, _)| self.holes.get(*row).is_none_or(|&c| c == 0))
            .map(|(r, &v)| (r, v))
    }

    /// All rows in order.
    pub fn iter(&self) -> impl Iterator<Item = std::result::Result<f64, Missing>> + '_ {
        (0..self.len()).map(|row| self.get(row))
    }

    /// The same channel with each sample changed by `f(row, value)`; holes stay.
    pub fn map(&self, mut f: impl FnMut(usize, f64) -> f64) -> Channel {
        self.iter().enumerate().map(|(row, sample)| sample.map(|value| f(row, value))).collect()
    }

    /// Takes 2π jumps out of a heading in radians.
    ///
    /// A heading that stays within one turn (and 1 rad for noise) is taken as wrapped: a step of more than half a turn
    /// is a wrap. One that spans more was never wrapped, and is left as it is.
    pub fn unwrapped(&self) -> Channel {
        use std::f64::consts::{PI, TAU};
        let (low, high) = self.present().fold((f64::MAX, f64::MIN), |(l, h), (_, v)| (l.min(v), h.max(v)));
        if high - low < PI || high - low > TAU + 1.0 {
            return self.clone();
        }
        let mut last = None;
        self.map(|_, value| {
            let value = last.map_or(value, |before: f64| value - TAU * ((value - before) / TAU).round());
            last = Some(value);
            value
        })
    }
}

impl FromIterator<std::result::Result<f64, Missing>> for Channel {
    fn from_iter<I: IntoIterator<Item = std::result::Result<f64, Missing>>>(samples: I) -> Channel {
        let samples = samples.into_iter();
        let mut channel = Channel::with_capacity(samples.size_hint().0);
        for sample in samples {
            match sample {
                Ok(value) => channel.push(value),
                Err(reason) => channel.push_missing(reason),
            }
        }
        channel
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hole_keeps_its_reason_and_a_number_that_is_none_becomes_one() {
        let mut channel = Channel::from_values([1.0, f64::NAN]);
        channel.push_missing(Missing::BadCrc);
        channel.push(2.0);
        let all: Vec<_> = channel.iter().collect();
        assert_eq!(all, [Ok(1.0), Err(Missing::Lost), Err(Missing::BadCrc), Ok(2.0)]);
        assert_eq!(channel.present().collect::<Vec<_>>(), [(0, 1.0), (3, 2.0)]);
        assert!(!channel.is_whole() && !channel.is_blank());
    }

    #[test]
    fn a_signal_is_held_over_the_instants_of_another_clock_and_a_hole_of_its_own_with_it() {
        let samples = [Err(Missing::NotDue), Ok(1.0), Err(Missing::NotDue), Err(Missing::Lost), Err(Missing::NotDue)];
        let channel: Channel = samples.into_iter().collect();
        let due: Vec<bool> = (0..5).map(|row| channel.is_due(row)).collect();
        assert_eq!(due, [false, true, false, true, false]);
        let held: Vec<_> = channel.held().iter().collect();
        assert_eq!(held, [Err(Missing::NotDue), Ok(1.0), Ok(1.0), Err(Missing::Lost), Err(Missing::Lost)]);
    }

    #[test]
    fn a_wrapped_heading_is_unwrapped_across_a_hole() {
        let mut channel = Channel::from_values([3.0]);
        channel.push_missing(Missing::Blank);
        channel.push(-3.1);
        let after = channel.unwrapped().get(2).unwrap();
        assert!((after - (std::f64::consts::TAU - 3.1)).abs() < 1e-12);
    }

    #[test]
    fn a_heading_of_many_turns_is_left_alone() {
        let channel = Channel::from_values([0.0, 4.0, 8.0, 12.0]);
        assert_eq!(channel.unwrapped(), channel);
    }
}
