//! # Line: a command as a person would type it
//!
//! What is announced is what is run, because both are made from the same value.

use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// A command with the environment that it needs, run from the top of the tree or a folder in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    folder: PathBuf,
    env: Vec<(String, String)>,
    words: Vec<OsString>,
}

impl Line {
    /// The command of a text without quotes: its words, parted by spaces.
    pub fn of(text: &str) -> Self {
        Self { folder: PathBuf::new(), env: Vec::new(), words: text.split_whitespace().map(OsString::from).collect() }
    }

    /// The same with one variable set.
    pub fn env(mut self, name: &str, value: &str) -> Self {
        self.env.push((name.into(), value.into()));
        self
    }

    /// The same, run in a folder, whose path begins at the top of the tree.
    pub fn within(mut self, folder: impl Into<PathBuf>) -> Self {
        self.folder = folder.into();
        self
    }

    /// The same with one more word, whatever is in it.
    pub fn word(mut self, word: impl AsRef<OsStr>) -> Self {
        self.words.push(word.as_ref().to_owned());
        self
    }

    /// The text to type into a shell to get exactly this.
    pub fn shown(&self) -> String {
        let env = self.env.iter().map(|(name, value)| format!("{name}={}", quoted(value)));
        let words = self.words.iter().map(|word| quoted(&word.to_string_lossy()));
        let typed = env.chain(words).collect::<Vec<_>>().join(" ");
        match self.folder.as_os_str().is_empty() {
            true => typed,
            false => format!("(cd {} && {typed})", quoted(&self.folder.to_string_lossy())),
        }
    }

    /// Runs it in the open; true if it could be started and succeeded.
    pub fn succeeds(&self) -> bool {
        match self.command().status() {
            Ok(status) => status.success(),
            Err(why) => {
                eprintln!("{}: {why}", self.shown());
                false
            }
        }
    }

    /// Announces it and runs it in the open; otherwise what to tell the person.
    pub fn announced(&self) -> Result<(), String> {
        println!("{}", self.shown());
        if self.succeeds() { Ok(()) } else { Err(format!("failed: {}", self.shown())) }
    }

    /// Runs it in silence; what it printed, or nothing if it could not be started or failed.
    pub fn answer(&self) -> Option<String> {
        let out = self.command().stdin(Stdio::null()).output().ok()?;
        out.status.success().then(|| String::from_utf8_lossy(&out.stdout).into_owned())
    }

    fn command(&self) -> Command {
        let mut words = self.words.iter();
        let mut command = Command::new(words.next().map_or(OsStr::new(""), OsString::as_os_str));
        command
            .args(words)
            .envs(self.env.iter().map(|(name, value)| (name, value)))
            .current_dir(top().join(&self.folder));
        command
    }
}

/// The top of the tree: the folder above this crate's, as cargo tells it at run time.
pub fn top() -> PathBuf {
    match std::env::var_os("CARGO_MANIFEST_DIR") {
        Some(here) => PathBuf::from(here).parent().map_or_else(PathBuf::new, Path::to_path_buf),
        None => PathBuf::from("."),
    }
}

/// A word as a shell wants it: bare where that is safe, in single quotes otherwise.
fn quoted(word: &str) -> String {
    let safe = |c: char| c.is_alphanumeric() || "-_./:=+,@%".contains(c);
    if !word.is_empty() && word.chars().all(safe) { word.into() } else { format!("'{}'", word.replace('\'', r"'\''")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_shown_as_it_would_be_typed() {
        let line = Line::of("cargo doc  --no-deps").env("RUSTDOCFLAGS", "-D warnings").word("it's here");
        assert_eq!(line.shown(), r"RUSTDOCFLAGS='-D warnings' cargo doc --no-deps 'it'\''s here'");
    }

    #[test]
    fn a_folder_is_gone_to_first() {
        let line = Line::of("cargo --version").within("model-core");
        assert_eq!(line.shown(), "(cd model-core && cargo --version)");
        assert!(line.answer().is_some());
        assert_eq!(Line::of("cargo --version").within("no-such-folder").answer(), None);
    }

    #[test]
    fn a_plain_word_stays_bare_and_an_empty_one_does_not_vanish() {
        assert_eq!(quoted("logs/run-1.csv"), "logs/run-1.csv");
        assert_eq!(quoted(""), "''");
    }

    #[test]
    fn tells_success_from_failure_and_from_absence() {
        assert!(Line::of("cargo --version").answer().is_some_and(|said| said.starts_with("cargo")));
        assert_eq!(Line::of("cargo --no-such-option").answer(), None);
        assert_eq!(Line::of("no-such-program-anywhere").answer(), None);
        assert!(!Line::of("no-such-program-anywhere").succeeds());
    }
}
