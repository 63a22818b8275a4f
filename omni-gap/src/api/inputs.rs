//! What an answer was made of: each file with its hash.

use std::fs::File;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use crate::error::{Error, Result};
use crate::log::{Run, Session};
use crate::report::Input;

/// The files that sessions were read from, each with the hash of its bytes; of what was made in memory there is none.
///
/// # Errors
/// Where one of them can no longer be read.
pub fn inputs<'a>(sessions: impl IntoIterator<Item = &'a Session>) -> Result<Vec<Input>> {
    let mut all: Vec<PathBuf> = Vec::new();
    for session in sessions {
        let of_runs = session.runs.iter().chain(&session.heldout).flat_map(files);
        for path in session.files.iter().cloned().chain(of_runs) {
            if !all.contains(&path) {
                all.push(path);
            }
        }
    }
    let input = |path: &PathBuf| Ok(Input { file: path.display().to_string(), sha256: sha256_of(path)? });
    all.iter().map(input).collect()
}

/// The files of a run; none of one that was made in memory.
fn files(run: &Run) -> Vec<PathBuf> {
    let parts: Vec<PathBuf> = run.files.iter().map(|file| file.path.clone()).collect();
    let all = if parts.is_empty() { vec![run.path.clone()] } else { parts };
    all.into_iter().filter(|path| path.is_file()).collect()
}

/// The hash of a file's bytes, in hexadecimal digits.
///
/// # Errors
/// Where it cannot be read.
pub(crate) fn sha256_of(path: &Path) -> Result<String> {
    let mut hash = Sha256::new();
    File::open(path)
        .and_then(|mut file| std::io::copy(&mut file, &mut hash))
        .map_err(|why| Error::unreadable(path, &why))?;
    Ok(format!("{:x}", hash.finalize()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::known_effects;
    use crate::log::RobotFile;

    const ROBOT: &str = include_str!("../../robots/feup-4w/robot.toml");

    #[test]
    fn a_file_has_the_hash_that_everybody_gives_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("abc");
        std::fs::write(&path, "abc").unwrap();
        // FIPS 180-2, appendix B.1
        let known = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(sha256_of(&path).unwrap(), known);
    }

    #[test]
    fn a_file_of_two_sessions_is_named_once() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("robot.toml");
        std::fs::write(&path, ROBOT).unwrap();
        let robot = RobotFile::load(&path, &known_effects()).unwrap();
        let (robot_text, runs, heldout, notices) = (ROBOT.to_owned(), Vec::new(), Vec::new(), Vec::new());
        let session = Session { robot, robot_text, runs, heldout, files: vec![path], notices };
        assert_eq!(inputs([&session, &session]).unwrap().len(), 1);
    }
}
