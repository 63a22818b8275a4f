//! A folder in which a fault is staged: a small sound session, and the command.

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fs;
use std::io;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};

use omni_gap::known_effects;
use omni_gap::log::write_session;
use omni_gap::synthesize::{Scenario, synthesize};
use tempfile::TempDir;

use super::process::Asked;

/// The robot of all scenes.
pub const ROBOT: &str = include_str!("../../../examples/feup-4w/robot.toml");

/// The run that faults are put into.
pub const RUN: &str = "session/runs/run01.csv";

/// A folder that goes away.
#[derive(Debug)]
pub struct Scene {
    folder: TempDir,
    program: PathBuf,
}

impl Scene {
    /// One with a sound session in `session`.
    ///
    /// # Errors
    /// Where there is no room for it.
    pub fn new(program: &Path) -> io::Result<Self> {
        let scene = Self { folder: tempfile::tempdir()?, program: program.to_owned() };
        scene.add_session("session", 1)?;
        Ok(scene)
    }

    /// Adds a session of three runs.
    ///
    /// # Errors
    /// Where there is no room for it.
    pub fn add_session(&self, at: impl AsRef<OsStr>, seed: u64) -> io::Result<()> {
        let plan = Scenario { runs: 3, duration: 2.0, rate: 100.0, seed, ..Scenario::default() };
        let staged = synthesize(ROBOT, &plan, &known_effects()).map_err(io::Error::other)?;
        write_session(&self.at(at.as_ref()), &staged.robot_text, &staged.runs).map_err(io::Error::other)
    }

    /// A path in the folder.
    pub fn at(&self, path: impl AsRef<Path>) -> PathBuf {
        self.folder.path().join(path)
    }

    /// Writes a file and the folders above it.
    ///
    /// # Errors
    /// Where there is no room for it.
    pub fn write(&self, path: impl AsRef<Path>, bytes: &[u8]) -> io::Result<PathBuf> {
        let path = self.at(path);
        path.parent().map_or(Ok(()), fs::create_dir_all)?;
        fs::write(&path, bytes)?;
        Ok(path)
    }

    /// The text of a file.
    ///
    /// # Errors
    /// Where there is none.
    pub fn read(&self, path: impl AsRef<Path>) -> io::Result<String> {
        fs::read_to_string(self.at(path))
    }

    /// The command with these words, to be run in the folder.
    pub fn asked(&self, words: &[impl AsRef<OsStr>]) -> Asked {
        Asked::new(&self.program, self.folder.path(), words)
    }

    /// Whether the session is sound.
    pub fn check(&self) -> Asked {
        self.asked(&["check", "session"])
    }

    /// The sessions below a folder, as a fleet with its tables in `season`.
    pub fn fleet(&self, below: &str) -> Asked {
        self.asked(&["fleet", below, "--out", "season"])
    }

    /// Everything in the folder, by path.
    pub fn all(&self) -> BTreeSet<PathBuf> {
        let mut found = BTreeSet::new();
        below(self.folder.path(), &mut found);
        found
    }

    /// A text without the folder's own place in it.
    pub fn shortened(&self, text: &str) -> String {
        let folder = self.folder.path().display().to_string();
        text.replace(&format!("{folder}/"), "").replace(&folder, ".")
    }
}

/// Everything below a folder; links are named and not followed.
pub fn below(folder: &Path, found: &mut BTreeSet<PathBuf>) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() && !path.is_symlink() {
            below(&path, found);
        }
        found.insert(path);
    }
}

/// A name that is no Unicode, with spaces and a line's end in it.
pub fn odd_name(beginning: &str) -> std::ffi::OsString {
    OsStr::from_bytes(&[beginning.as_bytes(), b" a\nb \xff"].concat()).to_owned()
}
