//! # Whether a recording stayed as it was while it was read
//!
//! A recorder that is still writing, a copy that is under way: what is read then is no recording that anybody can look at later.

use super::entries::entries;
use crate::error::{Error, InputKind, Result};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// The files of a run with their lengths and times.
#[derive(Debug)]
pub(super) struct Unchanged(Vec<(PathBuf, Option<Stamp>)>);

/// Length (bytes), and when it was written.
type Stamp = (u64, Option<SystemTime>);

impl Unchanged {
    /// Of a file, or the files in a folder.
    pub fn of(path: &Path) -> Self {
        let within = if path.is_dir() { entries(path).unwrap_or_default() } else { vec![(String::new(), path.into())] };
        Self(within.into_iter().map(|(_, path)| (path.clone(), stamp(&path))).collect())
    }

    /// Refuses what is no longer as it was.
    pub fn check(&self) -> Result<()> {
        let Some((path, _)) = self.0.iter().find(|(path, before)| stamp(path) != *before) else { return Ok(()) };
        let fix = "Wait until its recorder or copy is done, and ask again";
        Err(Error::input(path, "it changed while it was read", fix).of_kind(InputKind::Unreadable))
    }
}

/// None of what is no file: a pipe changes by being read.
fn stamp(path: &Path) -> Option<Stamp> {
    let about = path.metadata().ok().filter(std::fs::Metadata::is_file)?;
    Some((about.len(), about.modified().ok()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;

    #[test]
    fn a_file_that_grows_is_cut_off_or_goes_away_is_told_by_its_name() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        let change: [fn(&Path); 3] = [
            |path| std::fs::File::options().append(true).open(path).unwrap().write_all(b"5,6\n").unwrap(),
            |path| std::fs::File::options().write(true).open(path).unwrap().set_len(3).unwrap(),
            |path| std::fs::remove_file(path).unwrap(),
        ];
        for change in change {
            std::fs::write(&path, "1,2\n3,4\n").unwrap();
            let [file, whole] = [&*path, folder.path()].map(Unchanged::of);
            assert!(file.check().is_ok() && whole.check().is_ok());
            change(&path);
            for said in [file, whole].map(|before| before.check().unwrap_err().to_string()) {
                assert!(said.contains("a.csv: it changed while it was read"), "{said}");
            }
        }
    }

    #[test]
    fn what_is_no_file_has_nothing_to_change() {
        assert!(Unchanged::of(Path::new("no/such/file")).check().is_ok());
        assert_eq!(stamp(&std::env::temp_dir()), None);
    }
}
