//! # Sources: files of any format, as columns of samples
//!
//! One door: a path goes in, named columns come out, each a channel whose holes have their reasons, and every row can
//! still be found in its file. What the numbers mean is the mapping's matter, not a source's.

mod csv;
mod opened;
mod records;

use crate::error::Result;
use std::path::Path;

pub(crate) use csv::Layout;
pub(crate) use opened::Source;

/// Suffixes of files that are read without being asked for.
const KNOWN_SUFFIXES: [&str; 2] = [".csv", RECORDS];

/// Suffix of a robot's records; any other file is a table.
const RECORDS: &str = ".rec";

fn ends_in(name: &str, suffix: &str) -> bool {
    name.to_ascii_lowercase().ends_with(suffix)
}

fn is_records(path: &Path) -> bool {
    path.file_name().is_some_and(|name| ends_in(&name.to_string_lossy(), RECORDS))
}

/// Whether a file of this name is a log where no mapping says which are.
pub(crate) fn is_log(name: &str) -> bool {
    KNOWN_SUFFIXES.iter().any(|suffix| ends_in(name, suffix))
}

/// Opens a file of samples; `layout` says how text is laid out.
///
/// # Errors
/// Where there is no such file, or it is not of its format.
pub(crate) fn open(path: &Path, layout: &Layout) -> Result<Box<dyn Source>> {
    if is_records(path) {
        return Ok(Box::new(records::Records::open(path)?));
    }
    Ok(Box::new(csv::Table::open(path, layout)?))
}
