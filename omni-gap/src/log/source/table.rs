//! # Tables in memory: named columns of numbers that some program has already

use super::held::Held;
use super::opened::{OwnClock, Source};
use crate::error::{Error, InputKind, Result};
use crate::log::channel::{Channel, Missing};
use crate::log::run::Sampled;
use std::path::{Path, PathBuf};

/// A recording that is in memory: columns of numbers, named and in the units of a run log.
///
/// Read by [`Run::of_table`](crate::log::Run::of_table), with the checks that a file of the same numbers meets.
#[derive(Debug)]
pub struct Table {
    held: Held,
    /// What is in columns without numbers, by their places.
    others: Vec<(usize, String)>,
}

impl Table {
    /// A table without columns; messages call it `name`, and so is the run called.
    pub fn new(name: &str) -> Table {
        Table { held: Held { path: PathBuf::from(name), ..Held::default() }, others: Vec::new() }
    }

    /// What it is called.
    pub fn name(&self) -> &str {
        self.held.path.to_str().unwrap_or_default()
    }

    /// Whether it has a column of this name.
    pub fn has(&self, column: &str) -> bool {
        self.held.names.iter().any(|name| name == column)
    }

    /// How many rows it has.
    pub fn rows(&self) -> usize {
        self.first().map_or(0, |first| self.held.columns[first].len())
    }

    /// The first column of numbers.
    fn first(&self) -> Option<usize> {
        (0..self.held.columns.len()).find(|column| self.others.iter().all(|(other, _)| other != column))
    }

    fn not_twice(&self, column: &str) -> Result<()> {
        match self.has(column) {
            false => Ok(()),
            true => Err(Error::input(&self.held.path, "the column stands twice in the table", "Keep one of the two")
                .of_kind(InputKind::Conflict)
                .in_column(column)),
        }
    }

    /// Adds a column that holds no numbers but `what`, such as text: it is left out, and refused where it is asked for.
    ///
    /// # Errors
    /// Where the table has the column already.
    pub fn add_other(&mut self, column: &str, what: &str) -> Result<()> {
        self.not_twice(column)?;
        self.others.push((self.held.names.len(), what.to_owned()));
        self.held.names.push(column.to_owned());
        self.held.columns.push(Channel::default());
        Ok(())
    }

    /// Adds a column, one value a row; none is a sample that is missing.
    ///
    /// # Errors
    /// Where the table has the column already, where it has not as many rows as those before, and where a number is not finite.
    pub fn add(&mut self, column: &str, values: impl IntoIterator<Item = Option<f64>>) -> Result<()> {
        self.not_twice(column)?;
        let values = values.into_iter();
        let mut channel = Channel::with_capacity(values.size_hint().0);
        for (row, value) in values.enumerate() {
            match value {
                None => channel.push_missing(Missing::Blank),
                Some(value) if value.is_finite() => channel.push(value),
                Some(value) => {
                    let problem = format!("found `{value}`, expected a finite number");
                    let fix = "Correct the number; one that is missing is none or NaN";
                    return Err(self.held.error_on(row, problem, fix).in_column(column));
                }
            }
        }
        if let Some(first) = self.first().filter(|_| channel.len() != self.rows()) {
            let first = &self.held.names[first];
            let problem = format!("found {} rows, expected {}, as many as `{first}` has", channel.len(), self.rows());
            let fix = "Give every column one value a row; NaN marks a missing sample";
            return Err(Error::input(&self.held.path, problem, fix).of_kind(InputKind::Malformed).in_column(column));
        }
        self.held.names.push(column.to_owned());
        self.held.columns.push(channel);
        Ok(())
    }
}

impl Source for Table {
    fn path(&self) -> &Path {
        self.held.path()
    }

    fn names(&self) -> &[String] {
        self.held.names()
    }

    fn columns(&mut self, wanted: &[usize]) -> Result<Vec<Channel>> {
        let other = wanted.iter().find_map(|wanted| self.others.iter().find(|(column, _)| column == wanted));
        if let Some((column, what)) = other {
            let problem = format!("it holds {what}, expected numbers");
            let fix = "Make numbers of it, or name another column";
            return Err(Error::input(self.path(), problem, fix).in_column(self.title(*column)));
        }
        self.held.columns(wanted)
    }

    fn clock(&self) -> Option<&OwnClock> {
        self.held.clock()
    }

    fn currents_sampled(&self) -> Option<Sampled> {
        self.held.currents_sampled()
    }

    fn notices(&self) -> Vec<String> {
        self.held.notices()
    }
}
