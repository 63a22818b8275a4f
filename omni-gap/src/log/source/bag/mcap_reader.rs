//! The messages of a recording in MCAP, record by record.
//!
//! Chunks, compression and checksums are the library's matter. What a record holds is looked at here before the library
//! reads it: it takes as much memory as a name says that it is long, and a spoiled byte makes of that what it likes.

use super::super::longest_part::longest_part;
use std::collections::BTreeMap;
use std::io::{ErrorKind, Read};
use std::rc::Rc;

use mcap::McapError;
use mcap::records::{Record, op};
use mcap::sans_io::{LinearReadEvent, LinearReader, LinearReaderOptions};

/// What the messages of a channel are.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Schema {
    pub name: String,
    pub encoding: String,
    pub data: Vec<u8>,
}

/// Messages of one kind.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Channel {
    pub id: u16,
    pub topic: String,
    pub encoding: String,
    pub schema: Option<Rc<Schema>>,
}

/// One message.
#[derive(Debug)]
pub(super) struct Message {
    pub channel: Rc<Channel>,
    pub log_ns: u64,
    pub publish_ns: u64,
    pub data: Vec<u8>,
}

/// Why no more messages come.
#[derive(Debug)]
pub(super) enum Stop {
    /// The recording ends in the middle of a record.
    CutOff,
    /// It is none, or a broken one.
    Broken(String),
}

/// The messages, as they stand in the recording.
pub(super) struct Messages<R> {
    source: R,
    records: LinearReader,
    schemas: BTreeMap<u16, Rc<Schema>>,
    channels: BTreeMap<u16, Rc<Channel>>,
    over: bool,
}

impl<R: Read> Messages<R> {
    /// Of a recording that is so long (bytes).
    pub(super) fn new(source: R, length: u64) -> Self {
        // of a record or chunk: room is made for what a length says
        let longest = longest_part(length) as usize;
        let options = LinearReaderOptions::default().with_validate_chunk_crcs(true).with_record_length_limit(longest);
        let records = LinearReader::new_with_options(options);
        Messages { source, records, schemas: BTreeMap::new(), channels: BTreeMap::new(), over: false }
    }

    /// Fills what the library asks for.
    fn read(&mut self, need: usize) -> Result<(), Stop> {
        loop {
            match self.source.read(self.records.insert(need)) {
                Ok(read) => {
                    self.records.notify_read(read);
                    return Ok(());
                }
                Err(reason) if reason.kind() == ErrorKind::Interrupted => {}
                Err(reason) => return Err(Stop::Broken(reason.to_string())),
            }
        }
    }

    /// The next message; none at the end of the data.
    fn message(&mut self) -> Result<Option<Message>, Stop> {
        loop {
            let event = match self.records.next_event() {
                None => return Ok(None),
                Some(event) => event.map_err(Stop::from)?,
            };
            let record = match event {
                LinearReadEvent::ReadRequest(need) => {
                    self.read(need)?;
                    continue;
                }
                LinearReadEvent::Record { opcode, data } if is_wanted(opcode) => {
                    if !names_fit(opcode, data) {
                        return Err(Stop::Broken("a name in it is longer than the record that it stands in".into()));
                    }
                    mcap::parse_record(opcode, data)?.into_owned()
                }
                // the summary says again what was said before, and has no messages
                LinearReadEvent::Record { .. } => continue,
            };
            if let Some(message) = self.take(record)? {
                return Ok(Some(message));
            }
        }
    }

    /// Keeps what describes messages, and makes one of what is one.
    fn take(&mut self, record: Record<'_>) -> Result<Option<Message>, Stop> {
        match record {
            Record::Schema { header, data } => {
                let schema = Schema { name: header.name, encoding: header.encoding, data: data.into_owned() };
                known_once(&mut self.schemas, header.id, schema, "schema")?;
                Ok(None)
            }
            Record::Channel(channel) => {
                let schema = match channel.schema_id {
                    0 => None,
                    id => Some(self.schemas.get(&id).ok_or_else(|| unknown("schema", id))?.clone()),
                };
                let id = channel.id;
                let channel = Channel { id, topic: channel.topic, encoding: channel.message_encoding, schema };
                known_once(&mut self.channels, id, channel, "channel")?;
                Ok(None)
            }
            Record::Message { header, data } => {
                let channel =
                    self.channels.get(&header.channel_id).ok_or_else(|| unknown("channel", header.channel_id))?;
                let (log_ns, publish_ns) = (header.log_time, header.publish_time);
                Ok(Some(Message { channel: channel.clone(), log_ns, publish_ns, data: data.into_owned() }))
            }
            _ => Ok(None),
        }
    }
}

impl<R: Read> Iterator for Messages<R> {
    type Item = Result<Message, Stop>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.over {
            return None;
        }
        let message = self.message().transpose();
        self.over = !matches!(message, Some(Ok(_)));
        message
    }
}

impl From<McapError> for Stop {
    fn from(reason: McapError) -> Stop {
        match reason {
            McapError::UnexpectedEof | McapError::UnexpectedEoc => Stop::CutOff,
            other => Stop::Broken(other.to_string()),
        }
    }
}

fn unknown(what: &str, id: u16) -> Stop {
    Stop::Broken(format!("{what} {id} is named before it is described"))
}

/// Keeps a description, which may be repeated and must not change.
fn known_once<T: PartialEq>(known: &mut BTreeMap<u16, Rc<T>>, id: u16, new: T, what: &str) -> Result<(), Stop> {
    match known.get(&id) {
        Some(old) if **old != new => Err(Stop::Broken(format!("{what} {id} is described twice, and differently"))),
        Some(_) => Ok(()),
        None => {
            known.insert(id, Rc::new(new));
            Ok(())
        }
    }
}

/// Records that messages are made of.
fn is_wanted(opcode: u8) -> bool {
    matches!(opcode, op::SCHEMA | op::CHANNEL | op::MESSAGE)
}

/// True where every name ends within its record; see the records' layouts in the format's specification,
/// <https://mcap.dev/spec>: text is its length in four bytes, and the bytes.
fn names_fit(opcode: u8, record: &[u8]) -> bool {
    let fits = match opcode {
        // id, name, encoding, data
        op::SCHEMA => behind_texts(record.get(2..), 2),
        // id, schema, topic, encoding, then a map: its length, and texts to its end
        op::CHANNEL => behind_texts(record.get(4..), 2).and_then(|map| {
            let (length, rest) = map.split_first_chunk::<4>()?;
            let mut texts = rest.get(..u32::from_le_bytes(*length) as usize)?;
            while !texts.is_empty() {
                texts = behind_texts(Some(texts), 1)?;
            }
            Some(texts)
        }),
        _ => Some(record),
    };
    fits.is_some()
}

/// What stands behind so many texts; none where one of them does not end.
fn behind_texts(mut bytes: Option<&[u8]>, count: usize) -> Option<&[u8]> {
    for _ in 0..count {
        let (length, rest) = bytes?.split_first_chunk::<4>()?;
        bytes = rest.get(u32::from_le_bytes(*length) as usize..);
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(words: &str) -> Vec<u8> {
        [&(words.len() as u32).to_le_bytes()[..], words.as_bytes()].concat()
    }

    #[test]
    fn a_name_that_is_longer_than_its_record_is_seen_before_it_is_read() {
        let schema = [&[1, 0][..], &text("Wheels"), &text("ros2msg"), &text("float64 x")].concat();
        let map = [text("frame"), text("base")].concat();
        let length = (map.len() as u32).to_le_bytes();
        let channel = [&[1, 0, 1, 0][..], &text("/wheels"), &text("cdr"), &length, &map].concat();
        for (opcode, sound) in [(op::SCHEMA, schema), (op::CHANNEL, channel)] {
            assert!(names_fit(opcode, &sound));
            // the highest byte of each length
            let lengths: Vec<usize> =
                (3..sound.len()).filter(|k| sound[k - 3] > 0 && sound[k - 2..=*k] == [0; 3]).collect();
            assert!(lengths.len() >= 2, "{lengths:?}");
            let data = sound.len() - "float64 x".len() - 1;
            for place in lengths.into_iter().filter(|place| opcode == op::CHANNEL || *place != data) {
                let mut spoiled = sound.clone();
                spoiled[place] = 0x7f;
                assert!(!names_fit(opcode, &spoiled), "{opcode} with byte {place} changed");
            }
            assert!(!names_fit(opcode, &sound[..8]));
        }
    }
}
