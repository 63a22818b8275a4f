//! Sessions below folders: each folder with a robot file and runs.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use jiff::Timestamp;
use jiff::civil::Date;
use jiff::tz::Offset;

use super::labels::{Labels, date_in};
use crate::error::{Error, InputKind, Result};
use crate::log::entries;

/// A session that lies below a folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FoundSession {
    /// What its rows call it: its folder as it was named, or the place that the folder was copied from.
    pub name: String,
    /// Its folder.
    pub path: PathBuf,
    /// The folder below which it was found.
    pub root: PathBuf,
    /// The robot, as far as the session's place and labels tell; none where only its robot file can.
    pub robot: Option<String>,
    /// The day.
    pub date: Date,
    /// The firmware's version, where it is known.
    pub firmware: Option<String>,
    /// The floor, where it is known.
    pub floor: Option<String>,
    /// Why its labels cannot be used.
    pub refused: Option<String>,
}

/// All sessions below these folders, in the order of their paths; a folder that is reached twice counts once.
///
/// # Errors
/// Where a folder is none or cannot be read, or no session lies below any of them.
pub fn find(folders: &[PathBuf]) -> Result<Vec<FoundSession>> {
    let mut walked = Walked::default();
    for folder in folders {
        if !folder.is_dir() {
            let found = if folder.exists() { "this is a file, expected a folder" } else { "no such folder" };
            return Err(
                Error::input(folder, found, "Give a folder with sessions below it").of_kind(InputKind::NotFound)
            );
        }
        walked.below(folder, folder)?;
    }
    if walked.found.is_empty() {
        let problem = "no session lies below it: no folder has a robot.toml and runs/";
        let fix = "Give the folder that the sessions lie in, or make a session with `omni-gap new`";
        return Err(Error::input(&folders[0], problem, fix).of_kind(InputKind::Missing));
    }
    walked.found.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(walked.found)
}

#[derive(Default)]
struct Walked {
    found: Vec<FoundSession>,
    /// Where it was already, links followed: a link that leads back ends there.
    seen: BTreeSet<PathBuf>,
}

impl Walked {
    fn below(&mut self, folder: &Path, root: &Path) -> Result<()> {
        let place = folder.canonicalize().map_err(|why| Error::unreadable(folder, &why))?;
        if !self.seen.insert(place) {
            return Ok(());
        }
        if folder.join("robot.toml").is_file() && folder.join("runs").is_dir() {
            self.found.push(FoundSession::at(folder, root, as_text(folder)));
            return Ok(());
        }
        let mut below = entries(folder)?.into_iter().map(|(_, path)| path).filter(|path| path.is_dir());
        below.try_for_each(|path| self.below(&path, root))
    }
}

impl FoundSession {
    /// The session in a folder, whose place below `root` tells robot and day where its labels do not.
    pub fn at(path: &Path, root: &Path, name: String) -> Self {
        let (labels, refused) = match Labels::of(path) {
            Ok(labels) => (labels, None),
            Err(why) => (Labels::default(), Some(why.to_string())),
        };
        let within = path.strip_prefix(root).unwrap_or(path);
        Self {
            name,
            path: path.to_path_buf(),
            root: root.to_path_buf(),
            robot: labels.robot.or_else(|| folder_of_robot(within)),
            date: labels.date.or_else(|| date_in(within)).unwrap_or_else(|| newest(path)),
            firmware: labels.firmware,
            floor: labels.floor,
            refused,
        }
    }
}

/// A path as text; bytes that are none stand as `\xFF`, so that sessions whose names differ in them are told apart.
fn as_text(path: &Path) -> String {
    let part = |chunk: std::str::Utf8Chunk<'_>| {
        let strange = chunk.invalid().iter().map(|byte| format!("\\x{byte:02X}"));
        [chunk.valid().to_owned(), strange.collect()].concat()
    };
    path.as_os_str().as_encoded_bytes().utf8_chunks().map(part).collect()
}

/// ROBOT of ROBOT/…/SESSION.
fn folder_of_robot(within: &Path) -> Option<String> {
    let first = within.components().next()?;
    (within.components().count() > 1).then(|| first.as_os_str().to_string_lossy().into_owned())
}

/// The day (UTC) on which its newest recording was written.
fn newest(session: &Path) -> Date {
    let entries = std::fs::read_dir(session.join("runs")).into_iter().flatten().flatten();
    let written = entries.filter_map(|entry| Timestamp::try_from(entry.metadata().ok()?.modified().ok()?).ok());
    Offset::UTC.to_datetime(written.max().unwrap_or(Timestamp::UNIX_EPOCH)).date()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn session(at: &Path) {
        std::fs::create_dir_all(at.join("runs")).unwrap();
        std::fs::write(at.join("robot.toml"), "name = \"x\"\n").unwrap();
    }

    #[test]
    fn sessions_are_found_with_robot_and_day_and_links_that_lead_back_end() {
        let root = tempfile::tempdir().unwrap();
        session(&root.path().join("r02/2026-11-03 a"));
        session(&root.path().join("r01/more/20261104"));
        session(&root.path().join("alone"));
        session(&root.path().join(".hidden/2026-11-03"));
        std::fs::write(root.path().join("r01/more/20261104/session.toml"), "robot = \"seven\"\n").unwrap();
        #[cfg(unix)]
        std::os::unix::fs::symlink(root.path(), root.path().join("r01/loop")).unwrap();
        let found = find(&[root.path().to_path_buf(), root.path().join("r01")]).unwrap();
        let told: Vec<(String, Option<&str>, String)> = found
            .iter()
            .map(|s| {
                let within = s.path.strip_prefix(root.path()).unwrap().display().to_string();
                (within, s.robot.as_deref(), s.date.to_string())
            })
            .collect();
        let today = newest(&root.path().join("alone")).to_string();
        assert_eq!(told[0], ("alone".into(), None, today));
        assert_eq!(told[1], ("r01/more/20261104".into(), Some("seven"), "2026-11-04".into()));
        assert_eq!(told[2], ("r02/2026-11-03 a".into(), Some("r02"), "2026-11-03".into()));
        assert_eq!(told.len(), 3);
    }

    #[test]
    fn a_recording_from_before_1970_has_its_day() {
        let root = tempfile::tempdir().unwrap();
        session(root.path());
        let run = std::fs::File::create(root.path().join("runs/a.csv")).unwrap();
        run.set_modified(std::time::UNIX_EPOCH - std::time::Duration::from_secs(86_400)).unwrap();
        assert_eq!(newest(root.path()).to_string(), "1969-12-31");
    }

    #[cfg(unix)]
    #[test]
    fn names_that_differ_in_bytes_that_are_no_text_are_told_apart() {
        use std::os::unix::ffi::OsStrExt;
        let root = tempfile::tempdir().unwrap();
        for end in [b"\xfe", b"\xff"] {
            session(&root.path().join(std::ffi::OsStr::from_bytes(&[&b"r \xc3\xa4"[..], end].concat())));
        }
        let names: Vec<String> = find(&[root.path().into()]).unwrap().into_iter().map(|session| session.name).collect();
        assert!(names[0].ends_with("r ä\\xFE") && names[1].ends_with("r ä\\xFF"), "{names:?}");
    }

    #[test]
    fn a_place_without_sessions_is_refused_with_what_to_do() {
        let root = tempfile::tempdir().unwrap();
        let told = find(&[root.path().to_path_buf()]).unwrap_err().to_string();
        assert!(told.contains("no session lies below it") && told.contains("omni-gap new"), "{told}");
        assert!(find(&[root.path().join("not")]).unwrap_err().to_string().contains("no such folder"));
    }
}
