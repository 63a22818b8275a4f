//! A text that can be read more than once from any place in it, without being held where it is a file.

use crate::error::{Error, Result};
use crate::log::toml_walk::open_file;
use std::fs::File;
use std::io::{BufRead, BufReader, Cursor, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

/// A text, and where it came from.
#[derive(Debug)]
pub(super) struct Text {
    path: PathBuf,
    /// What came through a pipe, which cannot be read twice; none of a file.
    piped: Option<Vec<u8>>,
    /// Its length (bytes).
    length: u64,
}

/// How much is read at a time (bytes).
const AT_A_TIME: usize = 1 << 17;

impl Text {
    /// Opens it; `what` says what was expected.
    pub fn open(path: &Path, what: &str) -> Result<Text> {
        let unreadable = |reason| Error::unreadable(path, &reason);
        let mut file = open_file(path, what)?;
        let about = file.metadata().map_err(unreadable)?;
        if about.is_file() {
            return Ok(Text { path: path.into(), piped: None, length: about.len() });
        }
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).map_err(unreadable)?;
        Ok(Text { path: path.into(), length: bytes.len() as u64, piped: Some(bytes) })
    }

    /// Its length (bytes).
    pub fn length(&self) -> u64 {
        self.length
    }

    /// What stands from this byte on.
    pub fn from(&self, byte: u64) -> Result<Box<dyn BufRead + '_>> {
        let unreadable = |reason| Error::unreadable(&self.path, &reason);
        if let Some(bytes) = &self.piped {
            let mut bytes = Cursor::new(bytes);
            bytes.set_position(byte);
            return Ok(Box::new(bytes));
        }
        let mut file = File::open(&self.path).map_err(unreadable)?;
        file.seek(SeekFrom::Start(byte)).map_err(unreadable)?;
        Ok(Box::new(BufReader::with_capacity(AT_A_TIME, file)))
    }

    /// The line, counted from 1, of the first byte from here on that ends no line.
    pub fn line_at(&self, byte: u64) -> Result<usize> {
        let unreadable = |reason| Error::unreadable(&self.path, &reason);
        let mut before = self.from(0)?.take(byte);
        let mut line = 1;
        loop {
            let part = before.fill_buf().map_err(unreadable)?;
            let length = part.len();
            if length == 0 {
                break;
            }
            line += part.iter().filter(|byte| **byte == b'\n').count();
            before.consume(length);
        }
        let rest = self.from(byte)?.bytes().map_while(std::result::Result::ok);
        Ok(line + rest.take_while(|byte| b"\r\n".contains(byte)).filter(|byte| *byte == b'\n').count())
    }
}
