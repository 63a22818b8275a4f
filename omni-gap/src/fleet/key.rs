//! What an answer rests on, as one hash: the session's files, the catalogue, the thresholds and this program's version.

use std::path::{Path, PathBuf};

use model_core::effects::EffectKind;
use model_core::effects::nominal;
use sha2::{Digest, Sha256};

use super::labels;
use crate::api::sha256_of;
use crate::engine::Knobs;
use crate::error::Result;
use crate::log::entries;

/// The form of the rows; it changes where rows of before cannot be read beside new ones.
pub(super) const FORM: u32 = 1;

/// The part that all sessions share.
#[derive(Clone)]
pub(super) struct Basis(Sha256);

impl Basis {
    /// Of these thresholds.
    pub fn of(knobs: &Knobs) -> Self {
        let mut hash = Sha256::new();
        hash.update(format!("form {FORM}, omni-gap {}\n", env!("CARGO_PKG_VERSION")));
        for card in EffectKind::ALL.iter().map(|effect| effect.card()) {
            hash.update(format!("{} {:?} {:?}\n", card.id, card.scope, card.params));
        }
        for number in nominal::numbers() {
            hash.update(format!("{} {:?} {:?}\n", number.key, number.relative_uncertainty, number.within));
        }
        hash.update(serde_json::to_vec(knobs).unwrap_or_default());
        Self(hash)
    }

    /// Of a session too: each of its files with its name.
    ///
    /// # Errors
    /// Where one cannot be read.
    pub fn with_session(&self, session: &Path) -> Result<String> {
        let mut hash = self.0.clone();
        for file in files(session)? {
            let name = file.strip_prefix(session).unwrap_or(&file).as_os_str().as_encoded_bytes();
            hash.update((name.len() as u64).to_le_bytes());
            hash.update(name);
            hash.update(sha256_of(&file)?);
        }
        Ok(format!("{:x}", hash.finalize()))
    }
}

/// The files that a session may be read from, in the order of their names.
fn files(session: &Path) -> Result<Vec<PathBuf>> {
    let mut all: Vec<PathBuf> = ["robot.toml", "columns.toml", labels::FILE]
        .map(|name| session.join(name))
        .into_iter()
        .filter(|p| p.is_file())
        .collect();
    for folder in ["runs", "heldout"].map(|name| session.join(name)).into_iter().filter(|path| path.is_dir()) {
        below(&folder, &mut all)?;
    }
    Ok(all)
}

/// The files below a folder that are not hidden; folders that are links are not followed.
fn below(folder: &Path, all: &mut Vec<PathBuf>) -> Result<()> {
    for (_, path) in entries(folder)? {
        if path.is_file() {
            all.push(path);
        } else if path.is_dir() && !path.is_symlink() {
            below(&path, all)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_name_and_threshold_counts_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| {
            let path = folder.path().join(name);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, text).unwrap();
        };
        write("robot.toml", "name = \"x\"");
        write("runs/a.csv", "1");
        let knobs = Knobs::default();
        let key = |knobs: &Knobs| Basis::of(knobs).with_session(folder.path()).unwrap();
        let first = key(&knobs);
        write("notes.txt", "what I think of it");
        assert_eq!(key(&knobs), first);
        let mut other = knobs.clone();
        other.measure.horizon_s *= 2.0;
        assert_ne!(key(&other), first);
        write("runs/a.csv", "2");
        let changed = key(&knobs);
        assert_ne!(changed, first);
        std::fs::rename(folder.path().join("runs/a.csv"), folder.path().join("runs/b.csv")).unwrap();
        assert_ne!(key(&knobs), changed);
    }
}
