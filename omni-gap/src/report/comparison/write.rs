//! The files of a comparison, each whole or not there.

use std::path::{Path, PathBuf};

use super::model::ComparisonReport;
use crate::error::Result;
use crate::report::write::{put, unwritable};

/// Their names.
pub const FILES: [&str; 2] = ["compare.json", "compare.html"];

/// Where they stand.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// `compare.json`.
    pub json: PathBuf,
    /// `compare.html`.
    pub html: PathBuf,
}

/// Puts both into the folder, which is made where it is not there.
///
/// # Errors
/// Where they cannot be written: which path, why, and how to mend it.
pub fn write(dir: &Path, report: &ComparisonReport, html: &str) -> Result<Written> {
    let [json_name, html_name] = FILES;
    let json = report.to_json().map_err(|why| unwritable(&why.into(), &dir.join(json_name)))?;
    let [json, html] = put(dir, [(json_name, &json), (html_name, html)])?;
    Ok(Written { json, html })
}
