//! # Recordings of topics: MCAP, and the bags of ROS 1 and ROS 2
//!
//! A topic is a table: a row for each of its messages, a column for each number in them, and the times at which it was
//! recorded. Which kind of file it is is told by how it begins, not by its name. The folder that rosbag2 records into is one recording, of however many files.

mod container;
mod decoder;
mod flatten;
mod listed;
mod mcap;
mod mcap_reader;
mod parts;
mod ros;
mod ros1;
mod ros1_reader;
mod rows;
mod sqlite;
mod usual;
mod value;

use super::held::Held;
use super::opened::{Keeps, OwnClock};
use super::topic::{Seen, absent, the_only_one};
use crate::error::{Error, InputKind, Result};
use container::Container;
use parts::Parts;
pub(in crate::log) use parts::{METADATA, files, is_recording};
use rows::Rows;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Suffixes of recordings of topics.
pub(super) const SUFFIXES: [&str; 3] = [MCAP, ".db3", ".bag"];

/// The suffix of MCAP.
pub(in crate::log) const MCAP: &str = ".mcap";

/// How much of a file tells what it is (bytes).
const HEAD: u64 = 64;

/// Reads one topic of a recording; the only one where none is named. Of columns that are not kept there is but the name.
pub(super) fn open(path: &Path, topic: Option<&str>, keeps: &Keeps) -> Result<Held> {
    let recording = container(path)?;
    let topic = match topic {
        Some(topic) => topic.to_owned(),
        None => the_only_one(path, &recording.topics()?)?,
    };
    let mut rows = Rows::new(keeps);
    let mut number = 0;
    let amiss = recording.messages(&topic, &mut |decoder, recorded| {
        number += 1;
        let message = decoder.decode(recorded.bytes).map_err(|reason| {
            let problem = format!("message {number} of topic `{topic}` does not fit its definition: {reason}");
            Error::input(path, problem, "Record it again, or map another topic").of_kind(InputKind::Malformed)
        })?;
        rows.push(recorded, &message);
        Ok(())
    })?;
    if number == 0 {
        return Err(absent(path, &topic, &recording.topics()?));
    }
    let (names, columns, clock) = rows.finish();
    let clock = clock.map(|column| OwnClock {
        column,
        told: format!("topic `{topic}`: its times are those of `{}`", names[column]),
    });
    let notices = amiss.map(|amiss| format!("{}: {amiss}", path.display())).into_iter().collect();
    Ok(Held { path: path.into(), names, columns, clock, sampled: None, notices })
}

/// The topics that a recording has messages of.
pub(super) fn topics(path: &Path) -> Result<Vec<Seen>> {
    container(path)?.topics()
}

fn container(path: &Path) -> Result<Box<dyn Container>> {
    if is_recording(path) {
        return Ok(Box::new(Parts(files(path)?.iter().map(|file| container(file)).collect::<Result<_>>()?)));
    }
    let unreadable = |reason| Error::unreadable(path, &reason);
    let file = File::open(path).map_err(unreadable)?;
    let mut head = Vec::new();
    (&file).take(HEAD).read_to_end(&mut head).map_err(unreadable)?;
    if head.starts_with(::mcap::MAGIC) {
        return Ok(Box::new(mcap::Mcap::open(path, file)));
    }
    if head.starts_with(b"SQLite format 3\0") {
        return Ok(Box::new(sqlite::Sqlite::open(path)?));
    }
    if head.starts_with(ros1_reader::MAGIC) {
        return Ok(Box::new(ros1::Ros1::open(path, file)?));
    }
    let problem = match head.is_empty() {
        true => "the file is empty, expected a recording of topics",
        false => "it begins like no MCAP file, no SQLite database and no ROS 1 bag of format 2.0",
    };
    Err(Error::input(path, problem, "Check that it was copied whole; older ROS 1 bags: `rosbag fix`")
        .of_kind(InputKind::Malformed))
}
