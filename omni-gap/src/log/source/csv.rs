//! # Tables as text: rows of numbers, fast, and a place for every mistake
//!
//! A field is a number, a date with its time, or empty. A number that is not finite, or text, is refused with line and column.

use super::date_time;
use super::opened::Source;
use super::text::Text;
use crate::error::{Error, InputKind, Result};
use crate::log::channel::{Channel, Missing};
use std::collections::HashSet;
use std::io::{BufRead, Read};
use std::path::{Path, PathBuf};

/// How the text is laid out.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Layout {
    pub separator: u8,
    /// What stands between a number's whole part and the rest: `.` or `,`.
    pub decimal: u8,
    /// Lines to leave out before the header, or before the first row where there is no header.
    pub skip_lines: usize,
    /// Whether a line of column names follows.
    pub header: bool,
}

impl Default for Layout {
    fn default() -> Self {
        Layout { separator: b',', decimal: b'.', skip_lines: 0, header: true }
    }
}

/// An opened log: where its rows begin, and the names of its columns. It is read row by row, and never held.
#[derive(Debug)]
pub(super) struct Table {
    path: PathBuf,
    text: Text,
    // empty where the layout has no header
    names: Vec<String>,
    // an empty last column not counted
    width: usize,
    // where the rows begin (bytes)
    start: u64,
    separator: u8,
    decimal: u8,
}

impl Table {
    pub fn open(path: &Path, layout: &Layout) -> Result<Table> {
        let text = Text::open(path, "a run log")?;
        let Layout { separator, decimal, .. } = *layout;
        let start = after_lines(path, &text, layout.skip_lines)?;
        let mut table = Table { path: path.into(), text, names: Vec::new(), width: 0, start, separator, decimal };
        let mut record = csv::ByteRecord::new();
        let mut reader = table.reader()?;
        if !table.next(&mut reader, &mut record)? {
            return Err(Error::input(path, "there are no rows below the lines to skip", "Check skip_lines")
                .of_kind(InputKind::TooLittle));
        }
        let end = reader.position().byte();
        drop(reader);
        let last_is_empty = record.get(record.len() - 1).is_some_and(|last| last.trim_ascii().is_empty());
        table.width = record.len() - usize::from(last_is_empty && record.len() > 1);
        if layout.header {
            let line = table.line(&record);
            if record.iter().any(|field| std::str::from_utf8(field).is_err()) {
                return Err(table.not_text(line));
            }
            let text = |field: &[u8]| String::from_utf8_lossy(field.trim_ascii()).into_owned();
            table.names = record.iter().take(table.width).map(text).collect();
            table.start += end;
            table.check_names(line)?;
        }
        Ok(table)
    }

    fn check_names(&self, line: usize) -> Result<()> {
        if self.names.iter().all(|name| name.parse::<f64>().is_ok()) {
            let problem = "found a line of numbers, expected a header line with column names";
            return Err(Error::input(
                &self.path,
                problem,
                "Add the header line, or describe the layout in columns.toml",
            )
            .at_line(line)
            .of_kind(InputKind::Missing));
        }
        let mut seen = HashSet::with_capacity(self.names.len());
        let twice = self.names.iter().find(|name| !name.is_empty() && !seen.insert(*name));
        twice.map_or(Ok(()), |name| {
            let error = Error::input(&self.path, "the column stands twice in the header", "Keep one of the two")
                .of_kind(InputKind::Conflict);
            Err(error.at_line(line).in_column(name))
        })
    }

    fn reader(&self) -> Result<Reader<'_>> {
        let mut settings = csv::ReaderBuilder::new();
        settings.delimiter(self.separator).has_headers(false).flexible(true).buffer_capacity(1 << 17);
        Ok(settings.from_reader(self.text.from(self.start)?))
    }

    fn next(&self, reader: &mut Reader, record: &mut csv::ByteRecord) -> Result<bool> {
        reader.read_byte_record(record).map_err(|reason| match reason.kind() {
            csv::ErrorKind::Io(reason) => Error::unreadable(&self.path, reason),
            _ => {
                let problem = format!("cannot be read as a table: {reason}");
                Error::input(&self.path, problem, "Check separators and quotes").of_kind(InputKind::Malformed)
            }
        })
    }

    fn number(&self, field: &[u8]) -> Option<f64> {
        let text = std::str::from_utf8(field).ok()?;
        let number = match self.decimal {
            b',' => text.replace(',', ".").parse().ok(),
            _ => text.parse().ok(),
        };
        number.or_else(|| date_time::seconds(text))
    }

    fn not_a_number(&self, record: &csv::ByteRecord, column: usize) -> Error {
        let line = self.line(record);
        let Ok(field) = std::str::from_utf8(record[column].trim_ascii()) else { return self.not_text(line) };
        let problem = format!("found `{field}`, expected a finite number");
        Error::input(&self.path, problem, "Correct the field, or leave it empty where the sample is missing")
            .at_line(line)
            .in_column(self.title(column))
    }

    fn not_text(&self, line: usize) -> Error {
        let problem = "found bytes that are not UTF-8, expected text";
        Error::input(&self.path, problem, "Save the log as plain UTF-8 text")
            .at_line(line)
            .of_kind(InputKind::Malformed)
    }

    /// The line on which a record stands; the first, where the file can no longer be read.
    fn line(&self, record: &csv::ByteRecord) -> usize {
        let byte = self.start + record.position().map_or(0, csv::Position::byte);
        self.text.line_at(byte).unwrap_or(1)
    }

    /// How many rows there are, by the length of the first; no more than there is room for, where that one is not like the others.
    fn rows_about(&self) -> Result<usize> {
        let mut first = Vec::new();
        let rows = self.text.from(self.start)?;
        let limit = self.text.length() - self.start.min(self.text.length());
        let read = rows.take(limit).read_until(b'\n', &mut first);
        let length = read.map_err(|reason| Error::unreadable(&self.path, &reason))?;
        // each of a row's fields has a separator or the line's end behind it
        let shortest = self.width.max(length + 1) as u64;
        Ok((limit / shortest) as usize + 16)
    }
}

impl Source for Table {
    fn path(&self) -> &Path {
        &self.path
    }

    fn names(&self) -> &[String] {
        &self.names
    }

    fn width(&self) -> usize {
        self.width
    }

    fn columns(&mut self, wanted: &[usize]) -> Result<Vec<Channel>> {
        let rows = self.rows_about()?;
        let mut columns: Vec<Channel> = wanted.iter().map(|_| Channel::with_capacity(rows)).collect();
        let mut reader = self.reader()?;
        let mut record = csv::ByteRecord::new();
        while self.next(&mut reader, &mut record)? {
            let extra = record.len() == self.width + 1 && record[self.width].trim_ascii().is_empty();
            if record.len() != self.width && !extra {
                let problem = format!("found {} fields, expected {}", record.len(), self.width);
                let fix = "Complete or remove the row; an empty field marks a missing sample";
                return Err(Error::input(&self.path, problem, fix)
                    .at_line(self.line(&record))
                    .of_kind(InputKind::Malformed));
            }
            for (channel, &column) in columns.iter_mut().zip(wanted) {
                let field = record[column].trim_ascii();
                if field.is_empty() {
                    channel.push_missing(Missing::Blank);
                    continue;
                }
                match self.number(field) {
                    Some(value) if value.is_finite() => channel.push(value),
                    _ => return Err(self.not_a_number(&record, column)),
                }
            }
        }
        Ok(columns)
    }

    fn line_of(&self, row: usize) -> Option<usize> {
        let mut reader = self.reader().ok()?;
        let mut record = csv::ByteRecord::new();
        for _ in 0..=row {
            self.next(&mut reader, &mut record).ok()?;
        }
        Some(self.line(&record))
    }
}

type Reader<'a> = csv::Reader<Box<dyn BufRead + 'a>>;

/// Where the text goes on below its first lines, a byte-order mark left out (bytes).
fn after_lines(path: &Path, text: &Text, lines: usize) -> Result<u64> {
    let unreadable = |reason| Error::unreadable(path, &reason);
    let mark = text.from(0)?.fill_buf().map_err(unreadable)?.starts_with(BYTE_ORDER_MARK);
    let mut start = if mark { BYTE_ORDER_MARK.len() as u64 } else { 0 };
    let mut rest = text.from(start)?;
    let is_empty = !rest.by_ref().bytes().any(|byte| !byte.is_ok_and(|byte| byte.is_ascii_whitespace()));
    if is_empty {
        let problem = "the file is empty, expected a header line and rows";
        return Err(Error::input(path, problem, "Record the run again").of_kind(InputKind::TooLittle));
    }
    let mut rest = text.from(start)?;
    let mut line = Vec::new();
    for _ in 0..lines {
        line.clear();
        start += rest.read_until(b'\n', &mut line).map_err(unreadable)? as u64;
    }
    Ok(start)
}

const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";
