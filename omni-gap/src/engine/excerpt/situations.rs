//! The situations that recordings meet: levels of signals, how fast they change, parts of the time.

use std::f64::consts::TAU;
use std::ops::Range;

use rayon::prelude::*;

use super::looked::{Looked, Signal};
use super::piece::Piece;
use crate::engine::knobs::ExcerptKnobs;

/// What there is to meet.
pub(super) struct Situations<'a> {
    runs: Vec<Looked<'a>>,
    knobs: &'a ExcerptKnobs,
    /// The ranges of each signal's value and of its change [1/s], by its name.
    signals: Vec<(String, [Range<f64>; 2])>,
    /// Rows of all runs before each.
    before: Vec<usize>,
    rows: usize,
}

impl<'a> Situations<'a> {
    /// Of recordings.
    pub fn of<T>(runs: &'a [T], knobs: &'a ExcerptKnobs) -> Self
    where
        Looked<'a>: From<&'a T>,
    {
        let runs: Vec<Looked> = runs.iter().map(Looked::from).collect();
        let mut rows = 0;
        let before = |run: &Looked| {
            rows += run.t_s.len();
            rows - run.t_s.len()
        };
        let before = runs.iter().map(before).collect();
        let mut names: Vec<String> = Vec::new();
        for Signal { name, .. } in runs.iter().flat_map(|run| &run.signals) {
            if !names.contains(name) {
                names.push(name.clone());
            }
        }
        let mut situations = Self { runs, knobs, signals: Vec::new(), before, rows };
        let ranges: Vec<_> = names.iter().map(|name| situations.ranges(name)).collect();
        situations.signals = names.into_iter().zip(ranges).collect();
        situations
    }

    /// How many there are.
    fn count(&self) -> usize {
        2 * self.signals.len() * self.bins() + self.knobs.ages
    }

    /// Bins of a value: the levels, and what is beyond them at either end.
    fn bins(&self) -> usize {
        self.knobs.levels + 2
    }

    /// The range of a signal, and of its change, a few looks at either end left out.
    fn ranges(&self, name: &str) -> [Range<f64>; 2] {
        let mut seen = [Vec::new(), Vec::new()];
        for run in &self.runs {
            let Some(signal) = run.signals.iter().find(|signal| signal.name == name) else { continue };
            self.look(run.t_s, signal, 0..run.t_s.len(), |level, change| {
                seen[0].push(level);
                seen[1].push(change);
            });
        }
        seen.map(|mut values| {
            values.sort_unstable_by(f64::total_cmp);
            let left_out = (values.len() as f64 * self.knobs.beyond) as usize;
            let inner = values.get(left_out).zip(values.len().checked_sub(left_out + 1).and_then(|k| values.get(k)));
            inner.map_or(0.0..0.0, |(low, high)| *low..*high)
        })
    }

    /// How often each of some pieces looks at each.
    pub fn looks_of(&self, pieces: &[Piece]) -> Vec<Vec<u32>> {
        pieces.par_iter().map(|piece| self.looks(piece)).collect()
    }

    /// How often a piece looks at each.
    pub fn looks(&self, piece: &Piece) -> Vec<u32> {
        let run = &self.runs[piece.run];
        let mut looks = vec![0; self.count()];
        for signal in &run.signals {
            let Some(at) = self.signals.iter().position(|(own, _)| *own == signal.name) else { continue };
            let [levels, changes] = &self.signals[at].1;
            let first = 2 * at * self.bins();
            self.look(run.t_s, signal, piece.rows.clone(), |level, change| {
                looks[first + self.bin(level, levels)] += 1;
                looks[first + self.bins() + self.bin(change, changes)] += 1;
            });
        }
        let middle = self.before[piece.run] + piece.rows.start.midpoint(piece.rows.end);
        let age = (self.knobs.ages * middle / self.rows.max(1)).min(self.knobs.ages - 1);
        let ages = self.count() - self.knobs.ages;
        looks[ages + age] = (self.seconds(piece) / self.knobs.look_s) as u32;
        looks
    }

    /// How many situations the pieces with these looks meet for long enough.
    pub fn met<'b>(&self, pieces: impl Iterator<Item = &'b [u32]>) -> usize {
        let mut sum = vec![0_u64; self.count()];
        for looks in pieces {
            sum.iter_mut().zip(looks).for_each(|(n, more)| *n += u64::from(*more));
        }
        let enough = (self.knobs.met_s / self.knobs.look_s).round() as u64;
        sum.into_iter().filter(|n| *n >= enough).count()
    }

    fn seconds(&self, piece: &Piece) -> f64 {
        let t_s = &self.runs[piece.run].t_s[piece.rows.clone()];
        t_s.last().zip(t_s.first()).map_or(0.0, |(last, first)| last - first)
    }

    /// Looks at a signal: its value and how fast it changed since the last look [1/s]; a heading counts within its turn.
    fn look(&self, t_s: &[f64], signal: &Signal, rows: Range<usize>, mut take: impl FnMut(f64, f64)) {
        let turn = |value: f64| if signal.is_heading { value.rem_euclid(TAU) } else { value };
        let mut last: Option<(f64, f64)> = None;
        for row in rows {
            let t = t_s[row];
            if last.is_some_and(|(before, _)| t - before < self.knobs.look_s) {
                continue;
            }
            let Some(value) = (signal.at)(row) else { continue };
            if let Some((before, old)) = last {
                take(turn(value), (value - old) / (t - before));
            }
            last = Some((t, value));
        }
    }

    /// The bin of a value: below the range, one of its equal parts, or above it.
    fn bin(&self, value: f64, range: &Range<f64>) -> usize {
        if value < range.start {
            return 0;
        }
        if value > range.end {
            return self.knobs.levels + 1;
        }
        let share = (value - range.start) / (range.end - range.start).max(f64::MIN_POSITIVE);
        1 + ((share * self.knobs.levels as f64) as usize).min(self.knobs.levels - 1)
    }
}
