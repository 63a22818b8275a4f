//! An answer: in words for people, as JSON for programs.

use std::path::{Path, PathBuf};

use omni_gap::Error;
use omni_gap::check::Fault;
use omni_gap::identify::Informativity;
use omni_gap::proposal::Proposal;
use schemars::JsonSchema;
use serde::Serialize;

use super::cli_error::CliError;
use super::console::Console;

/// The version of the forms below.
pub const SCHEMA: u32 = 1;

/// In which form a command answers.
#[derive(Clone, Copy, Debug, clap::Args)]
pub struct AnswerForm {
    /// Print the answer as JSON in place of text; `omni-gap schema` tells its form
    #[arg(long)]
    json: bool,
}

impl AnswerForm {
    /// Says an answer.
    pub fn say(self, console: &Console, text: &str, answer: &impl Serialize) -> Result<(), CliError> {
        if self.json { say_json(console, answer) } else { console.say(text) }
    }
}

/// Says an answer as JSON.
pub fn say_json(console: &Console, answer: &impl Serialize) -> Result<(), CliError> {
    console.say(&json(answer, Path::new(STANDARD_OUTPUT), WITHOUT_JSON)?)
}

/// One line of an answer that has no end of its own, as JSON.
pub fn json_line(line: &impl Serialize) -> Result<String, CliError> {
    written(serde_json::to_string(line), Path::new(STANDARD_OUTPUT), WITHOUT_JSON)
}

const STANDARD_OUTPUT: &str = "standard output";
const WITHOUT_JSON: &str = "Ask without --json, and tell the makers of omni-gap";

/// The text of an answer as JSON, for a place; what cannot be written is told with what to do about it.
pub fn json(answer: &impl Serialize, place: &Path, fix: &str) -> Result<String, CliError> {
    written(serde_json::to_string_pretty(answer), place, fix)
}

fn written(json: serde_json::Result<String>, place: &Path, fix: &str) -> Result<String, CliError> {
    Ok(json.map_err(|why| Error::output(place, why.to_string(), fix))? + "\n")
}

/// A run that was written.
#[derive(Debug, JsonSchema, Serialize)]
pub struct RunWritten {
    /// Version of this form.
    pub schema: u32,
    /// The file.
    pub file: PathBuf,
    /// Its rows.
    pub rows: usize,
    /// What a person should know of it.
    pub notices: Vec<String>,
}

impl RunWritten {
    /// A run of so many rows in a file.
    pub fn of(file: &Path, rows: usize) -> Self {
        Self { schema: SCHEMA, file: file.to_owned(), rows, notices: Vec::new() }
    }
}

/// Files that were written.
#[derive(Debug, JsonSchema, Serialize)]
pub struct FilesWritten {
    /// Version of this form.
    pub schema: u32,
    /// The files, or the folder of all of them.
    pub files: Vec<PathBuf>,
    /// What a person should know of them.
    pub notices: Vec<String>,
}

impl FilesWritten {
    /// Files of which there is no more to know.
    pub fn of(files: Vec<PathBuf>) -> Self {
        Self { schema: SCHEMA, files, notices: Vec::new() }
    }
}

/// Recordings that were checked.
#[derive(Debug, JsonSchema, Serialize)]
pub struct RunsChecked<'a> {
    /// Version of this form.
    pub schema: u32,
    /// How many runs.
    pub runs: usize,
    /// Whether a diagnosis can use them.
    pub usable: bool,
    /// What is wrong with them, and how to mend it.
    pub faults: &'a [Fault],
    /// How well they could tell the robot file's numbers at best; none of recordings that a diagnosis cannot use.
    pub informativity: Option<&'a Informativity>,
    /// What a person should know of them.
    pub notices: &'a [String],
}

/// A mapping that was proposed.
#[derive(Debug, JsonSchema, Serialize)]
pub struct MappingProposed<'a> {
    /// Version of this form.
    pub schema: u32,
    /// The file; none where it was only printed.
    pub file: Option<PathBuf>,
    /// What stands in it.
    #[serde(flatten)]
    pub proposal: &'a Proposal,
}

/// A robot file whose numbers were fitted.
#[derive(Debug, JsonSchema, Serialize)]
pub struct NumbersFitted<'a> {
    /// Version of this form.
    pub schema: u32,
    /// The file.
    pub file: PathBuf,
    /// The numbers.
    #[serde(flatten)]
    pub found: &'a omni_gap::api::Identification,
}

/// A parameter block that was written.
#[derive(Debug, JsonSchema, Serialize)]
pub struct BlockWritten {
    /// Version of this form.
    pub schema: u32,
    /// The file.
    pub file: PathBuf,
    /// Its size (bytes).
    pub bytes: usize,
    /// Its checksum, which the robot tells when it runs with it.
    pub checksum: u32,
    /// Effects that the robot undoes.
    pub undone: Vec<String>,
    /// Effects that it does not undo, each with the reason.
    pub not_undone: Vec<String>,
}

/// What can be explained.
#[derive(Debug, JsonSchema, Serialize)]
pub struct Explained {
    /// Version of this form.
    pub schema: u32,
    /// Everything that has a page; where one was asked for, that one.
    pub entries: Vec<Entry>,
    /// The page that was asked for.
    pub page: Option<String>,
}

/// Something that has a page.
#[derive(Debug, JsonSchema, Serialize)]
pub struct Entry {
    /// Its id.
    pub id: &'static str,
    /// Its name.
    pub title: &'static str,
    /// `effect`, `parameter` or `file`.
    pub kind: &'static str,
    /// The stage of an effect.
    pub stage: Option<&'static str>,
}
