//! Recordings that are bombs, byte by byte: libraries write what is sound, and small inputs that unpack to much are not theirs to make.

/// Bytes of a block of zstd at the most.
const ZSTD_BLOCK: usize = 1 << 17;

/// Bytes of a block of lz4 at the most.
const LZ4_BLOCK: usize = 1 << 22;

/// A frame of zstd: these bytes, then so many blocks of zeros. Format: RFC 8878.
pub fn zstd(head: &[u8], blocks: usize) -> Vec<u8> {
    let block = |last: bool, kind: u32, size: usize| (u32::from(last) | kind << 1 | (size as u32) << 3).to_le_bytes();
    // a window of 8 MB, no size
    let mut frame = vec![0x28, 0xb5, 0x2f, 0xfd, 0x00, 0x68];
    frame.extend_from_slice(&block(false, 0, head.len())[..3]);
    frame.extend_from_slice(head);
    for k in 0..blocks {
        frame.extend_from_slice(&block(k + 1 == blocks, 1, ZSTD_BLOCK)[..3]);
        frame.push(0);
    }
    frame
}

/// Bytes that [`zstd`] unpacks to.
pub fn zstd_unpacks_to(head: &[u8], blocks: usize) -> u64 {
    (head.len() + blocks * ZSTD_BLOCK) as u64
}

/// A frame of lz4: these bytes as a block of their own, then so many blocks of zeros.
pub fn lz4(head: &[u8], blocks: usize) -> Vec<u8> {
    // blocks of 4 MB that stand alone, no checksums but the header's
    let mut frame = vec![0x04, 0x22, 0x4d, 0x18, 0x60, 0x70, 0x73];
    // the highest bit: a block that is not packed
    frame.extend_from_slice(&(head.len() as u32 | 1 << 31).to_le_bytes());
    frame.extend_from_slice(head);
    // one zero, a match with it up to the last five bytes, and those
    let matched = LZ4_BLOCK - 1 - 5 - 4 - 15;
    let mut zeros = vec![0x1f, 0, 1, 0];
    zeros.extend(std::iter::repeat_n(0xff, matched / 0xff));
    zeros.push((matched % 0xff) as u8);
    zeros.extend_from_slice(&[0x50, 0, 0, 0, 0, 0]);
    for _ in 0..blocks {
        frame.extend_from_slice(&(zeros.len() as u32).to_le_bytes());
        frame.extend_from_slice(&zeros);
    }
    frame.extend_from_slice(&[0; 4]);
    frame
}

/// Bytes that [`lz4`] unpacks to.
pub fn lz4_unpacks_to(head: &[u8], blocks: usize) -> u64 {
    (head.len() + blocks * LZ4_BLOCK) as u64
}

/// A gzip: these bytes, then so many times 258 zeros. Format: RFC 1951 and 1952.
pub fn gzip(head: &[u8], times: usize) -> Vec<u8> {
    let mut packed = vec![0x1f, 0x8b, 8, 0, 0, 0, 0, 0, 0, 0xff];
    // as it is
    packed.push(0);
    let length = (head.len() as u16).to_le_bytes();
    packed.extend_from_slice(&[length[0], length[1], !length[0], !length[1]]);
    packed.extend_from_slice(head);
    // by the fixed codes: the last block, a zero, matches of 258 at distance 1, the end
    let mut bits = Bits { bytes: packed, filled: 0 };
    bits.put(&[1, 1, 0]);
    bits.put(&[0, 0, 1, 1, 0, 0, 0, 0]);
    for _ in 0..times {
        bits.put(&[1, 1, 0, 0, 0, 1, 0, 1]);
        bits.put(&[0; 5]);
    }
    bits.put(&[0; 7]);
    // checksum and length, which nobody comes to
    bits.bytes.extend_from_slice(&[0; 8]);
    bits.bytes
}

/// Bits in the order in which deflate packs them.
struct Bits {
    bytes: Vec<u8>,
    filled: u8,
}

impl Bits {
    fn put(&mut self, bits: &[u8]) {
        for bit in bits {
            if self.filled == 0 {
                self.bytes.push(0);
            }
            if let Some(last) = self.bytes.last_mut() {
                *last |= bit << self.filled;
            }
            self.filled = (self.filled + 1) % 8;
        }
    }
}

/// An MCAP file with one chunk, which says how it is packed and what it unpacks to. Format: <https://mcap.dev/spec>.
pub fn mcap(compression: &str, unpacks_to: u64, packed: &[u8]) -> Vec<u8> {
    let text = |text: &str| [&(text.len() as u32).to_le_bytes()[..], text.as_bytes()].concat();
    let record = |code: u8, body: &[u8]| [&[code][..], &(body.len() as u64).to_le_bytes(), body].concat();
    let chunk = [
        &[0; 16][..],
        &unpacks_to.to_le_bytes(),
        &[0; 4],
        &text(compression),
        &(packed.len() as u64).to_le_bytes(),
        packed,
    ]
    .concat();
    [MCAP_MAGIC, &record(1, &[text(""), text("")].concat()), &record(6, &chunk)].concat()
}

const MCAP_MAGIC: &[u8] = b"\x89MCAP0\r\n";

/// What stands before the data of a message in MCAP that is so long: the channel that it is of, and its own head.
pub fn mcap_message_head(data: u64) -> Vec<u8> {
    let channel = [&[1, 0, 0, 0][..], &2_u32.to_le_bytes(), b"/a", &4_u32.to_le_bytes(), b"json", &[0; 4]].concat();
    let head = [&[4][..], &(channel.len() as u64).to_le_bytes(), &channel, &[5], &(data + 22).to_le_bytes()];
    [&head.concat()[..], &[1, 0], &[0; 20]].concat()
}

/// A ROS 1 bag with one chunk, which says how it is packed and what it unpacks to. Format: <https://wiki.ros.org/Bags/Format/2.0>.
pub fn bag(compression: &str, unpacks_to: u32, packed: &[u8]) -> Vec<u8> {
    const MAGIC: &[u8] = b"#ROSBAG V2.0\n";
    let fields = |index: u64| [bag_field("op", &[3]), bag_field("index_pos", &index.to_le_bytes())].concat();
    let chunk = [
        bag_field("op", &[5]),
        bag_field("compression", compression.as_bytes()),
        bag_field("size", &unpacks_to.to_le_bytes()),
    ]
    .concat();
    let chunk = [with_length(&chunk), with_length(packed)].concat();
    let begins = MAGIC.len() + with_length(&fields(0)).len() + 4;
    let head = with_length(&fields((begins + chunk.len()) as u64));
    [MAGIC, &head, &[0; 4], &chunk].concat()
}

/// What stands before the data of a message in a bag that is so long.
pub fn bag_message_head(data: u32) -> Vec<u8> {
    let fields = [bag_field("op", &[2]), bag_field("conn", &[0; 4]), bag_field("time", &[1; 8])].concat();
    [&with_length(&fields)[..], &data.to_le_bytes()].concat()
}

fn bag_field(name: &str, value: &[u8]) -> Vec<u8> {
    with_length(&[name.as_bytes(), b"=", value].concat())
}

fn with_length(bytes: &[u8]) -> Vec<u8> {
    [&(bytes.len() as u32).to_le_bytes()[..], bytes].concat()
}

/// How pages of Parquet are packed.
#[derive(Clone, Copy, Debug)]
pub enum Codec {
    /// Not at all.
    Plain,
    /// By gzip.
    Gzip,
    /// By zstd.
    Zstd,
}

/// A page of numbers.
#[derive(Clone, Debug)]
pub struct Page {
    /// Its bytes as they stand in the file.
    pub bytes: Vec<u8>,
    /// What it says that they unpack to.
    pub unpacks_to: u64,
    /// How many numbers it says that it has.
    pub values: u64,
    /// Whether it is a dictionary; whether its numbers are those of one.
    pub dictionary: [bool; 2],
}

/// A table in Parquet whose columns, of double numbers, are all one and the same pages.
pub fn parquet(names: &[&str], codec: Codec, pages: &[Page]) -> Vec<u8> {
    let mut file = b"PAR1".to_vec();
    let begins = file.len() as i64;
    let mut first_data = begins;
    for page in pages {
        let [is_dictionary, by_dictionary] = page.dictionary;
        let mut of_values = Struct::default();
        of_values.whole(1, page.values as i64).whole(2, if by_dictionary { 8 } else { 0 });
        let mut header = Struct::default();
        header.whole(1, if is_dictionary { 2 } else { 0 });
        header.whole(2, page.unpacks_to as i64).whole(3, page.bytes.len() as i64);
        if is_dictionary {
            header.nested(7, of_values);
        } else {
            of_values.whole(3, 3).whole(4, 3);
            header.nested(5, of_values);
        }
        file.extend(header.end());
        file.extend_from_slice(&page.bytes);
        if is_dictionary {
            first_data = file.len() as i64;
        }
    }
    let values = pages.iter().filter(|page| !page.dictionary[0]).map(|page| page.values as i64).sum();
    let length = file.len() as i64 - begins;
    let column = |name: &&str| {
        let code = match codec {
            Codec::Plain => 0,
            Codec::Gzip => 2,
            Codec::Zstd => 6,
        };
        let mut about = Struct::default();
        about.whole(1, 5).list(2, WHOLE, [zigzag(0)]).list(3, BYTES, [bytes(name)]).whole(4, code);
        about.long(5, values).long(6, length).long(7, length).long(9, first_data);
        if first_data > begins {
            about.long(11, begins);
        }
        let mut column = Struct::default();
        column.long(2, begins).nested(3, about);
        column.end()
    };
    let mut group = Struct::default();
    group.list(1, STRUCT, names.iter().map(column)).long(2, length).long(3, values);
    let mut root = Struct::default();
    root.field(4, BYTES, &bytes("table")).whole(5, names.len() as i64);
    let leaf = |name: &&str| {
        let mut leaf = Struct::default();
        leaf.whole(1, 5).whole(3, 0).field(4, BYTES, &bytes(name));
        leaf.end()
    };
    let mut footer = Struct::default();
    footer.whole(1, 1).list(2, STRUCT, [root.end()].into_iter().chain(names.iter().map(leaf)));
    footer.long(3, values).list(4, STRUCT, [group.end()]);
    let footer = footer.end();
    file.extend_from_slice(&footer);
    file.extend_from_slice(&(footer.len() as u32).to_le_bytes());
    file.extend_from_slice(b"PAR1");
    file
}

/// Kinds of values in Thrift's compact protocol.
const WHOLE: u8 = 5;
const LONG: u8 = 6;
const BYTES: u8 = 8;
const LIST: u8 = 9;
const STRUCT: u8 = 12;

/// A struct in Thrift's compact protocol.
#[derive(Default)]
struct Struct {
    bytes: Vec<u8>,
    last: u8,
}

impl Struct {
    fn field(&mut self, id: u8, kind: u8, value: &[u8]) -> &mut Self {
        self.bytes.push((id - self.last) << 4 | kind);
        self.last = id;
        self.bytes.extend_from_slice(value);
        self
    }

    fn whole(&mut self, id: u8, value: i64) -> &mut Self {
        self.field(id, WHOLE, &zigzag(value))
    }

    fn long(&mut self, id: u8, value: i64) -> &mut Self {
        self.field(id, LONG, &zigzag(value))
    }

    fn nested(&mut self, id: u8, value: Struct) -> &mut Self {
        self.field(id, STRUCT, &value.end())
    }

    fn list(&mut self, id: u8, kind: u8, values: impl IntoIterator<Item = Vec<u8>>) -> &mut Self {
        let values: Vec<Vec<u8>> = values.into_iter().collect();
        self.field(id, LIST, &[&[(values.len() as u8) << 4 | kind][..], &values.concat()].concat())
    }

    fn end(mut self) -> Vec<u8> {
        self.bytes.push(0);
        self.bytes
    }
}

fn number(mut value: u64) -> Vec<u8> {
    let mut bytes = Vec::new();
    while value >= 0x80 {
        bytes.push(value as u8 | 0x80);
        value >>= 7;
    }
    bytes.push(value as u8);
    bytes
}

fn zigzag(value: i64) -> Vec<u8> {
    number((value << 1 ^ value >> 63) as u64)
}

fn bytes(text: &str) -> Vec<u8> {
    [&number(text.len() as u64)[..], text.as_bytes()].concat()
}
