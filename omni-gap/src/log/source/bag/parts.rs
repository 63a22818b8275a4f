//! The folder that rosbag2 records into: parts of one recording, which `metadata.yaml` lists in their order.

use super::container::{Container, Seen, Take};
use super::listed::{LIST, listed};
use crate::error::{Error, InputKind, Result};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// What a recorder of ROS 2 writes beside its recording.
pub(in crate::log) const METADATA: &str = "metadata.yaml";

/// A recording that was split into files.
pub(super) struct Parts(pub Vec<Box<dyn Container>>);

/// Whether a path is the folder of such a recording.
pub(in crate::log) fn is_recording(path: &Path) -> bool {
    path.is_dir() && path.join(METADATA).is_file()
}

/// The files of the recording in a folder, in their order.
pub(in crate::log) fn files(folder: &Path) -> Result<Vec<PathBuf>> {
    let metadata = folder.join(METADATA);
    let text = std::fs::read_to_string(&metadata).map_err(|reason| Error::unreadable(&metadata, &reason))?;
    let fix = "Write it anew: `ros2 bag reindex`, with the folder behind it; or remove it to have each file as a recording of its own";
    let wrong = |problem: String| Error::input(&metadata, problem, fix).of_kind(InputKind::Malformed);
    let list = listed(&text).map_err(|reason| wrong(format!("is no YAML: {reason}")))?;
    let expected = || wrong(format!("expected a list of files at {}, as rosbag2 writes it", LIST.join(".")));
    let list = list.filter(|list| !list.is_empty()).ok_or_else(expected)?;
    let file = |item: &String| {
        // early recorders wrote the folder before it
        let name = Path::new(item).file_name().ok_or_else(expected)?;
        let file = folder.join(name);
        match file.is_file() {
            true => Ok(file),
            false => Err(wrong(format!("lists `{}`, which is not in the folder", name.to_string_lossy()))),
        }
    };
    list.iter().map(file).collect()
}

impl Container for Parts {
    fn topics(&self) -> Result<Vec<Seen>> {
        let mut all: BTreeMap<String, Seen> = BTreeMap::new();
        for part in &self.0 {
            for seen in part.topics()? {
                let messages = seen.messages;
                all.entry(seen.topic.clone()).and_modify(|known| known.messages += messages).or_insert(seen);
            }
        }
        Ok(all.into_values().collect())
    }

    fn messages(&self, topic: &str, take: &mut Take) -> Result<Option<String>> {
        let mut amiss = None;
        for part in &self.0 {
            amiss = part.messages(topic, take)?.or(amiss);
        }
        Ok(amiss)
    }
}
