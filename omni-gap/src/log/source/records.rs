//! A robot's records, as columns of samples.

use super::opened::Source;
use crate::error::Result;
use crate::log::channel::Channel;
use crate::log::records::capture::Capture;
use crate::log::records::run::{notices, run};
use crate::log::run::Sampled;
use crate::log::toml_walk::read_bytes;
use std::path::{Path, PathBuf};

/// The columns of an opened file of records.
pub(super) struct Records {
    path: PathBuf,
    names: Vec<String>,
    columns: Vec<Channel>,
    sampled: Sampled,
    notices: Vec<String>,
}

impl Records {
    pub fn open(path: &Path) -> Result<Records> {
        let mut capture = Capture::new(None);
        capture.take(&read_bytes(path, "a file of a robot's records")?);
        let run = run(&capture, path, "", None)?;
        let notices = notices(&capture).into_iter().map(|notice| format!("{}: {notice}", path.display())).collect();
        drop(capture);
        let (names, columns): (Vec<String>, Vec<Channel>) =
            run.signals().into_iter().map(|(name, channel)| (name, channel.clone())).unzip();
        let names = std::iter::once("t_s".to_owned()).chain(names).collect();
        let sampled = run.currents_sampled;
        let columns = std::iter::once(Channel::from_values(run.t_s)).chain(columns).collect();
        Ok(Records { path: path.into(), names, columns, sampled, notices })
    }
}

impl Source for Records {
    fn path(&self) -> &Path {
        &self.path
    }

    fn names(&self) -> &[String] {
        &self.names
    }

    fn width(&self) -> usize {
        self.names.len()
    }

    fn columns(&self, wanted: &[usize]) -> Result<Vec<Channel>> {
        Ok(wanted.iter().map(|column| self.columns[*column].clone()).collect())
    }

    fn line_of(&self, _: usize) -> Option<usize> {
        None
    }

    fn currents_sampled(&self) -> Option<Sampled> {
        Some(self.sampled)
    }

    fn notices(&self) -> Vec<String> {
        self.notices.clone()
    }
}
