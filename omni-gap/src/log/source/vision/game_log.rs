//! The file of a game log: a header, then records as they were received, often all of it packed by gzip.
//!
//! Integers are big-endian: `SSL_LOG_FILE`, version (i32), and of each record the time of its receipt (ns, i64), the
//! type of its message (i32), the message's size (bytes, i32) and the message.

use crate::error::{Error, InputKind, Result};
use flate2::Compression;
use flate2::bufread::MultiGzDecoder;
use flate2::write::GzEncoder;
use std::fs::File;
use std::io::{BufRead, BufReader, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

/// How a game log begins.
pub(super) const MAGIC: &[u8] = b"SSL_LOG_FILE";

/// The version of the format that is read.
const VERSION: i32 = 1;

/// Bytes of the version behind it.
const VERSION_BYTES: usize = 4;

/// How gzip begins.
const GZIP_MAGIC: [u8; 2] = [0x1f, 0x8b];

/// Types of messages that are packets of SSL-Vision: of 2010, whose detections are the same, and of 2014.
const VISION_TYPES: [i32; 2] = [2, 4];

/// The type of a packet that is written.
const WRITTEN_TYPE: i32 = 4;

/// No record is believed to be longer (bytes): an index has eight bytes for each record.
const LONGEST: i32 = 1 << 28;

/// No packet of SSL-Vision either: it is one of UDP, and room is made for it.
const LONGEST_PACKET: i32 = 1 << 16;

/// Bytes of a record before its message.
const RECORD_HEAD: usize = 16;

const CUT_OFF: &str = "the recording ends in the middle of a record; what stands before it was read";

/// An opened game log, read from front to back.
pub(super) struct GameLog {
    path: PathBuf,
    reader: Box<dyn Read>,
    /// Bytes read, unpacked.
    place: u64,
    records: usize,
}

/// One record of a game log.
#[derive(Debug, Default)]
pub(super) struct Record {
    pub received_ns: i64,
    pub of_type: i32,
    pub message: Vec<u8>,
}

/// Whether all bytes that were asked for were there.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Got {
    All,
    Some,
    Nothing,
}

impl GameLog {
    /// Opens a log, packed or not, and checks its header.
    pub fn open(path: &Path) -> Result<GameLog> {
        let unreadable = |reason| Error::unreadable(path, &reason);
        let mut file = BufReader::new(File::open(path).map_err(unreadable)?);
        let is_packed = file.fill_buf().map_err(unreadable)?.starts_with(&GZIP_MAGIC);
        let reader: Box<dyn Read> =
            if is_packed { Box::new(BufReader::new(MultiGzDecoder::new(file))) } else { Box::new(file) };
        let mut log = GameLog { path: path.into(), reader, place: 0, records: 0 };
        log.check_header()?;
        Ok(log)
    }

    fn check_header(&mut self) -> Result<()> {
        let mut head = Vec::new();
        self.take(MAGIC.len() + VERSION_BYTES, &mut head)?;
        let version = head.strip_prefix(MAGIC).map(|rest| rest.try_into().map(i32::from_be_bytes));
        let (problem, kind) = match version {
            Some(Ok(VERSION)) => return Ok(()),
            Some(Ok(other)) => {
                let kind = if other > VERSION { InputKind::Newer } else { InputKind::Malformed };
                (format!("it is a game log of version {other}, expected version {VERSION}"), kind)
            }
            Some(Err(_)) => {
                ("it ends within its header, expected a game log with records".into(), InputKind::TooLittle)
            }
            None if head.is_empty() => ("the file is empty, expected a game log".into(), InputKind::TooLittle),
            None => {
                let found = head[..head.len().min(MAGIC.len())].escape_ascii();
                let expected = "expected `SSL_LOG_FILE`, as a game log of SSL-Vision does";
                (format!("it begins with `{found}`, {expected}"), InputKind::Malformed)
            }
        };
        let fix = match kind {
            InputKind::TooLittle => "Copy it again, or name another log",
            _ => "Convert a log of another version with `logconvert -f 1` of ssl-logtools, or name another log",
        };
        Err(Error::input(&self.path, problem, fix).of_kind(kind))
    }

    /// Hands over all records of packets of SSL-Vision; says so where the log was cut off.
    pub fn vision_packets(mut self, mut take: impl FnMut(&Record)) -> Result<Option<&'static str>> {
        let mut head = Vec::with_capacity(RECORD_HEAD);
        let mut record = Record::default();
        loop {
            match self.take(RECORD_HEAD, &mut head)? {
                Got::Nothing => return Ok(None),
                Got::Some => return Ok(Some(CUT_OFF)),
                Got::All => {}
            }
            self.records += 1;
            let bytes = |from: usize| [head[from], head[from + 1], head[from + 2], head[from + 3]];
            let (upper, lower) = (bytes(0), bytes(4));
            record.received_ns = i64::from(i32::from_be_bytes(upper)) << 32 | i64::from(u32::from_be_bytes(lower));
            record.of_type = i32::from_be_bytes(bytes(8));
            let size = i32::from_be_bytes(bytes(12));
            let is_vision = VISION_TYPES.contains(&record.of_type);
            let longest = if is_vision { LONGEST_PACKET } else { LONGEST };
            if !(0..=longest).contains(&size) {
                let problem = format!(
                    "record {}, before byte {}, states a size of {size} bytes, expected 0 to {longest}",
                    self.records, self.place
                );
                let fix = "Copy the log again; if it stays so, the log is damaged: use another";
                return Err(Error::input(&self.path, problem, fix).of_kind(InputKind::Malformed));
            }
            let got = if is_vision {
                self.take(size as usize, &mut record.message)?
            } else {
                self.skip(u64::from(size.unsigned_abs()))?
            };
            match got {
                Got::All if is_vision => take(&record),
                Got::All => {}
                Got::Some | Got::Nothing => return Ok(Some(CUT_OFF)),
            }
        }
    }

    /// Reads so many bytes, or as many as there are.
    fn take(&mut self, count: usize, bytes: &mut Vec<u8>) -> Result<Got> {
        bytes.clear();
        let read = self.reader.by_ref().take(count as u64).read_to_end(bytes);
        self.got(bytes.len() as u64, count as u64, read.err())
    }

    /// Passes over so many bytes, or as many as there are.
    fn skip(&mut self, count: u64) -> Result<Got> {
        let passed = std::io::copy(&mut self.reader.by_ref().take(count), &mut std::io::sink());
        match passed {
            Ok(passed) => self.got(passed, count, None),
            Err(reason) => self.got(0, count, Some(reason)),
        }
    }

    fn got(&mut self, read: u64, count: u64, reason: Option<std::io::Error>) -> Result<Got> {
        self.place += read;
        match reason {
            _ if read == count => Ok(Got::All),
            None if read == 0 => Ok(Got::Nothing),
            None => Ok(Got::Some),
            // gzip that was cut off
            Some(reason) if reason.kind() == ErrorKind::UnexpectedEof => Ok(Got::Some),
            Some(reason) => {
                let problem = format!("cannot be read beyond byte {}: {reason}", self.place);
                Err(Error::input(
                    &self.path,
                    problem,
                    "Copy the log again, and check it with `gzip -t` if it is packed",
                )
                .of_kind(InputKind::Malformed))
            }
        }
    }
}

/// A packet of SSL-Vision as it came.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Packet {
    /// When (ns since 1970).
    pub received_ns: i64,
    /// What.
    pub bytes: Vec<u8>,
}

/// Writes packets as a game log, packed.
pub(crate) fn write_game_log(out: &mut dyn Write, packets: &[Packet]) -> std::io::Result<()> {
    let mut out = GzEncoder::new(out, Compression::default());
    out.write_all(MAGIC)?;
    out.write_all(&VERSION.to_be_bytes())?;
    for Packet { received_ns, bytes } in packets {
        let size = i32::try_from(bytes.len()).map_err(std::io::Error::other)?;
        out.write_all(&received_ns.to_be_bytes())?;
        out.write_all(&WRITTEN_TYPE.to_be_bytes())?;
        out.write_all(&size.to_be_bytes())?;
        out.write_all(bytes)?;
    }
    out.finish().map(drop)
}
