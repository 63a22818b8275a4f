//! # Walking a TOML file so that every mistake has its line

use super::catalogue::nearest;
use crate::error::{Error, InputKind, Result};
use std::fs::File;
use std::io::Read;
use std::ops::Range;
use std::path::Path;
use toml_edit::{Document, Item, TableLike};

/// A TOML file: its text, and where it came from.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Source<'a> {
    pub path: &'a Path,
    pub text: &'a str,
}

/// No text that a person writes is longer (bytes).
const LONGEST_TEXT: u64 = 1 << 26;

/// Reads a text file that people write, with one clear message where that cannot be done.
pub(crate) fn read_text(path: &Path, what: &str) -> Result<String> {
    let mut bytes = Vec::new();
    let read = open_file(path, what)?.take(LONGEST_TEXT).read_to_end(&mut bytes);
    if read.map_err(|reason| Error::unreadable(path, &reason))? as u64 == LONGEST_TEXT {
        let problem = format!("it has {} MB or more, expected {what}", LONGEST_TEXT >> 20);
        return Err(Error::input(path, problem, "Check the path").of_kind(InputKind::Malformed));
    }
    String::from_utf8(bytes).map_err(|broken| {
        let start = broken.utf8_error().valid_up_to();
        let line = 1 + broken.as_bytes()[..start].iter().filter(|b| **b == b'\n').count();
        Error::input(path, "found bytes that are not UTF-8, expected text", "Save the file as UTF-8 text")
            .at_line(line)
            .of_kind(InputKind::Malformed)
    })
}

/// Reads a file, with one clear message where that cannot be done.
pub(crate) fn read_bytes(path: &Path, what: &str) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open_file(path, what)?.read_to_end(&mut bytes).map_err(|reason| Error::unreadable(path, &reason))?;
    Ok(bytes)
}

/// Opens a file to read, with one clear message where that cannot be done.
pub(crate) fn open_file(path: &Path, what: &str) -> Result<File> {
    if path.is_dir() {
        return Err(Error::input(path, format!("this is a folder, expected {what}"), "Name a file inside it")
            .of_kind(InputKind::Unreadable));
    }
    File::open(path).map_err(|reason| match reason.kind() {
        std::io::ErrorKind::NotFound => {
            Error::input(path, format!("no such file, expected {what}"), "Check the path, or put the file there")
                .of_kind(InputKind::NotFound)
        }
        _ => Error::unreadable(path, &reason),
    })
}

impl<'a> Source<'a> {
    /// The whole file as a table.
    pub fn parse(self) -> Result<Document<&'a str>> {
        Document::parse(self.text).map_err(|broken| {
            let told = broken.message().lines().collect::<Vec<_>>().join(", ");
            self.error(broken.span(), format!("this is not valid TOML: {told}"), "Correct the line")
                .of_kind(InputKind::Malformed)
        })
    }

    /// A mistake at a place in the file.
    pub fn error(self, span: Option<Range<usize>>, problem: impl Into<String>, fix: impl Into<String>) -> Error {
        let error = Error::input(self.path, problem, fix);
        match span {
            Some(span) => error.at_line(1 + self.text.bytes().take(span.start).filter(|b| *b == b'\n').count()),
            None => error,
        }
    }
}

/// One table of the file.
#[derive(Clone, Copy)]
pub(crate) struct Section<'a> {
    pub source: Source<'a>,
    /// Its name as a person would write it, `[motor]`.
    pub title: &'a str,
    pub table: &'a dyn TableLike,
    pub span: Option<(usize, usize)>,
}

impl<'a> Section<'a> {
    pub fn new(source: Source<'a>, title: &'a str, item: &'a Item) -> Result<Section<'a>> {
        let table = item.as_table_like().ok_or_else(|| {
            let found = item.type_name();
            source.error(item.span(), format!("found {found} for {title}, expected a table"), "Write it as a table")
        })?;
        Ok(Section::of(source, title, table, item.span()))
    }

    pub fn of(source: Source<'a>, title: &'a str, table: &'a dyn TableLike, span: Option<Range<usize>>) -> Section<'a> {
        Section { source, title, table, span: span.map(|s| (s.start, s.end)) }
    }

    /// A mistake about the table as a whole.
    pub fn error(&self, problem: impl Into<String>, fix: impl Into<String>) -> Error {
        self.source.error(self.span.map(|(start, end)| start..end), problem, fix)
    }

    /// A mistake about one of its keys.
    pub fn key_error(&self, key: &str, problem: impl Into<String>, fix: impl Into<String>) -> Error {
        let span = self.table.get_key_value(key).and_then(|(k, item)| k.span().or_else(|| item.span()));
        self.source.error(span, problem, fix).in_column(key)
    }

    /// Refuses a key that is not one of these, naming the nearest that is.
    pub fn only_keys(&self, known: &[&str]) -> Result<()> {
        let unknown = self.table.iter().find(|(key, _)| !known.contains(key));
        unknown.map_or(Ok(()), |(key, _)| {
            let fix = match nearest(key, known.iter().copied()) {
                Some(near) => format!("Did you mean `{near}`?"),
                None => format!("Known here: {}", known.join(", ")),
            };
            Err(self.key_error(key, format!("unknown key in {}", self.title), fix).of_kind(InputKind::Unknown))
        })
    }

    /// A finite number, where the key is there.
    pub fn number(&self, key: &str) -> Result<Option<f64>> {
        let Some(item) = self.table.get(key) else {
            return Ok(None);
        };
        let number = item.as_float().or_else(|| item.as_integer().map(|whole| whole as f64));
        match number {
            Some(number) if number.is_finite() => Ok(Some(number)),
            Some(number) => {
                Err(self.key_error(key, format!("found {number}, expected a finite number"), "Give a finite number"))
            }
            None => {
                let found = item.type_name();
                Err(self.key_error(key, format!("found {found}, expected a number"), "Write a plain number"))
            }
        }
    }

    /// A finite number that must be there.
    pub fn needed(&self, key: &str) -> Result<f64> {
        self.number(key)?.ok_or_else(|| {
            self.error(format!("{} lacks `{key}`", self.title), format!("Add `{key} = …`"))
                .in_column(key)
                .of_kind(InputKind::Missing)
        })
    }

    /// A number above zero that must be there.
    pub fn positive(&self, key: &str) -> Result<f64> {
        let number = self.needed(key)?;
        self.checked(key, number, number > 0.0, "a number above zero")
    }

    /// A number that is not below zero, or `default`.
    pub fn not_negative(&self, key: &str, default: f64) -> Result<f64> {
        let number = self.number(key)?.unwrap_or(default);
        self.checked(key, number, number >= 0.0, "zero or a number above it")
    }

    pub fn checked(&self, key: &str, number: f64, good: bool, expected: &str) -> Result<f64> {
        match good {
            true => Ok(number),
            false => {
                let problem = format!("found {number}, expected {expected}");
                Err(self.key_error(key, problem, "Correct the value (units are SI and stand in the key)"))
            }
        }
    }

    /// A whole number from zero up, where the key is there.
    pub fn whole(&self, key: &str) -> Result<Option<usize>> {
        let Some(item) = self.table.get(key) else {
            return Ok(None);
        };
        match item.as_integer().and_then(|number| usize::try_from(number).ok()) {
            Some(number) => Ok(Some(number)),
            None => Err(self.key_error(key, "expected a whole number from 0 up", "Write a whole number")),
        }
    }

    /// A piece of text, where the key is there.
    pub fn text(&self, key: &str) -> Result<Option<&'a str>> {
        let Some(item) = self.table.get(key) else {
            return Ok(None);
        };
        let problem = || self.key_error(key, format!("found {}, expected text", item.type_name()), "Put it in quotes");
        item.as_str().map(Some).ok_or_else(problem)
    }

    /// Yes or no, where the key is there.
    pub fn flag(&self, key: &str) -> Result<Option<bool>> {
        let Some(item) = self.table.get(key) else {
            return Ok(None);
        };
        let problem = || {
            self.key_error(key, format!("found {}, expected true or false", item.type_name()), "Write true or false")
        };
        item.as_bool().map(Some).ok_or_else(problem)
    }
}

/// The tables of an array of tables, whether written with `[[…]]` or as an inline list.
pub(crate) fn tables(item: &Item) -> Option<Vec<&dyn TableLike>> {
    match item {
        Item::ArrayOfTables(list) => Some(list.iter().map(|table| table as &dyn TableLike).collect()),
        Item::Value(value) => {
            value.as_array()?.iter().map(|v| v.as_inline_table().map(|table| table as &dyn TableLike)).collect()
        }
        _ => None,
    }
}
