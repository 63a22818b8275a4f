//! A robot's records, as columns of samples.

use super::held::Held;
use crate::error::Result;
use crate::log::channel::Channel;
use crate::log::records::capture::Capture;
use crate::log::records::run::{notices, run};
use crate::log::toml_walk::read_bytes;
use std::path::Path;

/// The columns of a file of records.
pub(super) fn open(path: &Path) -> Result<Held> {
    let mut capture = Capture::new(None);
    capture.take(&read_bytes(path, "a file of a robot's records")?);
    let run = run(&capture, path, "", None)?;
    let notices = notices(&capture).into_iter().map(|notice| format!("{}: {notice}", path.display())).collect();
    drop(capture);
    let (names, columns): (Vec<String>, Vec<Channel>) =
        run.signals().into_iter().map(|(name, channel)| (name, channel.clone())).unzip();
    let names = std::iter::once("t_s".to_owned()).chain(names).collect();
    let sampled = Some(run.currents_sampled);
    let columns = std::iter::once(Channel::from_values(run.t_s)).chain(columns).collect();
    Ok(Held { path: path.into(), names, columns, clock: None, sampled, notices })
}
