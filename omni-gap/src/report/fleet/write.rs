//! The files of a fleet's report, each whole or not there.

use std::path::{Path, PathBuf};

use super::model::FleetReport;
use crate::error::Result;
use crate::report::write::{put, unwritable};

/// Their names.
pub const FILES: [&str; 2] = ["fleet.json", "fleet.html"];

/// Where they stand.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// `fleet.json`.
    pub json: PathBuf,
    /// `fleet.html`.
    pub html: PathBuf,
}

/// Puts both into the folder.
///
/// # Errors
/// Where they cannot be written: which path, why, and how to mend it.
pub fn write(dir: &Path, report: &FleetReport, html: &str) -> Result<Written> {
    let [json_name, html_name] = FILES;
    let json = report.to_json().map_err(|why| unwritable(&why.into(), &dir.join(json_name)))?;
    let [json, html] = put(dir, [(json_name, &json), (html_name, html)])?;
    Ok(Written { json, html })
}
