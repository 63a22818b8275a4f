//! What the suffix of a file's name tells.

use std::path::Path;

/// Whether a file's name ends in one of these, in letters of either case.
pub(in crate::log) fn ends_in(path: &Path, suffixes: &[&str]) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    suffixes.iter().any(|suffix| name.ends_with(suffix))
}
