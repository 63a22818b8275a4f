//! The last rows of what a robot sends, for as long as it sends: what is not needed any more is forgotten.

use std::path::Path;

use model_core::link::record::TelemetryRecord;

use super::capture::Capture;
use super::run::{clock, run};
use crate::error::Result;
use crate::log::Run;

/// So many records are kept of a robot that does not say how to read them.
const MOST_UNEXPLAINED: usize = 10_000;

/// What a robot sent lately.
#[derive(Debug, Default)]
pub struct Tail {
    capture: Capture,
    /// Time of the first record that is kept, since the first of all [s]
    began_s: f64,
    /// What of the part that is forgotten is still to be told.
    forgotten: Heard,
}

/// What came.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Heard {
    /// Records that came.
    pub records: u64,
    /// Records that got lost, on the way or for lack of room on the robot.
    pub lost: u64,
    /// Frames that came broken.
    pub broken: u64,
    /// How many times the robot started again.
    pub restarts: u64,
}

impl Tail {
    /// Takes bytes; true if any frame ended with them.
    pub fn take(&mut self, bytes: &[u8]) -> bool {
        let (mut rest, mut frames) = (bytes, false);
        loop {
            let before = self.capture.bytes_taken;
            frames |= self.capture.take(rest) != super::capture::Progress::Nothing;
            rest = rest.get(self.capture.bytes_taken - before..).unwrap_or_default();
            if !self.capture.restarted {
                break;
            }
            self.begin_again();
        }
        if self.capture.hellos.is_empty() && self.capture.records.len() > MOST_UNEXPLAINED {
            self.forget(self.capture.records.len() - MOST_UNEXPLAINED);
        }
        frames
    }

    /// Until when records came, since the first [s]; none before a frame says how to read them.
    pub fn reaches_s(&self) -> Option<f64> {
        let (first, last) = self.capture.records.first().zip(self.capture.records.last())?;
        Some(self.began_s + self.since(first, last)?)
    }

    /// The rows that are kept, their times those since the first record of all.
    ///
    /// # Errors
    /// As those of a recording: where there is nothing to make rows of, or it is another robot's.
    pub fn run(&self, place: &Path, wheels: usize) -> Result<Run> {
        let mut run = run(&self.capture, place, "", Some(wheels))?;
        run.t_s.iter_mut().for_each(|t| *t += self.began_s);
        Ok(run)
    }

    /// Forgets what came before this time [s].
    pub fn forget_before(&mut self, time_s: f64) {
        let Some(first) = self.capture.records.first() else { return };
        let old =
            |record: &TelemetryRecord| self.since(first, record).is_some_and(|since_s| self.began_s + since_s < time_s);
        let before = self.capture.records.partition_point(old);
        self.forget(before.min(self.capture.records.len() - 1));
    }

    /// What came so far.
    pub fn heard(&self) -> Heard {
        self.forgotten.and(&self.capture)
    }

    fn since(&self, first: &TelemetryRecord, record: &TelemetryRecord) -> Option<f64> {
        Some(f64::from(record.time.wrapping_sub(first.time)) * clock(self.capture.hello(0)?))
    }

    fn forget(&mut self, records: usize) {
        let kept = self.capture.records.get(..=records).unwrap_or_default();
        if let Some((first, next)) = kept.first().zip(kept.last()).filter(|_| records > 0) {
            self.began_s += self.since(first, next).unwrap_or_default();
            let (on_the_way, no_room) = self.capture.forget(records);
            self.forgotten.records += records as u64;
            self.forgotten.lost += u64::from(on_the_way) + u64::from(no_room);
        }
    }

    /// Goes on with a robot that started again: by a clock of its own, from where the other ended.
    fn begin_again(&mut self) {
        self.began_s = self.reaches_s().unwrap_or(self.began_s);
        self.forgotten = Heard { restarts: self.forgotten.restarts + 1, ..self.heard() };
        // it said how it is to be read before its first record told that it started again
        let explains = self.capture.hellos.last().map(|(_, hello)| (0, *hello));
        self.capture = Capture::new(None);
        self.capture.hellos.extend(explains);
    }
}

impl Heard {
    fn and(self, kept: &Capture) -> Heard {
        let (on_the_way, no_room) = kept.lost();
        Heard {
            records: self.records + kept.records.len() as u64,
            lost: self.lost + u64::from(on_the_way) + u64::from(no_room),
            broken: self.broken + u64::from(kept.bad_frames()),
            ..self
        }
    }
}

#[cfg(test)]
#[path = "tail_tests.rs"]
mod tests;
