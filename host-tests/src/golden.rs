//! # Golden: pages that a program makes and is held to
//!
//! With `BLESS=1` in the environment the page is written, otherwise it is compared with the one that stands in `golden/`.
//! What counts as a difference is the page's own affair; a page of prose and tables is compared line by line. What takes
//! too long to be made in every run of the tests is a [`record`], and says so.

use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use omni_gap::error::Result;
use omni_gap::log::write_whole;

/// Where a page stands.
pub fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("golden").join(name)
}

/// True if pages are to be written: `BLESS=1`.
pub fn blessed() -> bool {
    std::env::var_os("BLESS").is_some_and(|bless| bless == "1")
}

/// Writes a page if it is to be blessed; otherwise tells what `differences` finds in the one that stands there. True if
/// the page is as it should be.
///
/// # Errors
/// Where the page cannot be written.
pub fn check_page(name: &str, page: &str, differences: impl FnOnce(&str) -> Vec<String>) -> Result<bool> {
    if blessed() {
        write_whole(&path(name), page.as_bytes())?;
        println!("written: host-tests/golden/{name}; read the difference before you commit it: git diff");
        return Ok(true);
    }
    let found = differences(&std::fs::read_to_string(path(name)).unwrap_or_default());
    found.iter().for_each(|what| println!("not as in host-tests/golden/{name} (BLESS=1 rewrites it): {what}"));
    Ok(found.is_empty())
}

/// What the last line of a record begins with.
pub const RECORD: &str = "A record of a long run, not compared by the test command: made by `";

/// Writes a page that is too long in the making to be compared: its last line names the command and the commit.
///
/// # Errors
/// Where the page cannot be written.
pub fn record(name: &str, page: &str, command: &str) -> Result<()> {
    write_whole(&path(name), format!("{page}\n---\n\n{RECORD}{command}` at commit {}.\n", commit()).as_bytes())?;
    println!("written: host-tests/golden/{name}; read the difference before you commit it: git diff");
    Ok(())
}

/// A page that is too long in the making for the tests: with `BLESS=1` it is recorded, otherwise compared with the record
/// that stands there. True if the page is as it should be.
///
/// # Errors
/// Where the page cannot be written.
pub fn check_record(name: &str, page: &str, command: &str) -> Result<bool> {
    if blessed() {
        record(name, page, command)?;
        return Ok(true);
    }
    check_page(name, page, |golden| {
        let last = golden.rfind("\n---\n").unwrap_or(golden.len());
        lines(&golden[..last], page, |a, b| a == b)
    })
}

/// The commit of this tree, as git abbreviates it; said where files differ from it.
pub fn commit() -> String {
    let changed = git(&["status", "--porcelain", "--untracked-files=no"]).is_some_and(|said| !said.is_empty());
    let hash = git(&["rev-parse", "--short", "HEAD"]).unwrap_or_else(|| "unknown".to_owned());
    if changed { format!("{hash} with changes") } else { hash }
}

/// The commit's whole hash.
pub fn full_commit() -> Option<String> {
    git(&["rev-parse", "HEAD"])
}

/// What git says, of this tree; none where it does not know.
pub(crate) fn git(arguments: &[&str]) -> Option<String> {
    let done = Command::new("git").args(arguments).current_dir(env!("CARGO_MANIFEST_DIR")).output().ok()?;
    done.status.success().then(|| String::from_utf8_lossy(&done.stdout).trim().to_owned())
}

/// The lines in which two pages differ, where `same` tells lines that do not.
pub fn lines(golden: &str, now: &str, same: impl Fn(&str, &str) -> bool) -> Vec<String> {
    let (old, new): (Vec<&str>, Vec<&str>) = (golden.lines().collect(), now.lines().collect());
    let line = |k: usize| (old.get(k).copied().unwrap_or(""), new.get(k).copied().unwrap_or(""));
    (0..old.len().max(new.len()))
        .filter(|k| !same(line(*k).0, line(*k).1))
        .map(|k| format!("line {}:\n  - {}\n  + {}", k + 1, line(k).0, line(k).1))
        .collect()
}

/// Tells every promise that was not kept; true if there is none.
pub fn report_broken(not_kept: &[String]) -> bool {
    not_kept.iter().for_each(|what| println!("not kept: {what}"));
    not_kept.is_empty()
}

/// How a program ends that was asked whether all is well.
pub fn exit(well: std::result::Result<bool, impl Display>) -> ExitCode {
    match well {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}
