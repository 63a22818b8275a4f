//! # What to record or measure next: the design of an experiment in words, on a page and for programs
//!
//! [`DesignReport`] is `next.json` and nothing else; [`terminal()`] says it in words, [`html()`] draws it on one page that needs no
//! network, [`write()`] puts both into a folder with the script that is to be played.

mod html;
mod phrases;
mod terminal;

use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::write::put_all;
use crate::engine::findings::{Design, NextExperiment};
use crate::error::Result;
use crate::log::Run;
use crate::vocabulary::Verdict;

pub use html::html;
pub use terminal::terminal;

/// The version of the form of `next.json` that this program writes.
pub const SCHEMA: u32 = 1;

/// The files of a design; of one with nothing to play the first two.
pub const FILES: [&str; 3] = ["next.json", "next.html", NextExperiment::FILE];

/// What to record or measure next.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct DesignReport {
    /// Version of this form.
    pub schema: u32,
    /// Name of the session folder.
    pub session: Option<String>,
    /// What the recordings so far were answered with.
    pub verdict: Verdict,
    /// The causes that were named.
    pub causes: Vec<String>,
    /// What hands would do that no input can: from the card of the cause in question.
    pub by_hand: Option<String>,
    /// The experiment; none where the recordings cannot be used, or leave nothing open that another could show.
    pub design: Option<Design>,
    /// The file with the input to play, beside this one.
    pub file: Option<String>,
}

impl DesignReport {
    /// The text of `next.json`; the same design always gives the same bytes.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("numbers and names have a form in JSON") + "\n"
    }
}

/// The text of the script's file.
pub fn script_csv(script: &Run) -> String {
    let mut text = Vec::new();
    script.write_csv(&mut text).expect("a text takes what is written to it");
    String::from_utf8(text).expect("a table is text")
}

/// Puts the files into the folder, which is made where it is not there, and says where they stand. A script of an older design
/// is taken away where this one has none.
///
/// # Errors
/// Where they cannot be written: which path, why, and how to mend it.
pub fn write(dir: &Path, report: &DesignReport, html: &str, script: Option<&Run>) -> Result<Vec<PathBuf>> {
    let [json, page, table] = FILES;
    let text = report.to_json();
    let script = script.map(script_csv);
    let mut files = vec![(page, html), (json, text.as_str())];
    match &script {
        Some(script) => {
            files.insert(0, (table, script));
            put_all(dir, &files, &[])?;
        }
        None => put_all(dir, &files, &[table])?,
    }
    Ok(files.iter().map(|(name, _)| dir.join(name)).collect())
}
