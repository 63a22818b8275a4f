//! One fault of a recording.

use std::path::PathBuf;

use crate::log::Run;

/// What is wrong with a recording, where, and how to mend it.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Fault {
    /// A stable name of the kind of fault.
    pub code: &'static str,
    /// The run's name.
    pub run: String,
    /// The run's file; empty for a run made in memory.
    pub file: PathBuf,
    /// First and last line of the file concerned, counted from 1.
    pub lines: (usize, usize),
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
        let (run, file) = (run.name.clone(), run.path.clone());
        Fault { code, run, file, lines, rows, signal: signal.into(), sentence, fix, fatal }
    }

    /// A fault of a key or table of the robot file.
    pub(super) fn of_robot(code: &'static str, key: &str) -> Fault {
        let name = "robot.toml".to_string();
        let (file, signal) = (PathBuf::from(&name), key.to_string());
        let (sentence, fix) = (String::new(), String::new());
        Fault { code, run: name, file, lines: (1, 1), rows: (0, 0), signal, sentence, fix, fatal: false }
    }

    /// Whether it is one of this run.
    pub(super) fn is_of(&self, run: &Run) -> bool {
        self.run == run.name && self.file == run.path
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
