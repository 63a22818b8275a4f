//! `session.toml`: what a session is of, where its folder does not say so.
//!
//! ```toml
//! robot = "r07"            # optional; else the folder below FOLDER in which it lies, else the name in robot.toml
//! date = "2026-11-03"      # optional; else a date in its path, else the day its newest recording was written
//! firmware = "1.4.2"       # optional
//! floor = "carpet"         # optional
//! ```

use std::path::Path;

use jiff::civil::Date;

use crate::error::{InputKind, Result};
use crate::log::{Section, TomlSource, read_text};

/// The name of the file.
pub(super) const FILE: &str = "session.toml";

/// What it says.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Labels {
    pub robot: Option<String>,
    pub date: Option<Date>,
    pub firmware: Option<String>,
    pub floor: Option<String>,
}

impl Labels {
    /// Those of a session's folder; nothing where it has no such file.
    pub fn of(session: &Path) -> Result<Self> {
        let path = session.join(FILE);
        if !path.exists() {
            return Ok(Self::default());
        }
        let text = read_text(&path, "the labels of a session")?;
        let source = TomlSource { path: &path, text: &text };
        let document = source.parse()?;
        let section = Section::of(source, "", document.as_table(), None);
        section.only_keys(&["robot", "date", "firmware", "floor"])?;
        let owned = |key: &str| section.text(key).map(|text| text.map(str::to_owned));
        let date = section.text("date")?.map(|text| {
            text.parse::<Date>().map_err(|_| {
                let problem = format!("found \"{text}\", expected a day as YYYY-MM-DD");
                section.key_error("date", problem, "Write it as in 2026-11-03").of_kind(InputKind::Invalid)
            })
        });
        let robot = owned("robot")?;
        if robot.as_deref() == Some("") {
            return Err(section.key_error(
                "robot",
                "found no name, expected one",
                "Name the robot, or leave the key out",
            ));
        }
        Ok(Self { robot, date: date.transpose()?, firmware: owned("firmware")?, floor: owned("floor")? })
    }
}

/// The first date in a path, as 2026-11-03 or 20261103.
pub(super) fn date_in(path: &Path) -> Option<Date> {
    let text = path.to_string_lossy();
    let digits: Vec<char> = text.chars().collect();
    let date_at = |from: usize| {
        let long: String = digits[from..].iter().take(10).collect();
        let short: String = digits[from..].iter().take(8).collect();
        let before = from.checked_sub(1).map(|k| digits[k]);
        let ends = |length: usize| !digits.get(from + length).is_some_and(char::is_ascii_digit);
        if before.is_some_and(|c| c.is_ascii_digit()) {
            return None;
        }
        let plain = |text: &str, length: usize| text.len() == length && text.is_ascii();
        let long = (plain(&long, 10) && ends(10)).then(|| long.parse::<Date>().ok()).flatten();
        let digits_only = plain(&short, 8) && short.bytes().all(|c| c.is_ascii_digit()) && ends(8);
        let short = || digits_only.then(|| format!("{}-{}-{}", &short[..4], &short[4..6], &short[6..]).parse().ok());
        long.or_else(|| short().flatten())
    };
    (0..digits.len()).filter(|k| digits[*k].is_ascii_digit()).find_map(date_at)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(text: &str) -> Result<Labels> {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join(FILE), text).unwrap();
        Labels::of(folder.path())
    }

    #[test]
    fn all_keys_are_optional_and_others_are_refused_with_their_line() {
        let told = labels("robot = \"r07\"\ndate = \"2026-11-03\"\nfirmware = \"1.4\"\nfloor = \"carpet\"\n").unwrap();
        assert_eq!(told.robot.as_deref(), Some("r07"));
        assert_eq!(told.date, Some("2026-11-03".parse().unwrap()));
        assert_eq!((told.firmware.as_deref(), told.floor.as_deref()), (Some("1.4"), Some("carpet")));
        assert_eq!(labels("").unwrap(), Labels::default());
        for (text, expected) in [
            ("flor = \"carpet\"", "session.toml:1"),
            ("\ndate = \"3.11.2026\"", "session.toml:2"),
            ("robot = 7", "robot"),
            ("robot = \"\"", "expected one"),
        ] {
            let why = labels(text).unwrap_err().to_string();
            assert!(why.contains(expected), "{text}: {why}");
        }
    }

    #[test]
    fn a_date_is_found_in_a_path_and_nothing_else_is_one() {
        let date = |path: &str| date_in(Path::new(path)).map(|date| date.to_string());
        assert_eq!(date("logs/r07/2026-11-03-morning").as_deref(), Some("2026-11-03"));
        assert_eq!(date("logs/20261103T101500/a").as_deref(), Some("2026-11-03"));
        assert_eq!(date("r07/run2026-02-30"), None);
        assert_eq!(date("r07/120261103"), None);
        assert_eq!(date("größe/ä-2026-01-02").as_deref(), Some("2026-01-02"));
    }
}
