//! The store: three tables, one writer at a time.

use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;
use std::time::{Duration, Instant};

use super::answer::SessionAnswer;
use super::partition;
use super::rows::SessionRow;
use super::storage::{Folder, Storage};
use crate::error::Result;

/// A day is written at most so often, and writing takes at most so small a part of the time.
const BETWEEN: Duration = Duration::from_secs(5);
const PART: u32 = 20;

/// Answers that wait to be written, at the most: they are held in memory.
const MOST_WAITING: usize = 256;

/// The tables of a fleet, to write to.
pub struct Store {
    storage: Box<dyn Storage>,
    sessions: BTreeMap<String, SessionRow>,
    waiting: BTreeMap<String, Vec<SessionAnswer>>,
    waits: usize,
    written_at: Instant,
    took: Duration,
}

impl fmt::Debug for Store {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let place = self.storage.place("");
        f.debug_struct("Store").field("place", &place).field("sessions", &self.sessions.len()).finish_non_exhaustive()
    }
}

impl Store {
    /// Opens a folder to write to, or makes one.
    ///
    /// # Errors
    /// Where somebody else writes to it, or it cannot be read or made.
    pub fn open(folder: &Path) -> Result<Self> {
        Self::of(Box::new(Folder::to_write(folder)?))
    }

    /// Of files by name, which nobody else writes to meanwhile.
    ///
    /// # Errors
    /// Where they cannot be read.
    pub fn of(storage: Box<dyn Storage>) -> Result<Self> {
        let sessions = partition::of_table::<SessionRow>(&*storage)?;
        let sessions = sessions.into_iter().map(|row| (row.session.clone(), row)).collect();
        let (waiting, written_at, took) = (BTreeMap::new(), Instant::now(), Duration::ZERO);
        Ok(Self { storage, sessions, waiting, waits: 0, written_at, took })
    }

    /// What it holds of a session.
    pub fn session(&self, session: &str) -> Option<&SessionRow> {
        self.sessions.get(session)
    }

    /// Takes an answer up, in place of what it holds of the same session; it is written a few seconds later, or once
    /// [`Store::flush`] is called.
    ///
    /// # Errors
    /// Where what waits cannot be written.
    pub fn put(&mut self, answer: SessionAnswer) -> Result<()> {
        let day = partition::day_of(&answer.session.robot, &answer.session.date);
        self.waiting.entry(day).or_default().push(answer);
        self.waits += 1;
        let due = self.written_at.elapsed() > BETWEEN.max(self.took * PART);
        if due || self.waits >= MOST_WAITING { self.flush() } else { Ok(()) }
    }

    /// Writes what waits.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub fn flush(&mut self) -> Result<()> {
        let begun = Instant::now();
        self.waits = 0;
        for (day, answers) in std::mem::take(&mut self.waiting) {
            let rows: Vec<SessionRow> = answers.iter().map(|answer| answer.session.clone()).collect();
            partition::add(&*self.storage, &day, answers)?;
            rows.into_iter().try_for_each(|row| self.replace(row, &day))?;
        }
        (self.written_at, self.took) = (Instant::now(), begun.elapsed());
        Ok(())
    }

    /// Takes away what was there of a session before this row.
    fn replace(&mut self, row: SessionRow, day: &str) -> Result<()> {
        let report = row.report.clone();
        let Some(before) = self.sessions.insert(row.session.clone(), row) else { return Ok(()) };
        let day_before = partition::day_of(&before.robot, &before.date);
        if day_before != day {
            partition::remove(&*self.storage, &day_before, &before.session)?;
        }
        if let Some(old) = before.report.filter(|old| report.as_ref() != Some(old) && is_of_a_report(old)) {
            // a report that nobody is led to any more; that it is still there does no harm
            let _ = self.storage.remove(&old);
        }
        Ok(())
    }
}

/// Whether it is a folder that this program keeps reports in: a table may have been written by somebody else.
fn is_of_a_report(folder: &str) -> bool {
    folder.strip_prefix("reports/").is_some_and(|name| !name.is_empty() && name.bytes().all(|c| c.is_ascii_hexdigit()))
}
