//! # What can be wrong with what we were given
//!
//! One message per mistake: where it stands, what was found, what was expected, how to mend it. The command maps every
//! [`Error`] to exit code 2.

use std::fmt;
use std::path::{Path, PathBuf};

/// The result of everything that touches a file.
pub type Result<T> = std::result::Result<T, Error>;

/// What kind of mistake an input has, for programs that want to act on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum InputKind {
    /// There is no such file or folder.
    NotFound,
    /// It is there and cannot be read: no permission, a folder for a file, a line that breaks off.
    Unreadable,
    /// It can be read and is not of its form: not text, not TOML, no table of equal rows.
    Malformed,
    /// It has a newer form than this program knows.
    Newer,
    /// Something that is needed is not in it: a table, a key, a column, a signal.
    Missing,
    /// It names something that there is not: a key, a column, an effect.
    Unknown,
    /// A value is not of the kind, or not within the bounds, that are expected there.
    Invalid,
    /// Two things in it do not go together.
    Conflict,
    /// It is sound, and too little to work with.
    TooLittle,
}

/// A mistake in a file, or a place that cannot be written to.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Error {
    /// A file or folder that was given cannot be used as it is.
    #[error("{}{}: {}. {}", Place(file, *line), InColumn(column.as_deref()), Printable(problem), Printable(fix))]
    Input {
        /// What kind of mistake it is.
        kind: InputKind,
        /// The file or folder.
        file: PathBuf,
        /// The line in the file, counted from 1.
        line: Option<usize>,
        /// The column of a log, or the key of a TOML file.
        column: Option<String>,
        /// What was found and what was expected.
        problem: String,
        /// How to mend it.
        fix: String,
    },
    /// A recording with a fault that spoils any fit.
    #[error("{}: {} {}", Place(file, None), Printable(problem), Printable(fix))]
    Faulty {
        /// The fault's code, as `check` tells it.
        code: &'static str,
        /// The run.
        file: PathBuf,
        /// Where it is, and what is wrong.
        problem: String,
        /// How to mend it.
        fix: String,
    },
    /// An output cannot be written.
    #[error("{}: cannot be written: {}. {}", Place(path, None), Printable(reason), Printable(fix))]
    Output {
        /// The file that was to be written.
        path: PathBuf,
        /// Why it cannot be.
        reason: String,
        /// How to mend it.
        fix: String,
    },
}

impl Error {
    /// A file that cannot be opened or read.
    pub fn unreadable(file: &Path, reason: &std::io::Error) -> Error {
        Self::input(file, format!("cannot be read: {reason}"), "Check the path and the file's permissions")
            .of_kind(InputKind::Unreadable)
    }

    /// A value in `file` that is not what was expected; of another kind, say so with [`Error::of_kind`].
    pub fn input(file: &Path, problem: impl Into<String>, fix: impl Into<String>) -> Error {
        let (problem, fix) = (problem.into(), fix.into());
        Error::Input { kind: InputKind::Invalid, file: file.into(), line: None, column: None, problem, fix }
    }

    /// The same mistake, of this kind.
    pub fn of_kind(mut self, is: InputKind) -> Error {
        if let Error::Input { kind, .. } = &mut self {
            *kind = is;
        }
        self
    }

    /// The kind of mistake that an input has; none of an output, and of a recording that is only faulty.
    pub fn input_kind(&self) -> Option<InputKind> {
        match self {
            Error::Input { kind, .. } => Some(*kind),
            Error::Faulty { .. } | Error::Output { .. } => None,
        }
    }

    /// The same mistake, with the line (counted from 1) where it stands.
    pub fn at_line(mut self, at: usize) -> Error {
        if let Error::Input { line, .. } = &mut self {
            *line = Some(at);
        }
        self
    }

    /// The same mistake, with the column or key it stands in.
    pub fn in_column(mut self, name: impl Into<String>) -> Error {
        if let Error::Input { column, .. } = &mut self {
            *column = Some(name.into());
        }
        self
    }

    /// An output that cannot be written.
    pub fn output(path: &Path, reason: impl Into<String>, fix: impl Into<String>) -> Error {
        Error::Output { path: path.into(), reason: reason.into(), fix: fix.into() }
    }
}

struct Place<'a>(&'a Path, Option<usize>);

impl fmt::Display for Place<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", Printable(&self.0.to_string_lossy()))?;
        self.1.map_or(Ok(()), |line| write!(f, ":{line}"))
    }
}

struct InColumn<'a>(Option<&'a str>);

impl fmt::Display for InColumn<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.map_or(Ok(()), |name| write!(f, ": column `{}`", Printable(name)))
    }
}

/// Text of which some may come from a file that nobody knows: in one line, without what would speak to the terminal, and no longer than
/// a person reads.
struct Printable<'a>(&'a str);

/// Characters of the beginning and of the end that are shown of a longer text.
const SHOWN: [usize; 2] = [600, 200];

impl fmt::Display for Printable<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [head, tail] = SHOWN;
        let length = self.0.chars().count();
        let left_out = if length > head + tail { head..length - tail } else { length..length };
        for (k, c) in self.0.chars().enumerate() {
            match c {
                _ if k == left_out.start => f.write_str(" … ")?,
                _ if left_out.contains(&k) => {}
                c if c.is_control() => write!(f, "{}", c.escape_default())?,
                c => write!(f, "{c}")?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mistake_names_file_line_column_problem_and_mend() {
        let error = Error::input(Path::new("a.csv"), "found `x`, expected a number", "Correct the field.")
            .at_line(3)
            .in_column("u0_V");
        assert_eq!(error.to_string(), "a.csv:3: column `u0_V`: found `x`, expected a number. Correct the field.");
    }

    #[test]
    fn what_a_file_holds_does_not_speak_to_the_terminal() {
        let error = Error::input(Path::new("a\nb.csv"), "found `\u{1b}[2J`, expected a number", "Correct the field")
            .in_column("\u{7}");
        assert_eq!(
            error.to_string(),
            "a\\nb.csv: column `\\u{7}`: found `\\u{1b}[2J`, expected a number. Correct the field"
        );
    }

    #[test]
    fn of_a_field_that_is_a_book_the_beginning_and_the_end_are_told() {
        let error = Error::input(Path::new("a.csv"), format!("found `{}`", "é".repeat(1_000_000)), "Correct the field");
        let said = error.to_string();
        assert!(said.chars().count() < 900 && said.starts_with("a.csv: found `é") && said.contains("é … é"), "{said}");
        assert!(said.ends_with("é`. Correct the field"), "{said}");
    }

    #[test]
    fn an_output_that_cannot_be_written_says_why() {
        let error = Error::output(Path::new("out"), "it is a folder", "Name a file.");
        assert_eq!(error.to_string(), "out: cannot be written: it is a folder. Name a file.");
    }
}
