//! # Tables as text: rows of numbers, fast, and a place for every mistake
//!
//! A field is a number, a date with its time, or empty. A number that is not finite, or text, is refused with line and column.

use super::date_time;
use super::opened::Source;
use crate::error::{Error, InputKind, Result};
use crate::log::channel::{Channel, Missing};
use crate::log::toml_walk::read_bytes;
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

/// An opened log: its text, and the names of its columns.
#[derive(Debug)]
pub(super) struct Table {
    path: PathBuf,
    // empty where the layout has no header
    names: Vec<String>,
    // an empty last column not counted
    width: usize,
    bytes: Vec<u8>,
    start: usize,
    lines_before: usize,
    separator: u8,
    decimal: u8,
}

impl Table {
    pub fn open(path: &Path, layout: &Layout) -> Result<Table> {
        let bytes = read_bytes(path, "a run log")?;
        if let Err(broken) = std::str::from_utf8(&bytes) {
            let line = 1 + count_lines(&bytes[..broken.valid_up_to()]);
            let problem = "found bytes that are not UTF-8, expected text";
            return Err(Error::input(path, problem, "Save the log as plain UTF-8 text")
                .at_line(line)
                .of_kind(InputKind::Malformed));
        }
        let mut start = if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        if bytes[start..].iter().all(u8::is_ascii_whitespace) {
            return Err(Error::input(
                path,
                "the file is empty, expected a header line and rows",
                "Record the run again",
            )
            .of_kind(InputKind::TooLittle));
        }
        for _ in 0..layout.skip_lines {
            start += line_end(&bytes[start..]);
        }
        let mut table = Table {
            path: path.into(),
            names: Vec::new(),
            width: 0,
            lines_before: count_lines(&bytes[..start]),
            start,
            bytes,
            separator: layout.separator,
            decimal: layout.decimal,
        };
        let mut record = csv::ByteRecord::new();
        let mut reader = table.reader();
        if !reader.read_byte_record(&mut record).map_err(|e| table.broken(&e))? {
            return Err(Error::input(path, "there are no rows below the lines to skip", "Check skip_lines")
                .of_kind(InputKind::TooLittle));
        }
        let end = reader.position().byte() as usize;
        let lines = reader.position().line() as usize - 1;
        drop(reader);
        let last_is_empty = record.get(record.len() - 1).is_some_and(|last| last.trim_ascii().is_empty());
        table.width = record.len() - usize::from(last_is_empty && record.len() > 1);
        if layout.header {
            let text = |field: &[u8]| String::from_utf8_lossy(field.trim_ascii()).into_owned();
            table.names = record.iter().take(table.width).map(text).collect();
            table.start += end;
            table.lines_before += lines;
            table.check_names(table.lines_before)?;
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
        let twice =
            self.names.iter().enumerate().find(|(at, name)| self.names[..*at].contains(name) && !name.is_empty());
        twice.map_or(Ok(()), |(_, name)| {
            let error = Error::input(&self.path, "the column stands twice in the header", "Keep one of the two")
                .of_kind(InputKind::Conflict);
            Err(error.at_line(line).in_column(name))
        })
    }

    fn reader(&self) -> csv::Reader<&[u8]> {
        csv::ReaderBuilder::new()
            .delimiter(self.separator)
            .has_headers(false)
            .flexible(true)
            .buffer_capacity(1 << 17)
            .from_reader(&self.bytes[self.start..])
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
        let field = String::from_utf8_lossy(record[column].trim_ascii());
        let problem = format!("found `{field}`, expected a finite number");
        Error::input(&self.path, problem, "Correct the field, or leave it empty where the sample is missing")
            .at_line(self.line(record))
            .in_column(self.title(column))
    }

    fn first_row_length(&self) -> usize {
        line_end(&self.bytes[self.start..])
    }

    fn line(&self, record: &csv::ByteRecord) -> usize {
        // the position may lie before line ends that the reader has yet to skip
        let byte = self.start + record.position().map_or(0, |at| at.byte() as usize);
        let ends = self.bytes[byte..].iter().take_while(|b| b"\r\n".contains(b)).count();
        1 + count_lines(&self.bytes[..byte + ends])
    }

    fn broken(&self, reason: &csv::Error) -> Error {
        Error::input(&self.path, format!("cannot be read as a table: {reason}"), "Check separators and quotes")
            .of_kind(InputKind::Malformed)
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

    fn columns(&self, wanted: &[usize]) -> Result<Vec<Channel>> {
        let rows = self.bytes.len() / (self.first_row_length() + 1) + 16;
        let mut columns: Vec<Channel> = wanted.iter().map(|_| Channel::with_capacity(rows)).collect();
        let mut reader = self.reader();
        let mut record = csv::ByteRecord::new();
        while reader.read_byte_record(&mut record).map_err(|e| self.broken(&e))? {
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
        let mut reader = self.reader();
        let mut record = csv::ByteRecord::new();
        for _ in 0..=row {
            let _ = reader.read_byte_record(&mut record);
        }
        Some(self.line(&record))
    }
}

fn count_lines(bytes: &[u8]) -> usize {
    bytes.iter().filter(|byte| **byte == b'\n').count()
}

/// Where the line that starts here ends, its line feed included.
fn line_end(bytes: &[u8]) -> usize {
    bytes.iter().position(|byte| *byte == b'\n').map_or(bytes.len(), |at| at + 1)
}
