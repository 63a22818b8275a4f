//! What an answer was made of: each file with its hash.

use std::fs::File;
use std::path::{Path, PathBuf};

use omni_gap::error::InputKind;
use omni_gap::log::Run;
use omni_gap::report::Input;
use omni_gap::{Error, Session};
use sha2::{Digest, Sha256};

use super::cli_error::CliError;

/// The files of a session: those that are named, and those of its runs.
pub fn inputs<'a>(
    named: impl IntoIterator<Item = &'a Path>,
    sessions: impl IntoIterator<Item = &'a Session>,
) -> Result<Vec<Input>, CliError> {
    let of_runs = sessions.into_iter().flat_map(|session| session.runs.iter().chain(&session.heldout)).flat_map(files);
    let mut all: Vec<PathBuf> = named.into_iter().map(Path::to_path_buf).chain(of_runs).collect();
    let mut seen = std::collections::BTreeSet::new();
    all.retain(|path| seen.insert(path.clone()));
    all.iter().map(|path| hashed(path)).collect()
}

/// The files of a run; none of one that was made in memory.
fn files(run: &Run) -> Vec<PathBuf> {
    let parts: Vec<PathBuf> = run.files.iter().map(|file| file.path.clone()).collect();
    let all = if parts.is_empty() { vec![run.path.clone()] } else { parts };
    all.into_iter().filter(|path| path.is_file()).collect()
}

fn hashed(path: &Path) -> Result<Input, CliError> {
    let mut hash = Sha256::new();
    File::open(path).and_then(|mut file| std::io::copy(&mut file, &mut hash)).map_err(|why| {
        Error::input(path, format!("cannot be read: {why}"), "Check the path and the file's permissions")
            .of_kind(InputKind::Unreadable)
    })?;
    Ok(Input { file: path.display().to_string(), sha256: format!("{:x}", hash.finalize()) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_has_the_hash_that_everybody_gives_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("abc");
        std::fs::write(&path, "abc").unwrap();
        // FIPS 180-2, appendix B.1
        let known = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        let found = inputs([path.as_path(), path.as_path()], []).unwrap();
        assert_eq!(found.iter().map(|input| input.sha256.as_str()).collect::<Vec<_>>(), [known]);
    }
}
