//! A robot's day: three files, each whole or as it was.

use std::io;
use std::path::{Path, PathBuf};

use super::answer::Answered;
use super::cells::{Row, read, written};
use super::rows::{CauseRow, EquationRow, SessionRow};
use crate::error::{Error, InputKind, Result};
use crate::log::write_whole;

const FILE: &str = "part.parquet";

/// What a file is called as long as it is not whole.
const UNFINISHED: &str = ".omni-gap-";

/// The place of a robot's day within each table.
pub(super) fn folder_of(robot: &str, date: &str) -> PathBuf {
    Path::new(&format!("robot={}", escaped(robot))).join(format!("date={}", escaped(date)))
}

/// A name that any file system takes: other letters as their bytes, `%2F`.
fn escaped(name: &str) -> String {
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"-_.".contains(&byte);
    let letter = |byte: u8| if plain(byte) { char::from(byte).to_string() } else { format!("%{byte:02X}") };
    name.bytes().map(letter).collect()
}

/// Puts answers into the files of their day, in place of what stood there of the same sessions. The sessions' own file is last:
/// what it does not name is not there.
pub(super) fn add(store: &Path, day: &Path, answers: Vec<Answered>) -> Result<()> {
    let sessions: Vec<String> = answers.iter().map(|answer| answer.session.session.clone()).collect();
    let (mut rows, mut causes, mut equations) = (Vec::new(), Vec::new(), Vec::new());
    for answer in answers {
        rows.push(answer.session);
        causes.extend(answer.causes);
        equations.extend(answer.equations);
    }
    merged::<EquationRow>(store, day, &sessions, equations)?;
    merged::<CauseRow>(store, day, &sessions, causes)?;
    merged::<SessionRow>(store, day, &sessions, rows)
}

/// Takes out of a day what it holds of a session.
pub(super) fn remove(store: &Path, day: &Path, session: &str) -> Result<()> {
    let gone = [session.to_owned()];
    merged::<SessionRow>(store, day, &gone, Vec::new())?;
    merged::<CauseRow>(store, day, &gone, Vec::new())?;
    merged::<EquationRow>(store, day, &gone, Vec::new())
}

fn merged<R: Row>(store: &Path, day: &Path, sessions: &[String], new: Vec<R>) -> Result<()> {
    let folder = store.join(R::TABLE).join(day);
    let path = folder.join(FILE);
    let mut rows: Vec<R> = if path.exists() { of_file(&path)? } else { Vec::new() };
    rows.retain(|row| sessions.iter().all(|session| session != row.session()));
    rows.extend(new);
    // rows of a session stand as they were made
    rows.sort_by(|a, b| a.session().cmp(b.session()));
    let unwritable = |why: String| Error::output(&path, why, "Free space, or name another folder with --out");
    if rows.is_empty() {
        return match std::fs::remove_file(&path) {
            Err(why) if why.kind() != io::ErrorKind::NotFound => Err(unwritable(why.to_string())),
            _ => Ok(()),
        };
    }
    let bytes = written(&rows).map_err(|why| unwritable(why.to_string()))?;
    std::fs::create_dir_all(&folder).map_err(|why| unwritable(why.to_string()))?;
    write_whole(&path, &bytes)
}

/// Takes away what was not finished in a day's folder when its writer was killed.
pub(super) fn sweep(day: &Path) -> Result<()> {
    let files = std::fs::read_dir(day).map_err(|why| Error::unreadable(day, &why))?;
    for path in files.flatten().map(|file| file.path()) {
        if path.file_name().is_some_and(|name| name.as_encoded_bytes().starts_with(UNFINISHED.as_bytes())) {
            std::fs::remove_file(&path).map_err(|why| Error::output(&path, why.to_string(), "Take it away by hand"))?;
        }
    }
    Ok(())
}

/// The rows of a table's file.
pub(super) fn of_file<R: Row>(path: &Path) -> Result<Vec<R>> {
    read(path).map_err(|why| {
        let fix = "Take the file away, its sessions are then diagnosed again, or name another folder with --out";
        Error::input(path, format!("this is no table of a fleet that this program can read: {why}"), fix)
            .of_kind(InputKind::Malformed)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_name_of_a_robot_is_a_name_of_a_folder() {
        assert_eq!(folder_of("r07", "2026-11-03"), Path::new("robot=r07/date=2026-11-03"));
        assert_eq!(folder_of("../ä=b", "x"), Path::new("robot=..%2F%C3%A4%3Db/date=x"));
    }
}
