//! # Sources: files of any format, as columns of samples
//!
//! One door: a path goes in, named columns come out, each a channel whose holes have their reasons, and every row can
//! still be found in its file. What the numbers mean is the mapping's matter, not a source's.

mod bag;
mod csv;
mod held;
mod opened;
mod parquet;
mod records;

use crate::error::{Error, InputKind, Result};
use std::path::Path;

pub(crate) use bag::Seen as Topic;
pub(crate) use csv::Layout;
pub(crate) use opened::Source;

/// Suffix of a robot's records.
const RECORDS: &str = ".rec";

/// Suffix of tables in Parquet.
const PARQUET: &str = ".parquet";

fn ends_in(name: &str, suffix: &str) -> bool {
    name.to_ascii_lowercase().ends_with(suffix)
}

/// Whether a file of this name is a log where no mapping says which are.
pub(crate) fn is_log(name: &str) -> bool {
    [".csv", RECORDS, PARQUET].iter().any(|suffix| ends_in(name, suffix)) || holds_topics(name)
}

/// Whether a file of this name is a recording of topics, each with a clock of its own.
pub(crate) fn holds_topics(name: &str) -> bool {
    bag::SUFFIXES.iter().any(|suffix| ends_in(name, suffix))
}

/// The topics that a recording has messages of, by name.
///
/// # Errors
/// Where it cannot be read.
pub(crate) fn topics(path: &Path) -> Result<Vec<Topic>> {
    bag::topics(path)
}

/// Whether a file of this name is a table whose format says where its columns are.
pub(crate) fn is_table_of_its_own(name: &str) -> bool {
    [RECORDS, PARQUET].iter().any(|suffix| ends_in(name, suffix))
}

/// Opens a file of samples; `layout` says how text is laid out, `topic` which one of a recording of topics is meant.
///
/// # Errors
/// Where there is no such file, or it is not of its format.
pub(crate) fn open(path: &Path, layout: &Layout, topic: Option<&str>) -> Result<Box<dyn Source>> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    if holds_topics(&name) {
        return Ok(Box::new(bag::open(path, topic)?));
    }
    if let Some(topic) = topic {
        let problem = format!("it has no topics, expected one named `{topic}`: a recording in MCAP or a ROS bag");
        return Err(Error::input(path, problem, "Remove `topic` in columns.toml, or name another file")
            .of_kind(InputKind::Conflict));
    }
    if ends_in(&name, RECORDS) {
        return Ok(Box::new(records::open(path)?));
    }
    if ends_in(&name, PARQUET) {
        return Ok(Box::new(parquet::Parquet::open(path)?));
    }
    Ok(Box::new(csv::Table::open(path, layout)?))
}
