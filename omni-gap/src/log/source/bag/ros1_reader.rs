//! The records of a ROS 1 recording, format 2.0 (<https://wiki.ros.org/Bags/Format/2.0>), read from the file a chunk at a time.
//!
//! A record is a header, fields `name=value`, and data, each with its length before it (four bytes, little-endian). Chunks of messages come
//! first, then the index, with the connections: who sent what. Nothing is mapped into memory: a file that is cut off meanwhile would end the
//! program. A chunk says what it unpacks to, and no more of it is unpacked.

use super::super::longest_part::{LONGEST, SHORT, longest_part};
use bzip2::read::BzDecoder;
use lz4_flex::frame::FrameDecoder;
use std::fs::File;
use std::io::{BufReader, ErrorKind, Read, Seek, SeekFrom};

/// How such a recording begins.
pub(super) const MAGIC: &[u8] = b"#ROSBAG V2.0\n";

/// Kinds of records.
mod op {
    pub const MESSAGE: u8 = 2;
    pub const RECORDING: u8 = 3;
    pub const INDEX: u8 = 4;
    pub const CHUNK: u8 = 5;
    pub const CONNECTION: u8 = 7;
}

/// Why something cannot be read, in words.
type Result<T> = std::result::Result<T, String>;

/// An opened recording.
#[derive(Debug)]
pub(super) struct Bag {
    file: File,
    /// Where the chunks begin, where the index does, and where the file ends (bytes).
    chunks: u64,
    index: u64,
    end: u64,
}

/// Who sent messages of which type.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Connection {
    pub id: u32,
    pub topic: String,
    pub of_type: String,
    pub definition: String,
}

/// One message.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Message<'a> {
    pub connection: u32,
    pub time_ns: u64,
    pub bytes: &'a [u8],
}

impl Bag {
    /// Opens a recording; none where its index is missing, as a recorder leaves it that lost its power.
    pub fn open(file: File) -> Result<Option<Bag>> {
        let end = file.metadata().map_err(told)?.len();
        let mut records = Records::of(&file, MAGIC.len() as u64, end)?;
        let header = records.header()?.ok_or_else(cut_off)?;
        if kind(&header)? != op::RECORDING {
            return Err("it does not begin with a recording's own record".into());
        }
        records.skip()?;
        let (chunks, index) = (records.at, u64::from_le_bytes(fixed(&header, "index_pos")?));
        Ok((chunks..=end).contains(&index).then_some(Bag { file, chunks, index, end }))
    }

    /// The connections, as the index lists them.
    pub fn connections(&self) -> Result<Vec<Connection>> {
        let mut records = Records::of(&self.file, self.index, self.end)?;
        let mut all = Vec::new();
        while let Some(header) = records.header()? {
            if kind(&header)? != op::CONNECTION {
                records.skip()?;
                continue;
            }
            let data = records.data(self.longest())?;
            let text = |fields: &[u8], name: &str| {
                let bytes = field(fields, name)?.ok_or_else(|| lacks(name))?;
                std::str::from_utf8(bytes).map(str::to_owned).map_err(|_| format!("`{name}` in it is no text"))
            };
            all.push(Connection {
                id: u32::from_le_bytes(fixed(&header, "conn")?),
                topic: text(&header, "topic")?,
                of_type: text(&data, "type")?,
                definition: text(&data, "message_definition")?,
            });
        }
        Ok(all)
    }

    /// Hands over all messages; `broken` makes an error of why it cannot go on.
    pub fn each<E>(
        &self,
        broken: impl Fn(String) -> E,
        mut take: impl FnMut(Message) -> std::result::Result<(), E>,
    ) -> std::result::Result<(), E> {
        let mut records = Records::of(&self.file, self.chunks, self.index).map_err(&broken)?;
        while let Some(chunk) = self.chunk(&mut records).map_err(&broken)? {
            let mut rest = &chunk[..];
            while !rest.is_empty() {
                if let Some(message) = message(&mut rest).map_err(&broken)? {
                    take(message)?;
                }
            }
        }
        Ok(())
    }

    /// The next chunk, unpacked.
    fn chunk(&self, records: &mut Records) -> Result<Option<Vec<u8>>> {
        while let Some(header) = records.header()? {
            match kind(&header)? {
                op::CHUNK => return self.unpacked(&header, records.data(LONGEST)?).map(Some),
                op::INDEX => records.skip()?,
                other => return Err(format!("a record of kind {other} stands between its chunks")),
            }
        }
        Ok(None)
    }

    fn unpacked(&self, header: &[u8], packed: Vec<u8>) -> Result<Vec<u8>> {
        let size = u64::from(u32::from_le_bytes(fixed(header, "size")?));
        if size > self.longest() {
            let most = self.longest();
            return Err(format!(
                "a chunk of {} bytes says that it unpacks to {size}, expected {most} at the most",
                packed.len()
            ));
        }
        let mut bytes = Vec::new();
        // one more than it says: that is too many
        let read = match field(header, "compression")? {
            Some(b"none") => {
                bytes = packed;
                Ok(0)
            }
            Some(b"bz2") => BzDecoder::new(&packed[..]).take(size + 1).read_to_end(&mut bytes),
            Some(b"lz4") => FrameDecoder::new(&packed[..]).take(size + 1).read_to_end(&mut bytes),
            _ => return Err("a chunk is packed in a way that the format does not know".into()),
        };
        read.map_err(|reason| format!("a chunk cannot be unpacked: {reason}"))?;
        if bytes.len() as u64 != size {
            return Err(format!("a chunk does not unpack to the {size} bytes that it says"));
        }
        Ok(bytes)
    }

    fn longest(&self) -> u64 {
        longest_part(self.end)
    }
}

/// Records of a file from one place to another.
struct Records<'a> {
    file: BufReader<&'a File>,
    at: u64,
    end: u64,
}

impl<'a> Records<'a> {
    fn of(file: &'a File, at: u64, end: u64) -> Result<Self> {
        let mut file = BufReader::new(file);
        file.seek(SeekFrom::Start(at)).map_err(told)?;
        Ok(Records { file, at, end })
    }

    /// The header of the next record; none at the end.
    fn header(&mut self) -> Result<Option<Vec<u8>>> {
        if self.at == self.end { Ok(None) } else { self.data(SHORT).map(Some) }
    }

    /// What has its length before it.
    fn data(&mut self, longest: u64) -> Result<Vec<u8>> {
        let length = self.length()?;
        if length > longest {
            return Err(format!("a record says that it has {length} bytes, expected {longest} at the most"));
        }
        let mut bytes = vec![0; length as usize];
        self.file.read_exact(&mut bytes).map_err(told)?;
        self.at += length;
        Ok(bytes)
    }

    fn skip(&mut self) -> Result<()> {
        let length = self.length()?;
        self.at += length;
        self.file.seek_relative(length as i64).map_err(told)
    }

    fn length(&mut self) -> Result<u64> {
        let mut length = [0; 4];
        let left = self.end.checked_sub(self.at + 4).ok_or_else(cut_off)?;
        self.file.read_exact(&mut length).map_err(told)?;
        self.at += 4;
        let length = u64::from(u32::from_le_bytes(length));
        if length > left { Err(cut_off()) } else { Ok(length) }
    }
}

/// The message that comes next in a chunk; none where it is another record.
fn message<'a>(rest: &mut &'a [u8]) -> Result<Option<Message<'a>>> {
    let header = with_length(rest)?;
    let bytes = with_length(rest)?;
    match kind(header)? {
        op::MESSAGE => {
            let time: [u8; 8] = fixed(header, "time")?;
            let [s, ns] =
                [0, 4].map(|at| u64::from(u32::from_le_bytes([time[at], time[at + 1], time[at + 2], time[at + 3]])));
            let connection = u32::from_le_bytes(fixed(header, "conn")?);
            Ok(Some(Message { connection, time_ns: 1_000_000_000 * s + ns, bytes }))
        }
        op::CONNECTION => Ok(None),
        other => Err(format!("a record of kind {other} stands in a chunk")),
    }
}

/// What has its length before it.
fn with_length<'a>(rest: &mut &'a [u8]) -> Result<&'a [u8]> {
    let (length, behind) = rest.split_first_chunk().ok_or_else(cut_off)?;
    let (bytes, behind) = behind.split_at_checked(u32::from_le_bytes(*length) as usize).ok_or_else(cut_off)?;
    *rest = behind;
    Ok(bytes)
}

/// A field of a header; none where it has none of this name.
fn field<'a>(mut header: &'a [u8], name: &str) -> Result<Option<&'a [u8]>> {
    while !header.is_empty() {
        let field = with_length(&mut header)?;
        let equals = field.iter().position(|byte| *byte == b'=').ok_or("a field of a record has no name")?;
        if &field[..equals] == name.as_bytes() {
            return Ok(Some(&field[equals + 1..]));
        }
    }
    Ok(None)
}

/// A field of so many bytes.
fn fixed<const LENGTH: usize>(header: &[u8], name: &str) -> Result<[u8; LENGTH]> {
    let bytes = field(header, name)?.ok_or_else(|| lacks(name))?;
    bytes.try_into().map_err(|_| format!("`{name}` of a record has {} bytes, expected {LENGTH}", bytes.len()))
}

fn kind(header: &[u8]) -> Result<u8> {
    fixed(header, "op").map(|[kind]| kind)
}

fn lacks(name: &str) -> String {
    format!("a record has no `{name}`")
}

fn cut_off() -> String {
    "it ends in the middle of a record".into()
}

fn told(reason: std::io::Error) -> String {
    if reason.kind() == ErrorKind::UnexpectedEof { cut_off() } else { reason.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;
    use std::path::Path;

    fn recording(name: &str) -> Vec<u8> {
        std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/recordings").join(name)).unwrap()
    }

    fn opened(bytes: &[u8]) -> Result<Option<Bag>> {
        let mut file = tempfile::tempfile().unwrap();
        file.write_all(bytes).unwrap();
        Bag::open(file)
    }

    fn messages(bag: &Bag) -> Result<usize> {
        let mut count = 0;
        bag.each(
            |why| why,
            |message| {
                count += usize::from(!message.bytes.is_empty() && message.time_ns > 0);
                Ok(())
            },
        )?;
        Ok(count)
    }

    #[test]
    fn recordings_packed_either_way_have_the_same_messages() {
        let [lz4, bz2] = ["ros1-lz4.bag", "ros1-bz2.bag"].map(|name| opened(&recording(name)).unwrap().unwrap());
        let counts = [&lz4, &bz2].map(|bag| messages(bag).unwrap());
        assert!(counts[0] > 0 && counts[0] == counts[1], "{counts:?}");
        assert_eq!(lz4.connections().unwrap(), bz2.connections().unwrap());
        assert!(!lz4.connections().unwrap().is_empty());
    }

    #[test]
    fn a_file_that_is_cut_off_while_it_is_read_is_told() {
        let bytes = recording("ros1-lz4.bag");
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.bag");
        std::fs::write(&path, &bytes).unwrap();
        let bag = Bag::open(File::open(&path).unwrap()).unwrap().unwrap();
        File::options().write(true).open(&path).unwrap().set_len(bag.chunks + 40).unwrap();
        assert!(messages(&bag).unwrap_err().contains("in the middle of a record"));
        assert!(bag.connections().unwrap_err().contains("in the middle of a record"));
    }

    #[test]
    fn a_chunk_that_says_more_than_such_a_file_unpacks_to_or_less_than_it_does_is_refused() {
        let bytes = recording("ros1-bz2.bag");
        let at = bytes.windows(5).position(|window| window == b"size=").unwrap() + 5;
        for (size, why) in [(u32::MAX, "expected 16777216 at the most"), (7, "does not unpack to the 7 bytes")] {
            let mut spoiled = bytes.clone();
            spoiled[at..at + 4].copy_from_slice(&size.to_le_bytes());
            let said = messages(&opened(&spoiled).unwrap().unwrap()).unwrap_err();
            assert!(said.contains(why), "{said}");
        }
    }
}
