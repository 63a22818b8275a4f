//! Where the tables and reports of a fleet are kept: files by name, in a folder or in whatever else holds bytes under names.

use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::error::{Error, Result};
use crate::log::{entries, locked_within, write_whole};

/// Files by name. A name is a path with `/`, relative to the storage: `sessions/robot=r07/date=2026-11-03/part.parquet`.
pub trait Storage: Send + Sync {
    /// What a person calls the file of this name.
    fn place(&self, name: &str) -> PathBuf;

    /// The names of all files below a folder, in order; none where there is no such folder.
    ///
    /// # Errors
    /// Where it cannot be listed.
    fn files(&self, folder: &str) -> Result<Vec<String>>;

    /// The bytes of a file; none where there is none.
    ///
    /// # Errors
    /// Where it cannot be read.
    fn read(&self, name: &str) -> Result<Option<Vec<u8>>>;

    /// Puts bytes in place of a file: whoever reads finds either all of them, or what was there before.
    ///
    /// # Errors
    /// Where it cannot be written.
    fn write(&self, name: &str, bytes: &[u8]) -> Result<()>;

    /// Takes away a file, or a folder with all that is in it; nothing happens where there is none.
    ///
    /// # Errors
    /// Where it cannot be taken away.
    fn remove(&self, name: &str) -> Result<()>;
}

/// How long another writer is waited for: the lock of one that was just killed is free a moment later.
const PATIENCE: Duration = Duration::from_secs(1);

/// A folder.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    /// Held as long as this lives: two writers would lose each other's rows.
    _lock: Option<File>,
}

impl Folder {
    /// To read from.
    pub fn to_read(path: &Path) -> Self {
        Self { path: path.to_path_buf(), _lock: None }
    }

    /// To write to as the only one; made if need be.
    ///
    /// # Errors
    /// Where somebody else writes to it, or it cannot be made.
    pub fn to_write(path: &Path) -> Result<Self> {
        let unwritable = |why: String| Error::output(path, why, "Name another folder with --out");
        std::fs::create_dir_all(path).map_err(|why| unwritable(why.to_string()))?;
        let lock = File::create(path.join(".lock")).map_err(|why| unwritable(why.to_string()))?;
        locked_within(PATIENCE, &lock).map_err(|why| match why {
            TryLockError::WouldBlock => unwritable("another omni-gap fleet is writing to it".to_owned()),
            TryLockError::Error(why) => unwritable(why.to_string()),
        })?;
        Ok(Self { path: path.to_path_buf(), _lock: Some(lock) })
    }
}

impl Storage for Folder {
    fn place(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    fn files(&self, folder: &str) -> Result<Vec<String>> {
        let mut names = Vec::new();
        let place = self.place(folder);
        if place.is_dir() {
            below(&place, folder, &mut names)?;
        }
        Ok(names)
    }

    fn read(&self, name: &str) -> Result<Option<Vec<u8>>> {
        let place = self.place(name);
        match std::fs::read(&place) {
            Ok(bytes) => Ok(Some(bytes)),
            Err(why) if why.kind() == std::io::ErrorKind::NotFound => Ok(None),
            Err(why) => Err(Error::unreadable(&place, &why)),
        }
    }

    fn write(&self, name: &str, bytes: &[u8]) -> Result<()> {
        let place = self.place(name);
        if let Some(folder) = place.parent() {
            std::fs::create_dir_all(folder).map_err(|why| {
                Error::output(folder, why.to_string(), "Free space, or name another folder with --out")
            })?;
        }
        write_whole(&place, bytes)
    }

    fn remove(&self, name: &str) -> Result<()> {
        let place = self.place(name);
        let removed = if place.is_dir() { std::fs::remove_dir_all(&place) } else { std::fs::remove_file(&place) };
        match removed {
            Err(why) if why.kind() != std::io::ErrorKind::NotFound => {
                Err(Error::output(&place, why.to_string(), "Take it away by hand"))
            }
            _ => Ok(()),
        }
    }
}

fn below(folder: &Path, name: &str, names: &mut Vec<String>) -> Result<()> {
    for (own, path) in entries(folder)? {
        let name = format!("{name}/{own}");
        if path.is_dir() {
            below(&path, &name, names)?;
        } else {
            names.push(name);
        }
    }
    Ok(())
}
