//! # Writing a file whole or not at all

use super::held_folder::{HeldFolder, UNFINISHED};
use crate::error::{Error, Result};
use std::fs::OpenOptions;
use std::io::{BufWriter, Write};
use std::path::Path;

/// How much is written at a time (bytes).
const AT_A_TIME: usize = 1 << 16;

/// Writes `bytes` to `path`: first beside it under another name, then into place. Nothing is ever left half-written. A link stays, and what
/// it leads to is written; a device or pipe is written into as it is.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<()> {
    write_whole_with(path, |out| out.write_all(bytes))
}

/// As [`write_whole`], with the content written by a function.
pub fn write_whole_with(path: &Path, fill: impl FnOnce(&mut dyn Write) -> std::io::Result<()>) -> Result<()> {
    if path.is_dir() {
        return Err(Error::output(path, "it is a folder", "Name a file"));
    }
    let told = |reason: std::io::Error| {
        Error::output(path, reason.to_string(), "Check the permissions of the folder and the space left")
    };
    if is_device(path) {
        let written = OpenOptions::new().write(true).open(path).and_then(|file| {
            let mut out = BufWriter::with_capacity(AT_A_TIME, file);
            fill(&mut out)?;
            out.flush()
        });
        return written.map_err(told);
    }
    let place = if path.is_symlink() { path.canonicalize().unwrap_or_else(|_| path.into()) } else { path.into() };
    let folder = match place.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    if !folder.is_dir() {
        return Err(Error::output(path, format!("there is no folder {}", folder.display()), "Make the folder first"));
    }
    let _held = HeldFolder::take(folder);
    let mut file = tempfile::Builder::new().prefix(UNFINISHED).tempfile_in(folder).map_err(told)?;
    {
        let mut out = BufWriter::with_capacity(AT_A_TIME, file.as_file_mut());
        fill(&mut out).and_then(|()| out.flush()).map_err(told)?;
    }
    readable_by_all(file.as_file()).map_err(told)?;
    file.persist(&place).map(|_| ()).map_err(|failed| told(failed.error))
}

/// Whether something stands there that is written into and never replaced: a device, a pipe.
pub fn is_device(path: &Path) -> bool {
    path.metadata().is_ok_and(|about| !about.is_file() && !about.is_dir())
}

/// A temporary file is private; a finished one is an ordinary file.
#[cfg(unix)]
fn readable_by_all(file: &std::fs::File) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.set_permissions(std::fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn readable_by_all(_: &std::fs::File) -> std::io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_written_over_the_old_one_and_nothing_else_is_left() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("report.json");
        write_whole(&path, b"old").unwrap();
        write_whole(&path, b"new").unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"new");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_failure_on_the_way_leaves_the_old_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("report.json");
        write_whole(&path, b"old").unwrap();
        let failed = write_whole_with(&path, |out| {
            out.write_all(b"ne")?;
            Err(std::io::Error::other("the pen broke"))
        });
        assert!(failed.unwrap_err().to_string().contains("the pen broke"));
        assert_eq!(std::fs::read(&path).unwrap(), b"old");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_and_what_it_leads_to_is_written() {
        let folder = tempfile::tempdir().unwrap();
        let [link, path] = ["link.json", "deep/report.json"].map(|name| folder.path().join(name));
        std::fs::create_dir(folder.path().join("deep")).unwrap();
        std::fs::write(&path, "old").unwrap();
        std::os::unix::fs::symlink(&path, &link).unwrap();
        write_whole(&link, b"new").unwrap();
        assert!(link.is_symlink());
        assert_eq!(std::fs::read(&path).unwrap(), b"new");
    }

    #[cfg(unix)]
    #[test]
    fn a_device_is_written_into_and_stays_one() {
        // a socket stands for a device that cannot be written to: who may replace files of the system must not be the test's user
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("socket");
        let _listening = std::os::unix::net::UnixListener::bind(&path).unwrap();
        assert!(is_device(&path) && write_whole(&path, b"text").is_err() && is_device(&path));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_folder_in_place_of_the_file_or_no_folder_at_all_is_told() {
        let folder = tempfile::tempdir().unwrap();
        assert!(write_whole(folder.path(), b"").unwrap_err().to_string().contains("it is a folder"));
        let nowhere = folder.path().join("no/report.json");
        assert!(write_whole(&nowhere, b"").unwrap_err().to_string().contains("there is no folder"));
    }
}
