//! ROS 1 recordings (`.bag`, format 2.0), by the library `rosbag`.

use super::container::{Container, Seen, Take};
use super::decoder::{Decoder, Described};
use super::rows::Recorded;
use crate::error::{Error, InputKind, Result};
use rosbag::record_types::Connection;
use rosbag::{ChunkRecord, IndexRecord, MessageRecord, RosBag};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

pub(super) struct Ros1 {
    path: PathBuf,
    bag: RosBag,
}

impl Ros1 {
    /// `head` is the beginning of the file.
    pub fn open(path: &Path, head: &[u8], length: u64) -> Result<Ros1> {
        // where the index stands; the library takes the recorder's word for it
        let key = b"index_pos=";
        let at = head.windows(key.len()).position(|window| window == key).map(|at| at + key.len());
        let place = at.and_then(|at| head.get(at..)?.first_chunk().copied()).map(u64::from_le_bytes);
        if place.is_none_or(|place| place < key.len() as u64 || place > length) {
            let problem = "the recording has no index: it was cut off, or its file is broken";
            return Err(Error::input(path, problem, "Mend it with `rosbag reindex`").of_kind(InputKind::Malformed));
        }
        let bag = RosBag::new(path).map_err(|reason| {
            Error::input(path, format!("cannot be read as a ROS 1 recording: {reason}"), "Check it with `rosbag info`")
                .of_kind(InputKind::Malformed)
        })?;
        Ok(Ros1 { path: path.into(), bag })
    }

    fn connections(&self) -> Result<Vec<Connection<'_>>> {
        let mut all = Vec::new();
        for record in self.bag.index_records() {
            if let IndexRecord::Connection(connection) = record.map_err(|reason| self.broken(&reason))? {
                all.push(connection);
            }
        }
        Ok(all)
    }

    fn broken(&self, reason: &rosbag::Error) -> Error {
        let problem = format!("cannot be read as a ROS 1 recording: {reason}");
        Error::input(&self.path, problem, "Check it with `rosbag info`, mend it with `rosbag reindex`")
            .of_kind(InputKind::Malformed)
    }

    /// Hands over all messages, with the number of their connection.
    fn each(&self, mut take: impl FnMut(u32, Recorded) -> Result<()>) -> Result<()> {
        for record in self.bag.chunk_records() {
            let ChunkRecord::Chunk(chunk) = record.map_err(|reason| self.broken(&reason))? else { continue };
            for message in chunk.messages() {
                if let MessageRecord::MessageData(message) = message.map_err(|reason| self.broken(&reason))? {
                    let recorded = Recorded { log_ns: message.time, publish_ns: message.time, bytes: message.data };
                    take(message.conn_id, recorded)?;
                }
            }
        }
        Ok(())
    }
}

fn decoder(connection: &Connection) -> std::result::Result<Decoder, String> {
    Decoder::of(Described {
        encoding: "ros1",
        language: "ros1msg",
        name: connection.tp,
        definition: connection.message_definition.as_bytes(),
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
            let topic = connection.storage_topic.to_owned();
            let new = || Seen { topic: topic.clone(), of_type: connection.tp.to_owned(), messages: 0 };
            topics.entry(topic.clone()).or_insert_with(new).messages += messages.get(&connection.id).unwrap_or(&0);
        }
        Ok(topics.into_values().filter(|seen| seen.messages > 0).collect())
    }

    fn messages(&self, topic: &str, take: &mut Take) -> Result<Option<String>> {
        let mut decoders = BTreeMap::new();
        for connection in self.connections()?.iter().filter(|connection| connection.storage_topic == topic) {
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
