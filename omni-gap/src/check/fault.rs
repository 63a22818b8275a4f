//! One fault of a recording.

use std::path::PathBuf;

use crate::log::Run;

/// What is wrong with a recording, where, and how to mend it.
#[derive(Debug, Clone, PartialEq, schemars::JsonSchema, serde::Serialize)]
pub struct Fault {
    /// A stable name of the kind of fault.
    pub code: &'static str,
    /// The run's name.
    pub run: String,
    /// The run's file; empty for a run made in memory.
    pub file: PathBuf,
    /// First and last line of the file concerned, counted from 1; rows, where the file is not text.
    pub lines: (usize, usize),
    /// Whether the file has lines.
    pub is_text: bool,
    /// First and last row concerned; data rows counted from 0, the header not counted.
    pub rows: (usize, usize),
    /// The column or group concerned.
    pub signal: String,
    /// What was seen.
    pub sentence: String,
    /// How to mend it.
    pub fix: String,
    /// Whether nothing may be fitted on this log.
    pub fatal: bool,
}

impl Fault {
    /// A fault of a whole run.
    pub(super) fn of(run: &Run, code: &'static str, signal: impl Into<String>, fatal: bool) -> Fault {
        let rows = (0, run.rows().saturating_sub(1));
        let lines = (run.line_of(rows.0), run.line_of(rows.1));
        let (sentence, fix) = (String::new(), String::new());
        let (run, file, is_text) = (run.name.clone(), run.path.clone(), run.is_text());
        Fault { code, run, file, lines, is_text, rows, signal: signal.into(), sentence, fix, fatal }
    }

    /// A fault of a key or table of the robot file.
    pub(super) fn of_robot(code: &'static str, key: &str) -> Fault {
        let name = "robot.toml".to_string();
        let (file, signal) = (PathBuf::from(&name), key.to_string());
        let (sentence, fix) = (String::new(), String::new());
        Fault { code, run: name, file, lines: (1, 1), is_text: true, rows: (0, 0), signal, sentence, fix, fatal: false }
    }

    /// Whether it is one of this run.
    pub(super) fn is_of(&self, run: &Run) -> bool {
        let in_file = self.file == run.path || run.files.iter().any(|file| self.file == file.path);
        self.run == run.name && in_file
    }

    /// The same fault told of another run's file, where its rows are others.
    pub(super) fn in_run(self, run: &Run, row: impl Fn(usize) -> usize) -> Fault {
        let (first, last) = (row(self.rows.0), row(self.rows.1));
        let (file, is_text, line) = (run.path.clone(), run.is_text(), run.line_of(0));
        Fault { file, is_text, lines: (line, line), rows: (0, 0), ..self }.at(first, last)
    }

    /// The run; with its file, where several make the run.
    pub fn place(&self) -> String {
        let is_folder =
            self.file.parent().and_then(|folder| folder.file_name()).is_some_and(|name| name == self.run.as_str());
        let file = self.file.file_name().filter(|_| is_folder);
        file.map_or(self.run.clone(), |file| format!("{}/{}", self.run, file.to_string_lossy()))
    }

    /// "line 3" or "lines 3 to 7"; "rows …" of a file that is not text.
    pub fn lines_in_words(&self) -> String {
        let word = if self.is_text { "line" } else { "row" };
        match self.lines {
            (first, last) if first == last => format!("{word} {first}"),
            (first, last) => format!("{word}s {first} to {last}"),
        }
    }

    pub(super) fn at(mut self, first: usize, last: usize) -> Fault {
        let first_line = self.lines.0 - self.rows.0;
        self.rows = (first, last);
        self.lines = (first_line + first, first_line + last);
        self
    }

    pub(super) fn says(mut self, sentence: impl Into<String>, fix: impl Into<String>) -> Fault {
        self.sentence = sentence.into();
        self.fix = fix.into();
        self
    }
}
