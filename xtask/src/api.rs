//! # API: what programs of others may call, listed, and compared with the release before
//!
//! What the crates promise is a list in the tree, so that a change of it is read before it is made; what Python promises is listed by
//! `python/tests/listing.py`. Against the last release, a change that breaks somebody's program needs another version.

use std::ffi::OsString;
use std::fs;

use crate::folder::told;
use crate::line::{Line, top};
use crate::tool;

/// The crates that others may depend on.
const CRATES: [&str; 2] = ["model-core", "omni-gap"];

/// Where the lists are.
const LISTS: &str = "host-tests/golden/api";

/// How the subject of a release's commit begins; its version follows.
const RELEASE: &str = "release: ";

/// Checks it; with `BLESS=1` lists it anew.
///
/// # Errors
/// What to tell the person.
pub fn perform(_: &[OsString]) -> Result<(), String> {
    tool::ensure(tool::API)?;
    CRATES.into_iter().try_for_each(as_listed)?;
    let Some((commit, version)) = release_before() else {
        println!("there is no release before this commit to compare with");
        return Ok(());
    };
    println!("compared with {version}, the release before:");
    let line = Line::of("cargo semver-checks --baseline-rev").word(commit);
    CRATES.into_iter().fold(line, |line, name| line.word("-p").word(name)).announced()
}

/// Compares what a crate has with its list.
fn as_listed(name: &str) -> Result<(), String> {
    let line =
        Line::of("cargo +nightly public-api --omit blanket-impls,auto-trait-impls,auto-derived-impls -p").word(name);
    println!("{}", line.shown());
    let now = line.answer().ok_or_else(|| format!("failed: {}", line.shown()))?;
    let list = format!("{LISTS}/{name}.txt");
    let at = top().join(&list);
    if std::env::var_os("BLESS").is_some() {
        return told(&list, fs::write(&at, now));
    }
    let listed = told(&list, fs::read_to_string(&at))?;
    match difference(&listed, &now) {
        told if told.is_empty() => Ok(()),
        told => Err(format!("{list} lists something else; where that is meant, BLESS=1 lists it anew:\n{told}")),
    }
}

/// Lines that are in one list alone, those of the first with a minus.
fn difference(listed: &str, now: &str) -> String {
    let alone = |of: &str, other: &str, sign: char| -> String {
        let other: std::collections::HashSet<&str> = other.lines().collect();
        of.lines().filter(|line| !other.contains(line)).map(|line| format!("{sign} {line}\n")).collect()
    };
    alone(listed, now, '-') + &alone(now, listed, '+')
}

/// The commit of the last release before this commit, and its version.
fn release_before() -> Option<(String, String)> {
    let told = Line::of("git log -1 --format=%H%n%s HEAD~1 --grep").word(format!("^{RELEASE}")).answer()?;
    let (commit, subject) = told.trim().split_once('\n')?;
    Some((commit.to_owned(), subject.trim_start_matches(RELEASE).to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_came_and_what_went_is_told() {
        assert_eq!(difference("a\nb\n", "a\nb\n"), "");
        assert_eq!(difference("a\nb\n", "b\nc\n"), "- a\n+ c\n");
    }
}
