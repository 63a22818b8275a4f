//! A set of sessions on disk: recordings in one folder, labels in another, sealed by their hashes before anybody answers.
//!
//! ```text
//! SET/set.json             what it is and which commit made it
//! SET/sessions/NAME/       robot.toml, runs/: all that a contestant is given
//! SET/labels/NAME.json     what is true of it
//! SET/seal.json            SHA-256 of each label
//! SET/answers/CONTESTANT/  what each contestant left
//! ```

use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};

use omni_gap::error::{Error, Result};
use omni_gap::log::write_whole;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::label::Label;

/// What a set is.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct About {
    /// `tuning`, `fresh` or `reduced`.
    pub split: String,
    /// Of everything that is drawn.
    pub seed: u64,
    /// The commit whose programs made it.
    pub commit: String,
}

impl About {
    /// What its pages are called, without the suffix: the fresh split's are the benchmark's.
    pub fn page(&self) -> String {
        if self.split == "fresh" { "withheld".to_owned() } else { format!("withheld-{}", self.split) }
    }
}

/// Holds a set for one contestant. A program that is just being started by another thread has a copy of the file, and the
/// lock would live on in it for a moment: it is given back by word.
#[derive(Debug)]
pub struct Alone(File);

impl Drop for Alone {
    fn drop(&mut self) {
        // what cannot be unlocked is unlocked when the last copy is closed
        let _ = self.0.unlock();
    }
}

/// A set's folder.
#[derive(Clone, Debug)]
pub struct SetFolder(pub PathBuf);

impl SetFolder {
    /// Where the recordings of a session are.
    pub fn session(&self, name: &str) -> PathBuf {
        self.sessions().join(name)
    }

    /// Where all recordings are.
    pub fn sessions(&self) -> PathBuf {
        self.0.join("sessions")
    }

    /// Where no contestant may look.
    pub fn labels_folder(&self) -> PathBuf {
        self.0.join("labels")
    }

    /// Where a contestant's answers go.
    pub fn answers(&self, contestant: &str) -> PathBuf {
        self.0.join("answers").join(contestant)
    }

    /// What the set is.
    ///
    /// # Errors
    /// Where that cannot be read.
    pub fn about(&self) -> Result<About> {
        read(&self.0.join("set.json"), "Make the set first: cargo xtask bench make")
    }

    /// Notes what the set is, and makes its folders.
    ///
    /// # Errors
    /// Where something cannot be written, or another set stands there.
    pub fn begin(&self, about: &About) -> Result<()> {
        for folder in [self.sessions(), self.labels_folder()] {
            std::fs::create_dir_all(&folder).map_err(|why| Error::output(&folder, why.to_string(), "Make room"))?;
        }
        let place = self.0.join("set.json");
        if place.is_file() && self.about()? != *about {
            let why = "another set stands there".to_owned();
            return Err(Error::input(&place, why, "Choose another folder, or remove that one"));
        }
        write(&place, about)
    }

    /// Holds the set as long as what is returned lives.
    ///
    /// # Errors
    /// Where somebody else holds it.
    pub fn alone(&self) -> Result<Alone> {
        let place = self.0.join("running");
        let held = File::create(&place).map_err(|why| Error::output(&place, why.to_string(), "Make the set first"))?;
        let why = "another contestant is being run on this set";
        held.try_lock().map_err(|_| Error::input(&place, why, "Wait until it has ended"))?;
        Ok(Alone(held))
    }

    /// Writes a label.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub fn put_label(&self, label: &Label) -> Result<()> {
        write(&self.labels_folder().join(format!("{}.json", label.session)), label)
    }

    /// The label of a session, if it was made.
    pub fn label(&self, session: &str) -> Option<Label> {
        read(&self.labels_folder().join(format!("{session}.json")), "").ok()
    }

    /// Writes down the hash of every label, after which none may change.
    ///
    /// # Errors
    /// Where a label cannot be read or the seal not be written.
    pub fn seal(&self) -> Result<()> {
        write(&self.0.join("seal.json"), &self.hashes()?)
    }

    /// All labels by their sessions' names, as they were sealed.
    ///
    /// # Errors
    /// Where the set is not sealed, or a label is not what it was then.
    pub fn labels(&self) -> Result<Vec<Label>> {
        let place = self.0.join("seal.json");
        let sealed: BTreeMap<String, String> = read(&place, "Make the set to its end: cargo xtask bench make")?;
        let now = self.hashes()?;
        let changed = sealed.iter().chain(&now).find(|(name, _)| sealed.get(*name) != now.get(*name));
        if let Some((name, _)) = changed {
            let why = format!("the label of {name} is not what it was when the set was sealed");
            return Err(Error::input(&place, why, "Make the set anew: its answers prove nothing any more"));
        }
        now.keys().map(|name| read(&self.labels_folder().join(format!("{name}.json")), "Make the set anew")).collect()
    }

    fn hashes(&self) -> Result<BTreeMap<String, String>> {
        let folder = self.labels_folder();
        let unread = |why: std::io::Error| Error::input(&folder, why.to_string(), "Make the set first");
        let mut all = BTreeMap::new();
        for entry in std::fs::read_dir(&folder).map_err(unread)? {
            let path = entry.map_err(unread)?.path();
            let Some(name) = path.file_stem().and_then(|name| name.to_str()) else { continue };
            let hash = Sha256::digest(std::fs::read(&path).map_err(unread)?);
            all.insert(name.to_owned(), hash.iter().map(|byte| format!("{byte:02x}")).collect());
        }
        Ok(all)
    }
}

/// Reads a file of ours.
pub(super) fn read<T: DeserializeOwned>(path: &Path, fix: &str) -> Result<T> {
    let text = std::fs::read_to_string(path).map_err(|why| Error::input(path, why.to_string(), fix))?;
    serde_json::from_str(&text).map_err(|why| Error::input(path, why.to_string(), fix))
}

/// Writes one, whole.
pub(super) fn write(path: &Path, what: &impl Serialize) -> Result<()> {
    let text = serde_json::to_string_pretty(what).expect("data without maps that have no names");
    write_whole(path, (text + "\n").as_bytes())
}

#[cfg(test)]
mod tests {
    use super::super::label::Suite;
    use super::*;

    fn label(session: &str) -> Label {
        Label {
            session: session.to_owned(),
            suite: Suite::NoGap,
            seed: 1,
            hidden: Vec::new(),
            foreign: None,
            far_off: Vec::new(),
            about: BTreeMap::new(),
            truth: None,
            class: Vec::new(),
        }
    }

    #[test]
    fn a_set_is_held_by_one_at_a_time() {
        let folder = tempfile::tempdir().expect("a folder");
        let set = SetFolder(folder.path().to_owned());
        let held = set.alone().expect("nobody holds it");
        let why = set.alone().expect_err("held").to_string();
        assert!(why.contains("another contestant is being run on this set"), "{why}");
        drop(held);
        set.alone().expect("nobody holds it any more");
    }

    #[test]
    fn a_label_that_changes_after_the_seal_is_told() {
        let folder = tempfile::tempdir().expect("a folder");
        let set = SetFolder(folder.path().to_owned());
        let about = About { split: "tuning".to_owned(), seed: 1, commit: "abc".to_owned() };
        set.begin(&about).expect("a new set");
        assert!(set.labels().is_err(), "not sealed yet");
        let labels = [label("a"), label("b")];
        labels.iter().for_each(|label| set.put_label(label).expect("room"));
        set.seal().expect("room");
        assert_eq!(set.labels().expect("sealed"), labels);
        set.put_label(&Label { seed: 2, ..label("b") }).expect("room");
        let why = set.labels().expect_err("changed").to_string();
        assert!(why.contains("the label of b is not what it was"), "{why}");
        set.put_label(&label("b")).expect("room");
        set.put_label(&label("c")).expect("room");
        assert!(set.labels().expect_err("one more").to_string().contains("the label of c"));
        let other = About { seed: 2, ..about };
        assert!(set.begin(&other).expect_err("another").to_string().contains("another set stands there"));
    }
}
