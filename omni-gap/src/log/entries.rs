//! What is in a folder.

use crate::error::{Error, InputKind, Result};
use std::path::{Path, PathBuf};

/// The files and folders in a folder that are not hidden, by name.
///
/// # Errors
/// Where the folder cannot be read.
pub(crate) fn entries(folder: &Path) -> Result<Vec<(String, PathBuf)>> {
    let told = |reason: std::io::Error| {
        Error::input(folder, format!("cannot be read: {reason}"), "Check its permissions")
            .of_kind(InputKind::Unreadable)
    };
    let mut all = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(told)? {
        let path = entry.map_err(told)?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if !name.starts_with('.') {
            all.push((name, path));
        }
    }
    all.sort();
    Ok(all)
}
