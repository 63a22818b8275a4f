//! MCAP: a recording in chunks, by its own library; memory is bounded by the largest chunk.

use super::container::{Container, Seen, Take};
use super::decoder::{Decoder, Described};
use super::mcap_reader::{Channel, Message, Messages, Stop};
use super::rows::Recorded;
use crate::error::{Error, InputKind, Result};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

pub(super) struct Mcap {
    path: PathBuf,
    file: File,
}

const CUT_OFF: &str = "the recording ends in the middle of a record; what stands before it was read";

impl Mcap {
    pub fn open(path: &Path, file: File) -> Mcap {
        Mcap { path: path.into(), file }
    }

    /// Hands over all messages; says so where the recording was cut off.
    fn each(&self, mut take: impl FnMut(Message) -> Result<()>) -> Result<Option<String>> {
        let unreadable = |reason| Error::input(&self.path, format!("cannot be read: {reason}"), "Check the disk");
        let mut file = self.file.try_clone().map_err(unreadable)?;
        std::io::Seek::rewind(&mut file).map_err(unreadable)?;
        let length = file.metadata().map_err(unreadable)?.len();
        let mut any = false;
        for message in Messages::new(BufReader::new(file), length) {
            match message {
                Ok(message) => take(message)?,
                // what a recorder leaves that lost its power
                Err(Stop::CutOff) if any => return Ok(Some(CUT_OFF.into())),
                Err(Stop::CutOff) => return Err(self.broken("it ends before its first message")),
                Err(Stop::Broken(reason)) => return Err(self.broken(&reason)),
            }
            any = true;
        }
        Ok(None)
    }

    fn broken(&self, reason: &str) -> Error {
        let fix = "Check the file with `mcap doctor`, or mend it with `mcap recover`";
        Error::input(&self.path, format!("cannot be read as MCAP: {reason}"), fix).of_kind(InputKind::Malformed)
    }
}

fn decoder(channel: &Channel) -> std::result::Result<Decoder, String> {
    let schema = channel.schema.as_ref();
    Decoder::of(Described {
        encoding: &channel.encoding,
        language: schema.map_or("", |schema| &schema.encoding),
        name: schema.map_or("", |schema| &schema.name),
        definition: schema.map_or(&[], |schema| &schema.data),
    })
}

impl Container for Mcap {
    fn topics(&self) -> Result<Vec<Seen>> {
        let mut topics: BTreeMap<String, Seen> = BTreeMap::new();
        self.each(|message| {
            let topic = &message.channel.topic;
            let of_type = || message.channel.schema.as_ref().map_or(String::new(), |schema| schema.name.clone());
            let new = || Seen { topic: topic.clone(), of_type: of_type(), messages: 0 };
            topics.entry(topic.clone()).or_insert_with(new).messages += 1;
            Ok(())
        })?;
        Ok(topics.into_values().collect())
    }

    fn messages(&self, topic: &str, take: &mut Take) -> Result<Option<String>> {
        let mut decoders: BTreeMap<u16, Decoder> = BTreeMap::new();
        self.each(|message| {
            if message.channel.topic != topic {
                return Ok(());
            }
            let decoder = match decoders.entry(message.channel.id) {
                std::collections::btree_map::Entry::Occupied(known) => known.into_mut(),
                std::collections::btree_map::Entry::Vacant(new) => {
                    new.insert(decoder(&message.channel).map_err(|reason| {
                        let fix = "Map another topic, or record it again in one of these";
                        Error::input(&self.path, format!("topic `{topic}` cannot be read: {reason}"), fix)
                            .of_kind(InputKind::Malformed)
                    })?)
                }
            };
            let recorded = Recorded { log_ns: message.log_ns, publish_ns: message.publish_ns, bytes: &message.data };
            take(decoder, recorded)
        })
    }
}
