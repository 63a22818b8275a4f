//! What every opened file of samples can tell, whatever its format.

use crate::error::{Error, Result};
use crate::log::channel::Channel;
use crate::log::run::Sampled;
use std::path::Path;

/// A clock that is no matter of a mapping: that of the messages of a topic.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct OwnClock {
    /// Its column.
    pub column: usize,
    /// Whose times they are, for a person.
    pub told: String,
}

/// Which columns of a recording of topics are kept, by name.
pub(crate) type Keeps<'a> = dyn Fn(&str) -> bool + 'a;

/// An opened file of samples.
pub(crate) trait Source {
    /// The file.
    fn path(&self) -> &Path;

    /// Column names; empty where the format has none.
    fn names(&self) -> &[String];

    /// How many columns there are.
    fn width(&self) -> usize {
        self.names().len()
    }

    /// Reads the wanted columns. Each is read once: what a source holds in memory it hands over.
    fn columns(&mut self, wanted: &[usize]) -> Result<Vec<Channel>>;

    /// The clock that its rows have where no mapping names one; none where a column has to be named `t_s`.
    fn clock(&self) -> Option<&OwnClock> {
        None
    }

    /// The line of the file, counted from 1, on which a row stands, counted from 0; none where the file is not text.
    fn line_of(&self, _row: usize) -> Option<usize> {
        None
    }

    /// When the currents were sampled, where the format itself says so.
    fn currents_sampled(&self) -> Option<Sampled> {
        None
    }

    /// What a person should know of the file, one sentence each.
    fn notices(&self) -> Vec<String> {
        Vec::new()
    }

    /// What a column is called in messages: its name, or its position counted from 1.
    fn title(&self, column: usize) -> String {
        self.names().get(column).cloned().unwrap_or_else(|| format!("{}", column + 1))
    }

    /// A mistake on a row.
    fn error_on(&self, row: usize, problem: String, fix: &str) -> Error {
        match self.line_of(row) {
            Some(line) => Error::input(self.path(), problem, fix).at_line(line),
            None => Error::input(self.path(), format!("row {}: {problem}", row + 1), fix),
        }
    }
}
