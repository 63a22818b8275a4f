//! ROS 1 recordings (`.bag`, format 2.0).

use super::container::{Container, Seen, Take};
use super::decoder::{Decoder, Described};
use super::ros1_reader::{Bag, Connection};
use super::rows::Recorded;
use crate::error::{Error, InputKind, Result};
use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};

pub(super) struct Ros1 {
    path: PathBuf,
    bag: Bag,
}

impl Ros1 {
    pub fn open(path: &Path, file: File) -> Result<Ros1> {
        let bag = Bag::open(file).map_err(|reason| broken(path, &reason))?.ok_or_else(|| {
            let problem = "the recording has no index: it was cut off, or its file is broken";
            Error::input(path, problem, "Mend it with `rosbag reindex`").of_kind(InputKind::Malformed)
        })?;
        Ok(Ros1 { path: path.into(), bag })
    }

    fn connections(&self) -> Result<Vec<Connection>> {
        self.bag.connections().map_err(|reason| broken(&self.path, &reason))
    }

    /// Hands over all messages, with the number of their connection.
    fn each(&self, mut take: impl FnMut(u32, Recorded) -> Result<()>) -> Result<()> {
        self.bag.each(
            |reason| broken(&self.path, &reason),
            |message| {
                let (log_ns, bytes) = (message.time_ns, message.bytes);
                take(message.connection, Recorded { log_ns, publish_ns: log_ns, bytes })
            },
        )
    }
}

fn broken(path: &Path, reason: &str) -> Error {
    let problem = format!("cannot be read as a ROS 1 recording: {reason}");
    Error::input(path, problem, "Check it with `rosbag info`, mend it with `rosbag reindex`")
        .of_kind(InputKind::Malformed)
}

fn decoder(connection: &Connection) -> std::result::Result<Decoder, String> {
    Decoder::of(Described {
        encoding: "ros1",
        language: "ros1msg",
        name: &connection.of_type,
        definition: connection.definition.as_bytes(),
    })
}

impl Container for Ros1 {
    fn topics(&self) -> Result<Vec<Seen>> {
        let mut messages: BTreeMap<u32, usize> = BTreeMap::new();
        self.each(|connection, _| {
            *messages.entry(connection).or_default() += 1;
            Ok(())
        })?;
        let mut topics: BTreeMap<String, Seen> = BTreeMap::new();
        for connection in self.connections()? {
            let Connection { id, topic, of_type, .. } = connection;
            let new = || Seen { topic: topic.clone(), of_type, messages: 0 };
            topics.entry(topic.clone()).or_insert_with(new).messages += messages.get(&id).unwrap_or(&0);
        }
        Ok(topics.into_values().filter(|seen| seen.messages > 0).collect())
    }

    fn messages(&self, topic: &str, take: &mut Take) -> Result<Option<String>> {
        let mut decoders = BTreeMap::new();
        for connection in self.connections()?.iter().filter(|connection| connection.topic == topic) {
            let decoder = decoder(connection).map_err(|reason| {
                let problem = format!("topic `{topic}` cannot be read: {reason}");
                Error::input(&self.path, problem, "Map another topic").of_kind(InputKind::Malformed)
            })?;
            decoders.insert(connection.id, decoder);
        }
        self.each(|connection, recorded| match decoders.get(&connection) {
            Some(decoder) => take(decoder, recorded),
            None => Ok(()),
        })?;
        Ok(None)
    }
}
