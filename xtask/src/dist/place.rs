//! # Place: where all of it is made, under `target/dist`

use std::fs;
use std::path::Path;

use super::archive;
use crate::line::Line;
use crate::wheel::package::built;

/// What is handed out.
pub const OUT: &str = "target/dist/out";

/// The clean copy of the commit.
pub const SOURCE: &str = "target/dist/source";

/// The version of everything in the workspace.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A command in the clean copy, which builds elsewhere; nothing in it tells of lines of the sources.
pub fn in_source(text: &str) -> Line {
    let line = Line::of(text).within(SOURCE).env("CARGO_TARGET_DIR", &built().to_string_lossy());
    line.env("CARGO_PROFILE_RELEASE_STRIP", "true")
}

/// An empty folder.
///
/// # Errors
/// What to tell the person.
pub fn fresh(folder: &Path) -> Result<(), String> {
    let made = if folder.is_dir() { fs::remove_dir_all(folder) } else { Ok(()) };
    told(&folder.display().to_string(), made.and_then(|()| fs::create_dir_all(folder)))
}

/// A folder with all that is in it.
///
/// # Errors
/// What to tell the person.
pub fn copied(from: &Path, to: &Path) -> Result<(), String> {
    let shown = from.display().to_string();
    for file in told(&shown, archive::files(from))? {
        let copy = to.join(file.strip_prefix(from).unwrap_or(&file));
        told(&shown, fs::create_dir_all(copy.parent().unwrap_or(to)))?;
        told(&shown, fs::copy(&file, copy))?;
    }
    Ok(())
}

/// What to tell the person of something that cannot be read or written.
///
/// # Errors
/// That.
pub fn told<T>(what: &str, done: std::io::Result<T>) -> Result<T, String> {
    done.map_err(|why| format!("{what}: {why}"))
}
