//! A robot's day: three files, each whole or as it was. Robot and day stand in the names of the folders, `robot=r07/date=2026-11-03`,
//! and not in the files: who reads all of them as one table, partitioned as Hive does it, finds them as columns.

use sha2::{Digest, Sha256};

use super::answer::SessionAnswer;
use super::cells::{Row, read, written};
use super::rows::{CauseRow, EquationRow, SessionRow};
use super::storage::Storage;
use crate::error::{Error, InputKind, Result};

/// The columns that stand in the names of the folders.
const PARTS: [&str; 2] = ["robot", "date"];

/// Bytes of a folder's name at the most, of which every file system takes 255; and of a longer one the bytes that are kept.
const LONGEST: usize = 200;
const KEPT: usize = 150;

/// Stands in a folder's name where that was too long and was cut, and in no other.
const CUT: char = '~';

/// The place of a robot's day within each table.
pub(super) fn day_of(robot: &str, date: &str) -> String {
    format!("robot={}/date={}", escaped(robot), escaped(date))
}

/// What the names of a file's folders say.
fn parts_of(file: &str) -> Vec<(&'static str, String)> {
    let of = |folder: &str| {
        let (name, value) = folder.split_once('=')?;
        PARTS.into_iter().find(|part| *part == name).map(|part| (part, unescaped(value)))
    };
    file.split('/').filter_map(of).collect()
}

/// The file of a day.
fn file_of(table: &str, day: &str) -> String {
    format!("{table}/{day}/part.parquet")
}

/// A name that any file system takes: other letters as their bytes, `%2F`; of a long one the beginning and a hash of all.
fn escaped(name: &str) -> String {
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"-_.".contains(&byte);
    let letter = |byte: u8| if plain(byte) { char::from(byte).to_string() } else { format!("%{byte:02X}") };
    let mut escaped: String = name.bytes().map(letter).collect();
    if escaped.len() > LONGEST {
        escaped.truncate(KEPT);
        escaped += &format!("{CUT}{:.16}", format!("{:x}", Sha256::digest(name)));
    }
    escaped
}

fn unescaped(name: &str) -> String {
    let mut bytes = Vec::with_capacity(name.len());
    let mut rest = name.as_bytes();
    while let [first, more @ ..] = rest {
        let letter = more.get(..2).and_then(|hex| u8::from_str_radix(std::str::from_utf8(hex).ok()?, 16).ok());
        let (byte, used) = if *first == b'%' { letter.map_or((b'%', 1), |byte| (byte, 3)) } else { (*first, 1) };
        bytes.push(byte);
        rest = &rest[used..];
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Puts answers into the files of their day, in place of what stood there of the same sessions. The sessions' own file is last:
/// what it does not name is not there.
pub(super) fn add(storage: &dyn Storage, day: &str, answers: Vec<SessionAnswer>) -> Result<()> {
    let sessions: Vec<String> = answers.iter().map(|answer| answer.session.session.clone()).collect();
    let (mut rows, mut causes, mut equations) = (Vec::new(), Vec::new(), Vec::new());
    for answer in answers {
        rows.push(answer.session);
        causes.extend(answer.causes);
        equations.extend(answer.equations);
    }
    merge::<EquationRow>(storage, day, &sessions, equations)?;
    merge::<CauseRow>(storage, day, &sessions, causes)?;
    merge::<SessionRow>(storage, day, &sessions, rows)
}

/// Takes out of a day what it holds of a session.
pub(super) fn remove(storage: &dyn Storage, day: &str, session: &str) -> Result<()> {
    let gone = [session.to_owned()];
    merge::<SessionRow>(storage, day, &gone, Vec::new())?;
    merge::<CauseRow>(storage, day, &gone, Vec::new())?;
    merge::<EquationRow>(storage, day, &gone, Vec::new())
}

fn merge<R: Row>(storage: &dyn Storage, day: &str, sessions: &[String], new: Vec<R>) -> Result<()> {
    let file = file_of(R::TABLE, day);
    let mut rows: Vec<R> = of_file(storage, &file)?;
    rows.retain(|row| sessions.iter().all(|session| session != row.session()));
    rows.extend(new);
    // rows of a session stand as they were made
    rows.sort_by(|a, b| a.session().cmp(b.session()));
    if rows.is_empty() {
        return storage.remove(&file);
    }
    let left_out: &[&str] = if day.contains(CUT) { &[] } else { &PARTS };
    let bytes = written(&rows, left_out)
        .map_err(|why| Error::output(&storage.place(&file), why.to_string(), "Tell its makers"))?;
    storage.write(&file, &bytes)
}

/// All rows of a table, by robot, day and session.
pub(super) fn of_table<R: Row>(storage: &dyn Storage) -> Result<Vec<R>> {
    let mut all = Vec::new();
    for file in storage.files(R::TABLE)?.iter().filter(|file| file.ends_with(".parquet")) {
        all.extend(of_file::<R>(storage, file)?);
    }
    Ok(all)
}

fn of_file<R: Row>(storage: &dyn Storage, file: &str) -> Result<Vec<R>> {
    let Some(bytes) = storage.read(file)? else { return Ok(Vec::new()) };
    read(bytes, &parts_of(file)).map_err(|why| {
        let fix = "Take the file away, its sessions are then diagnosed again, or name another folder with --out";
        let problem = format!("this is no table of a fleet that this program can read: {why}");
        Error::input(&storage.place(file), problem, fix).of_kind(InputKind::Malformed)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_name_of_a_robot_is_a_name_of_a_folder_and_is_read_off_it() {
        assert_eq!(day_of("r07", "2026-11-03"), "robot=r07/date=2026-11-03");
        assert_eq!(day_of("../ä=b", "x"), "robot=..%2F%C3%A4%3Db/date=x");
        let [long, other] = ["x", "y"].map(|end| day_of(&("ä".repeat(2_000) + end), "2026-11-03"));
        assert!(long != other && long.split('/').all(|name| name.len() <= 255), "{long}");
        for robot in ["r07", "../ä=b", "50 %", "%4", "%", "~"] {
            let file = file_of("sessions", &day_of(robot, "2026-11-03"));
            assert_eq!(parts_of(&file), [("robot", robot.to_owned()), ("date", "2026-11-03".to_owned())]);
        }
    }
}
