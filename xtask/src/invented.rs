//! # Invented: what a new effect touches
//!
//! Copies the last commit, adds an effect that nobody has, holds the copy to the tests of the catalogue, and prints what was
//! written by hand: one new file, and its lines in one other. Whatever more an effect needs some day shows here.

use std::fs;
use std::path::{Path, PathBuf};

use crate::clean_copy;
use crate::folder::{removed, told};
use crate::line::Line;

/// The list of effects.
const LIST: &str = "model-core/src/effects/mod.rs";

/// The new effect's file.
const FILE: &str = "model-core/src/effects/drivetrain/shaft_drag.rs";

/// What stands in it for its number.
const UNNUMBERED: &str = "code: 0,";

/// The numbers that were given out, one a line.
const NUMBERS: &str = "host-tests/golden/effect_codes.txt";

/// The lines that the list gets: (after this one, this one).
const LINES: [(&str, &str); 2] = [
    ("    pub mod rotor_inertia;\n", "    pub mod shaft_drag;\n"),
    ("        drivetrain::rotor_inertia::RotorInertia,\n", "        drivetrain::shaft_drag::ShaftDrag,\n"),
];

/// The tests that hold every effect to its card; pages made from the cards are rewritten.
const TESTS: [&str; 2] = ["cargo test -p model-core --lib", "cargo test -p host-tests --test proof"];

/// Does it.
///
/// # Errors
/// What could not be done, or which test fails.
pub fn perform() -> Result<(), String> {
    let copy = std::env::temp_dir().join(format!("omni-gap-invented-{}", std::process::id()));
    let done = clean_copy::make(&copy).and_then(|()| tried(&copy));
    done.and(removed(&copy))
}

fn tried(copy: &Path) -> Result<(), String> {
    let write = |path: PathBuf, text: &str| told(&path.display().to_string(), fs::write(&path, text));
    let read = |path: &str| told(path, fs::read_to_string(copy.join(path)));
    write(copy.join(FILE), &with_number(read(NUMBERS)?.lines().count() + 1))?;
    let list = read(LIST)?;
    write(copy.join(LIST), &with_lines(&list)?)?;
    git(copy, &["add", "--intent-to-add", FILE])?;
    let diff = || Line::of("git -C").word(copy).word("diff").word("--stat").answer().unwrap_or_default();
    let by_hand = diff();
    for test in TESTS {
        let manifest = copy.join("Cargo.toml");
        let line = Line::of(test).word("--manifest-path").word(manifest).word("--target-dir").word("target/invented");
        let line = line.env("BLESS", "1");
        println!("{}", line.shown());
        if !line.succeeds() {
            return Err(format!("a new effect does not pass: {}", line.shown()));
        }
    }
    println!("written by hand:\n{by_hand}\nwith the pages that are made from the cards:\n{}", diff());
    Ok(())
}

/// The new effect's file, with the next number that no effect has.
fn with_number(number: usize) -> String {
    include_str!("../invented/shaft_drag.rs").replace(UNNUMBERED, &format!("code: {number},"))
}

/// The list with the new effect's lines.
fn with_lines(list: &str) -> Result<String, String> {
    LINES.iter().try_fold(list.to_owned(), |list, (after, line)| {
        let (before, rest) = list.split_once(after).ok_or_else(|| format!("{LIST} lacks `{}`", after.trim()))?;
        Ok(format!("{before}{after}{line}{rest}"))
    })
}

fn git(copy: &Path, words: &[&str]) -> Result<(), String> {
    let line = words.iter().fold(Line::of("git -C").word(copy), |line, word| line.word(word));
    if line.succeeds() { Ok(()) } else { Err(format!("failed: {}", line.shown())) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::line::top;

    #[test]
    fn the_new_effect_gets_its_number() {
        let text = with_number(29);
        assert!(text.contains("    code: 29,\n") && !text.contains(UNNUMBERED));
    }

    #[test]
    fn the_list_has_the_places_where_the_lines_go() {
        let list = fs::read_to_string(top().join(LIST)).expect("the list of effects");
        let more = with_lines(&list).expect("the places are there");
        assert_eq!(more.lines().count(), list.lines().count() + LINES.len());
        assert!(with_lines("pub mod nothing;").is_err());
    }
}
