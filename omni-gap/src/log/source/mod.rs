//! # Sources: files of any format, as columns of samples
//!
//! One door: a path goes in, named columns come out, each a channel whose holes have their reasons, and every row can
//! still be found in its file. What the numbers mean is the mapping's matter, not a source's.

mod bag;
mod csv;
mod date_time;
mod guarded;
mod held;
mod longest_part;
mod opened;
mod parquet;
mod parquet_pages;
mod records;
mod suffix;
mod table;
mod text;
mod topic;
mod vision;

use crate::error::{Error, InputKind, Result};
pub(super) use bag::{MCAP, METADATA, files as files_of_recording};
use std::path::Path;
pub(super) use suffix::ends_in;

pub(crate) use csv::Layout;
use opened::Keeps;
pub(crate) use opened::Source;
pub(crate) use parquet::Described;
pub use table::Table;
pub(crate) use topic::Seen as Topic;
pub use vision::Packet;
pub(crate) use vision::{ROBOT_TYPE, is_robot, robots_in, write_game_log};

/// Suffix of a robot's records.
const RECORDS: &str = ".rec";

/// Suffix of tables in Parquet.
pub(super) const PARQUET: &str = ".parquet";

/// Whether a file is a log where no mapping says which are.
pub(crate) fn is_log(path: &Path) -> bool {
    ends_in(path, &[".csv", RECORDS, PARQUET]) || holds_topics(path)
}

/// Whether a file is a recording of topics, each with a clock of its own.
pub(crate) fn holds_topics(path: &Path) -> bool {
    ends_in(path, &bag::SUFFIXES) || vision::is_game_log(path) || is_folder_of_topics(path)
}

/// Whether a folder is one recording, as rosbag2 leaves it.
pub(crate) fn is_folder_of_topics(path: &Path) -> bool {
    bag::is_recording(path)
}

/// Whether a recording is of the kind that names its topics so: robots are topics of game logs.
pub(crate) fn names_topics_so(path: &Path, topic: &str) -> bool {
    vision::is_game_log(path) == vision::is_robot(topic)
}

/// The topics that a recording has messages of, by name.
///
/// # Errors
/// Where it cannot be read.
pub(crate) fn topics(path: &Path) -> Result<Vec<Topic>> {
    if vision::is_game_log(path) { vision::topics(path) } else { bag::topics(path) }
}

/// Whether a file is a table whose format says where its columns are.
pub(crate) fn is_table_of_its_own(path: &Path) -> bool {
    ends_in(path, &[RECORDS, PARQUET])
}

/// Opens a file of samples; `layout` says how text is laid out, `topic` which one of a recording of topics is meant, and
/// `keeps` which of its columns may be asked for: a message has more numbers in it than a run needs.
///
/// # Errors
/// Where there is no such file, or it is not of its format.
pub(crate) fn open(path: &Path, layout: &Layout, topic: Option<&str>, keeps: &Keeps) -> Result<Box<dyn Source>> {
    if vision::is_game_log(path) || topic.is_some() && vision::is_named_as_one(path) {
        return vision::open(path, topic);
    }
    if holds_topics(path) {
        return Ok(Box::new(bag::open(path, topic, keeps)?));
    }
    if let Some(topic) = topic {
        let problem = format!(
            "it has no topics, expected one named `{topic}`: a recording in MCAP, a ROS bag, or a game log of SSL-Vision"
        );
        return Err(Error::input(path, problem, "Remove `topic` in columns.toml, or name another file")
            .of_kind(InputKind::Conflict));
    }
    if ends_in(path, &[RECORDS]) {
        return Ok(Box::new(records::open(path)?));
    }
    if ends_in(path, &[PARQUET]) {
        return Ok(Box::new(parquet::Parquet::open(path)?));
    }
    Ok(Box::new(csv::Table::open(path, layout)?))
}
