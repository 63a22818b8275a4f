//! # Frozen: whole reports that stay as they are while walls move
//!
//! While code is moved and answers are not meant to change, every field of `report.json` and the corrected robot file of
//! many [`recordings`] is held to what it was: one line of `golden/frozen.jsonl` a recording. A field that is new is left
//! aside ([`compare`]); everything else has to be the same number, bit for bit. The tests look at every third of them;
//! `cargo xtask frozen` compares each, and with a folder of real recordings those too (`golden/frozen-real.jsonl`).

pub mod compare;
pub mod layouts;
pub mod recordings;

use omni_gap::error::Result;
use omni_gap::{Diagnosis, Options, Report, Session};
use rayon::prelude::*;
use serde_json::{Value, json};

use crate::real::sessions::{Answered, RealSession, SESSIONS};
use recordings::FrozenCase;

/// The file of the recordings that are made here.
pub const FILE: &str = "frozen.jsonl";

/// The file of the real ones.
pub const REAL_FILE: &str = "frozen-real.jsonl";

/// What a diagnosis leaves, as one value; which engine answered, and with which knobs, is no part of the answer.
fn answer(name: &str, session: &Session) -> Value {
    let diagnosis = Diagnosis::of(session, &Options::default());
    let report = Report { engine: None, ..diagnosis.report };
    json!({ "recording": name, "report": report, "corrected_robot": diagnosis.corrected_robot })
}

/// The answers to recordings, in their order; as many at once as there are threads.
///
/// # Errors
/// Where a recording cannot be made.
pub fn answers(recordings: &[FrozenCase]) -> Result<Vec<Value>> {
    recordings.par_iter().map(|recording| Ok(answer(&recording.name, &recording.session()?))).collect()
}

/// The answers to the real recordings in a folder.
///
/// # Errors
/// Where one of them is not there or not sound.
pub fn real_answers(folder: &std::path::Path) -> Result<Vec<Value>> {
    let answered = |real: &RealSession| -> Result<Value> {
        let Answered { report, corrected_robot } = real.answered(folder)?;
        let report = Report { engine: None, ..report };
        Ok(json!({ "recording": real.title, "report": report, "corrected_robot": corrected_robot }))
    };
    SESSIONS.par_iter().map(answered).collect()
}
