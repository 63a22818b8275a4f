//! Commands on their way: a bridge hears what was sent some time ago.

use std::collections::VecDeque;

/// Two times that are no further apart are the same [s]: sums of steps round.
const ROUNDED: f64 = 1e-9;

/// What was sent and is not forgotten yet.
#[derive(Clone, Debug, Default)]
pub struct Commands {
    /// Since when [s], and what, in order.
    sent: VecDeque<(f64, Vec<f64>)>,
}

impl Commands {
    /// From a time on [s], later than all before; what nobody hears any more, `delay` [s] later, is forgotten.
    pub fn send(&mut self, time: f64, command: &[f64], delay: f64) {
        while self.sent.len() > 1 && self.sent[1].0 <= time - delay {
            self.sent.pop_front();
        }
        if self.sent.back().is_none_or(|(_, last)| last != command) {
            self.sent.push_back((time, command.to_vec()));
        }
    }

    /// The mean of what was sent between two times [s], for each motor; nothing, before the first command.
    pub fn mean(&self, (from, to): (f64, f64), out: &mut [f64]) {
        out.fill(0.0);
        for (k, (since, command)) in self.sent.iter().enumerate() {
            let until = self.sent.get(k + 1).map_or(f64::INFINITY, |(next, _)| *next);
            let part = (until.min(to) - since.max(from)) / (to - from);
            if part > 0.0 {
                out.iter_mut().zip(command).for_each(|(sum, u)| *sum += part * u);
            }
        }
    }

    /// What was sent last up to a time [s].
    pub fn at(&self, time: f64, out: &mut [f64]) {
        match self.sent.iter().rev().find(|(since, _)| *since <= time + ROUNDED) {
            Some((_, command)) => out.copy_from_slice(command),
            None => out.fill(0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mean_over_a_change_has_both_its_sides() {
        let (mut commands, mut out) = (Commands::default(), [0.0]);
        commands.send(1.0, &[4.0], 10.0);
        commands.send(2.0, &[8.0], 10.0);
        let mut mean = |from, to| {
            commands.mean((from, to), &mut out);
            out[0]
        };
        assert_eq!(
            [mean(0.0, 1.0), mean(0.5, 1.5), mean(1.0, 2.0), mean(1.5, 2.5), mean(3.0, 4.0)],
            [0.0, 2.0, 4.0, 6.0, 8.0]
        );
    }

    #[test]
    fn what_is_on_its_way_is_not_forgotten() {
        let (mut commands, mut out) = (Commands::default(), [0.0]);
        for k in 0..100 {
            commands.send(f64::from(k), &[f64::from(k)], 3.5);
        }
        assert!(commands.sent.len() <= 6, "{}", commands.sent.len());
        commands.at(99.0 - 3.5, &mut out);
        assert_eq!(out, [95.0]);
        commands.at(-1.0, &mut out);
        assert_eq!(out, [0.0]);
    }
}
