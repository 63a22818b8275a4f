//! What is known of a session from elsewhere: from the papers and scripts of those who recorded it, and from a look at the
//! numbers themselves, written down before any answer to it was looked at.
//!
//! One file of `known/` a session. A file that is changed after an answer was seen says why, under `changed`.

use std::collections::BTreeSet;

use model_core::effects::EffectKind;
use model_core::effects::nominal::NOMINAL;
use omni_gap::Verdict;
use omni_gap::report::Stage;
use serde::Deserialize;

/// What is known of a session, and which answers to it may be right.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Known {
    /// The session, as [`RealSession::key`](super::sessions::RealSession::key) has it.
    pub session: String,
    /// Verdicts that may be right.
    pub verdicts: Vec<Verdict>,
    /// Names of the stages in which the largest share of the gap may lie; any, where none is given.
    #[serde(default)]
    pub stages: Vec<String>,
    /// Causes that an answer which names causes has to have.
    #[serde(default)]
    pub causes_required: Required,
    /// Causes that cannot be.
    #[serde(default)]
    pub causes_impossible: Vec<Impossible>,
    /// What all this rests on.
    pub known: Vec<Fact>,
    /// Why the file was changed after an answer to it was seen.
    #[serde(default)]
    pub changed: Vec<String>,
}

/// Causes that have to be among the answers.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Required {
    /// Each of these.
    #[serde(default)]
    pub all_of: Vec<String>,
    /// At least one of each list.
    #[serde(default)]
    pub any_of: Vec<Vec<String>>,
}

/// Causes that cannot be, and why.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Impossible {
    /// Their ids.
    pub causes: Vec<String>,
    /// Why.
    pub why: String,
}

/// Something known.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fact {
    /// What is known.
    pub what: String,
    /// From which public source, or how it was measured in the recordings.
    pub source: String,
}

impl Required {
    /// Every cause that is asked for.
    pub fn causes(&self) -> impl Iterator<Item = &String> {
        self.all_of.iter().chain(self.any_of.iter().flatten())
    }
}

impl Known {
    /// Reads a file of what is known.
    ///
    /// # Errors
    /// What is wrong with it, in a sentence.
    pub fn read(text: &str) -> Result<Self, String> {
        let known: Self = toml::from_str(text).map_err(|why| why.to_string())?;
        known.checked().map_err(|what| format!("{}: {what}", known.session))?;
        Ok(known)
    }

    /// Why a cause cannot be, if it cannot.
    pub fn impossible(&self, cause: &str) -> Option<&str> {
        let of = self.causes_impossible.iter().find(|group| group.causes.iter().any(|id| id == cause))?;
        Some(&of.why)
    }

    fn checked(&self) -> Result<(), String> {
        if self.verdicts.is_empty() {
            return Err("`verdicts` is empty: no answer could be right".to_owned());
        }
        if self.known.is_empty() {
            return Err("nothing is known: add a [[known]] table with `what` and `source`".to_owned());
        }
        if self.known.iter().any(|fact| fact.what.trim().is_empty() || fact.source.trim().is_empty()) {
            return Err("a [[known]] table lacks its `what` or its `source`".to_owned());
        }
        if self.causes_required.any_of.iter().any(Vec::is_empty) {
            return Err("a list in `any_of` is empty: nothing could satisfy it".to_owned());
        }
        let is_stage = |name: &String| Stage::ALL.iter().any(|stage| stage.name() == name);
        if let Some(name) = self.stages.iter().find(|name| !is_stage(name)) {
            return Err(format!("`{name}` is no stage"));
        }
        let mut impossible = BTreeSet::new();
        for cause in self.causes_impossible.iter().flat_map(|group| &group.causes) {
            if !impossible.insert(cause) {
                return Err(format!("`{cause}` cannot be twice"));
            }
        }
        for cause in self.causes_required.causes().chain(impossible.iter().copied()) {
            if !is_cause(cause) {
                return Err(format!("`{cause}` is not in the catalogue"));
            }
        }
        match self.causes_required.causes().find(|cause| impossible.contains(cause)) {
            Some(both) => Err(format!("`{both}` is required and cannot be")),
            None => Ok(()),
        }
    }
}

/// True of an effect of the catalogue and of a number of the robot file that can be a cause.
fn is_cause(id: &str) -> bool {
    EffectKind::find(id).is_some() || NOMINAL.iter().any(|card| card.id == id)
}

#[cfg(test)]
mod tests {
    use super::super::sessions::SESSIONS;
    use super::*;

    const SOUND: &str = "session = \"a\"\nverdicts = [\"effect\"]\nstages = [\"contact\"]\n\
        [causes_required]\nall_of = [\"creep\"]\nany_of = [[\"mass\", \"inertia\"]]\n\
        [[causes_impossible]]\ncauses = [\"gyro_bias\"]\nwhy = \"no gyro\"\n\
        [[known]]\nwhat = \"it creeps\"\nsource = \"a look\"\n";

    /// What is said of a sound file in which a text stands for another.
    fn said(of: &str, instead: &str) -> String {
        assert!(SOUND.contains(of), "{of}");
        Known::read(&SOUND.replacen(of, instead, 1)).unwrap_err()
    }

    #[test]
    fn every_session_has_a_sound_file_of_its_own() {
        let mut keys = BTreeSet::new();
        for real in SESSIONS {
            let known = Known::read(real.known).unwrap_or_else(|why| panic!("{}: {why}", real.title));
            assert_eq!(known.session, real.key);
            assert!(keys.insert(known.session), "{}: two sessions have one file", real.key);
        }
    }

    #[test]
    fn a_sound_file_is_read() {
        let known = Known::read(SOUND).unwrap();
        assert_eq!((known.impossible("gyro_bias"), known.impossible("creep")), (Some("no gyro"), None));
        assert_eq!(known.causes_required.causes().count(), 3);
    }

    #[test]
    fn what_is_wrong_with_a_file_is_said() {
        assert!(said("creep", "crepe").contains("a: `crepe` is not in the catalogue"));
        assert!(said("\"contact\"", "\"floor\"").contains("`floor` is no stage"));
        assert!(said("gyro_bias", "creep").contains("`creep` is required and cannot be"));
        assert!(said("[\"effect\"]", "[]").contains("no answer could be right"));
        assert!(said("\"effect\"", "\"effects\"").contains("unknown variant `effects`"));
        assert!(said("stages", "stage").contains("unknown field `stage`"));
        assert!(said("[\"mass\", \"inertia\"]", "[]").contains("a list in `any_of` is empty"));
        assert!(said("a look", " ").contains("`source`"));
        assert!(said("source = \"a look\"\n", "").contains("missing field `source`"));
        assert!(said("\"gyro_bias\"", "\"gyro_bias\", \"gyro_bias\"").contains("cannot be twice"));
    }
}
