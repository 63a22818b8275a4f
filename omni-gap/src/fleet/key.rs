//! What an answer rests on, as one hash: the session's files, the catalogue, the thresholds and this program's version.

use std::path::{Path, PathBuf};

use model_core::effects::EffectKind;
use model_core::effects::nominal;
use sha2::{Digest, Sha256};

use super::find::FoundSession;
use super::labels;
use crate::api::sha256_of;
use crate::engine::Knobs;
use crate::error::Result;
use crate::log::entries;

/// The form of the rows; it changes where rows of before cannot be read beside new ones.
const FORM: u32 = 2;

/// The hash of a session: each of its files with its name, and the robot that its place tells.
///
/// # Errors
/// Where a file cannot be read.
pub(super) fn key_of(found: &FoundSession, knobs: &Knobs) -> Result<String> {
    let mut hash = basis(knobs);
    hash.update(format!("{:?}\n", found.robot));
    for file in files(&found.path)? {
        let name = file.strip_prefix(&found.path).unwrap_or(&file).as_os_str().as_encoded_bytes();
        hash.update((name.len() as u64).to_le_bytes());
        hash.update(name);
        hash.update(sha256_of(&file)?);
    }
    Ok(format!("{:x}", hash.finalize()))
}

/// The part that all sessions share.
fn basis(knobs: &Knobs) -> Sha256 {
    let mut hash = Sha256::new();
    hash.update(format!("form {FORM}, omni-gap {}\n", env!("CARGO_PKG_VERSION")));
    for card in EffectKind::ALL.iter().map(|effect| effect.card()) {
        hash.update(format!("{} {:?} {:?}\n", card.id, card.scope, card.params));
    }
    for number in nominal::numbers() {
        hash.update(format!("{} {:?} {:?}\n", number.key, number.relative_uncertainty, number.within));
    }
    hash.update(serde_json::to_vec(knobs).unwrap_or_default());
    hash
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
    fn every_byte_name_threshold_and_robot_counts_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| {
            let path = folder.path().join(name);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, text).unwrap();
        };
        write("robot.toml", "name = \"x\"");
        write("runs/a.csv", "1");
        let knobs = Knobs::default();
        let found = || FoundSession::at(folder.path(), folder.path(), "x".into());
        let key = |knobs: &Knobs| key_of(&found(), knobs).unwrap();
        let first = key(&knobs);
        let of_another = FoundSession { robot: Some("r08".into()), ..found() };
        assert_ne!(key_of(&of_another, &knobs).unwrap(), first);
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
