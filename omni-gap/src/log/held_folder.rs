//! # A folder that one process at a time puts files into
//!
//! Files that belong together are then those of one process, and what a process left that was killed while it wrote is known to be nobody's.

use std::fs::{File, TryLockError};
use std::path::Path;
use std::time::{Duration, Instant};

/// How the name of a file begins that is not finished yet.
pub(crate) const UNFINISHED: &str = ".omni-gap-";

/// How long another process is waited for: it writes for some milliseconds.
const PATIENCE: Duration = Duration::from_secs(2);
const BETWEEN: Duration = Duration::from_millis(5);

/// A folder, held until this goes away.
#[derive(Debug)]
pub(crate) struct HeldFolder {
    _lock: Option<File>,
}

impl HeldFolder {
    /// Takes a folder, and takes away what was left in it unfinished. Where a file system knows no locks, or somebody holds the folder for
    /// long, it is written to without: each file is whole then too.
    pub fn take(folder: &Path) -> Self {
        let lock = File::open(folder).ok().filter(|folder| locked_within(PATIENCE, folder).is_ok());
        if lock.is_some() {
            sweep(folder);
        }
        Self { _lock: lock }
    }
}

/// Locks a file or folder, for which whoever has it is waited for.
pub(crate) fn locked_within(patience: Duration, file: &File) -> Result<(), TryLockError> {
    let begun = Instant::now();
    loop {
        match file.try_lock() {
            Err(TryLockError::WouldBlock) if begun.elapsed() < patience => std::thread::sleep(BETWEEN),
            done => return done,
        }
    }
}

/// What cannot be taken away does no harm where it is.
fn sweep(folder: &Path) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        if entry.file_name().as_encoded_bytes().starts_with(UNFINISHED.as_bytes()) {
            let _ = std::fs::remove_file(entry.path());
        }
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn what_was_left_unfinished_goes_away_and_what_is_being_written_stays() {
        let folder = tempfile::tempdir().unwrap();
        let left = folder.path().join(".omni-gap-1");
        std::fs::write(&left, "half").unwrap();
        std::fs::write(folder.path().join(".mine"), "whole").unwrap();
        let held = HeldFolder::take(folder.path());
        assert!(!left.exists() && folder.path().join(".mine").exists());
        std::fs::write(&left, "being written").unwrap();
        let path = folder.path().to_owned();
        let other = std::thread::spawn(move || drop(HeldFolder::take(&path)));
        std::thread::sleep(10 * BETWEEN);
        assert!(left.exists() && !other.is_finished(), "the other one waits");
        drop(held);
        other.join().unwrap();
        assert!(!left.exists());
    }

    #[test]
    fn a_folder_that_is_not_there_is_not_held() {
        let nowhere = Path::new("no/such/folder");
        assert!(HeldFolder::take(nowhere)._lock.is_none());
    }
}
