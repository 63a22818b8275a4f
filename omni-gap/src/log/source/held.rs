//! Columns that are held in memory, of whatever format they were.

use super::opened::{OwnClock, Source};
use crate::error::Result;
use crate::log::channel::Channel;
use crate::log::run::Sampled;
use std::path::{Path, PathBuf};

/// The columns of a file that was read whole.
#[derive(Debug, Default)]
pub(super) struct Held {
    pub path: PathBuf,
    pub names: Vec<String>,
    /// A column for each name.
    pub columns: Vec<Channel>,
    /// The clock of its rows, where nobody says which column it is.
    pub clock: Option<OwnClock>,
    pub sampled: Option<Sampled>,
    pub notices: Vec<String>,
}

impl Source for Held {
    fn path(&self) -> &Path {
        &self.path
    }

    fn names(&self) -> &[String] {
        &self.names
    }

    fn columns(&mut self, wanted: &[usize]) -> Result<Vec<Channel>> {
        let handed_over = |(k, column): (usize, &usize)| match wanted[k + 1..].contains(column) {
            true => self.columns[*column].clone(),
            false => std::mem::take(&mut self.columns[*column]),
        };
        Ok(wanted.iter().enumerate().map(handed_over).collect())
    }

    fn clock(&self) -> Option<&OwnClock> {
        self.clock.as_ref()
    }

    fn currents_sampled(&self) -> Option<Sampled> {
        self.sampled
    }

    fn notices(&self) -> Vec<String> {
        self.notices.clone()
    }
}
