//! The store: three tables in a folder, one writer at a time.

use std::collections::BTreeMap;
use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::answer::Answered;
use super::cells::Row;
use super::partition;
use super::rows::{CauseRow, EquationRow, SessionRow};
use crate::error::{Error, Result};
use crate::log::entries;

/// A day is written at most so often, and writing takes at most so small a part of the time.
const BETWEEN: Duration = Duration::from_secs(5);
const PART: u32 = 20;

/// How long another writer is waited for.
const PATIENCE: Duration = Duration::from_secs(1);

/// A folder of tables.
#[derive(Debug)]
pub struct Store {
    folder: PathBuf,
    /// Held as long as this lives: two writers would lose each other's rows.
    _lock: File,
    sessions: BTreeMap<String, SessionRow>,
    waiting: BTreeMap<PathBuf, Vec<Answered>>,
    written_at: Instant,
    took: Duration,
}

impl Store {
    /// Opens a store to write, or makes one.
    ///
    /// # Errors
    /// Where somebody else writes to it, or it cannot be read or made.
    pub fn open(folder: &Path) -> Result<Self> {
        let unwritable = |why: String| Error::output(folder, why, "Name another folder with --out");
        std::fs::create_dir_all(folder).map_err(|why| unwritable(why.to_string()))?;
        let lock = File::create(folder.join(".lock")).map_err(|why| unwritable(why.to_string()))?;
        locked(&lock).map_err(|why| match why {
            TryLockError::WouldBlock => unwritable("another omni-gap fleet is writing to it".to_owned()),
            TryLockError::Error(why) => unwritable(why.to_string()),
        })?;
        for table in [SessionRow::TABLE, CauseRow::TABLE, EquationRow::TABLE] {
            days(folder, table)?.iter().try_for_each(|day| partition::sweep(day))?;
        }
        let sessions = rows::<SessionRow>(folder)?;
        let sessions = sessions.into_iter().map(|row| (row.session.clone(), row)).collect();
        let (written_at, took) = (Instant::now(), Duration::ZERO);
        Ok(Self { folder: folder.to_path_buf(), _lock: lock, sessions, waiting: BTreeMap::new(), written_at, took })
    }

    /// Its folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// What it holds of a session.
    pub fn session(&self, session: &str) -> Option<&SessionRow> {
        self.sessions.get(session)
    }

    /// Takes an answer up; it is on the disk a few seconds later, or once [`Store::flush`] is called.
    pub(super) fn put(&mut self, answer: Answered) -> Result<()> {
        let day = partition::folder_of(&answer.session.robot, &answer.session.date);
        self.waiting.entry(day).or_default().push(answer);
        if self.written_at.elapsed() > BETWEEN.max(self.took * PART) { self.flush() } else { Ok(()) }
    }

    /// Writes what waits.
    pub(super) fn flush(&mut self) -> Result<()> {
        let begun = Instant::now();
        for (day, answers) in std::mem::take(&mut self.waiting) {
            let rows: Vec<SessionRow> = answers.iter().map(|answer| answer.session.clone()).collect();
            partition::add(&self.folder, &day, answers)?;
            for row in rows {
                let report = row.report.clone();
                let Some(before) = self.sessions.insert(row.session.clone(), row) else { continue };
                let place = partition::folder_of(&before.robot, &before.date);
                if place != day {
                    partition::remove(&self.folder, &place, &before.session)?;
                }
                if let Some(old) = before.report.filter(|old| report.as_ref() != Some(old) && is_of_a_report(old)) {
                    // a report that nobody is led to any more; that it is still there does no harm
                    let _ = std::fs::remove_dir_all(self.folder.join(old));
                }
            }
        }
        (self.written_at, self.took) = (Instant::now(), begun.elapsed());
        Ok(())
    }
}

/// Whether it is a folder that this program keeps reports in: a table may have been written by somebody else.
fn is_of_a_report(folder: &str) -> bool {
    folder.strip_prefix("reports/").is_some_and(|name| !name.is_empty() && name.bytes().all(|c| c.is_ascii_hexdigit()))
}

/// Takes the lock; of a writer that was just killed it is free a moment later.
fn locked(lock: &File) -> std::result::Result<(), TryLockError> {
    let begun = Instant::now();
    loop {
        match lock.try_lock() {
            Err(TryLockError::WouldBlock) if begun.elapsed() < PATIENCE => std::thread::sleep(PATIENCE / 20),
            done => return done,
        }
    }
}

/// All rows of a table, by robot, day and session.
pub(super) fn rows<R: Row>(store: &Path) -> Result<Vec<R>> {
    let mut all = Vec::new();
    for day in days(store, R::TABLE)? {
        for (_, file) in entries(&day)? {
            if file.extension().is_some_and(|suffix| suffix == "parquet") {
                all.extend(partition::of_file::<R>(&file)?);
            }
        }
    }
    Ok(all)
}

/// The folders of a table's days; none where the table is not there.
fn days(store: &Path, table: &str) -> Result<Vec<PathBuf>> {
    let table = store.join(table);
    let robots = if table.is_dir() { folders(&table)? } else { Vec::new() };
    let days: Vec<Vec<PathBuf>> = robots.iter().map(|robot| folders(robot)).collect::<Result<_>>()?;
    Ok(days.concat())
}

fn folders(within: &Path) -> Result<Vec<PathBuf>> {
    Ok(entries(within)?.into_iter().map(|(_, path)| path).filter(|path| path.is_dir()).collect())
}
