//! # Place: where all of it is made

use std::fs;
use std::path::{Path, PathBuf};

use crate::folder::told;
use crate::line::Line;
use crate::wheel::package::unmarked;

/// Where that is put which is handed out.
pub const OUT: &str = "target/dist/out";

/// The clean copy of the commit. It is outside of the tree, whose own settings cargo would find above it.
pub fn source() -> PathBuf {
    std::env::temp_dir().join("omni-gap-dist")
}

/// The version of everything in the workspace.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A command in the clean copy, which builds what is handed out.
pub fn in_source(text: &str) -> Line {
    unmarked(Line::of(text).within(source()))
}

/// Copies files of the clean copy into a folder, as they are.
///
/// # Errors
/// What to tell the person.
pub fn brought(files: &[&str], folder: &Path) -> Result<(), String> {
    for file in files {
        let source = source().join(file);
        told(file, fs::copy(&source, folder.join(source.file_name().unwrap_or_default())))?;
    }
    Ok(())
}
