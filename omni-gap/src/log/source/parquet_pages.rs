//! What the pages of a Parquet file say that they unpack to, read before the library makes room for it: a page of some bytes may unpack to
//! gigabytes, and ten of them to millions of rows.
//!
//! Where the library unpacks without asking how much a page was to be (gzip, brotli, frames of lz4), it is unpacked here first, and thrown away.
//! A page's header is a struct in Thrift's compact protocol; fields that matter here: 2 and 3, its size unpacked and packed; the number of
//! its values is field 1 of field 5 (version 1) or 8 (version 2); of the latter the lengths of what is never packed are fields 5 and 6.

use super::longest_part::longest_part;
use flate2::read::MultiGzDecoder;
use lz4_flex::frame::FrameDecoder;
use parquet::basic::Compression;
use parquet::errors::ParquetError;
use parquet::file::metadata::ColumnChunkMetaData;
use parquet::file::reader::ChunkReader;
use std::io::Read;

/// So few rows any column may have, and so many for each byte of the file.
const FEW_ROWS: u64 = 1 << 20;
const ROWS_A_BYTE: u64 = 16;

/// Structs within structs that are followed; headers have two.
const DEEPEST: u8 = 16;

type Result<T> = std::result::Result<T, ParquetError>;

/// What is believed of the pages of a file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bounds {
    page: u64,
    values: u64,
}

impl Bounds {
    /// Of a file that is so long (bytes).
    pub fn of(length: u64) -> Self {
        Self { page: longest_part(length), values: length.saturating_mul(ROWS_A_BYTE).max(FEW_ROWS) }
    }

    /// Refuses a column whose pages say that they are more; hands over how many values they have.
    pub fn check(self, file: &impl ChunkReader, column: &ColumnChunkMetaData) -> Result<u64> {
        let (begins, length) = column.byte_range();
        let mut read = 0;
        let mut values = 0_u64;
        while read < length {
            let mut from = file.get_read(begins + read)?;
            let mut header = Compact { from: &mut from, read: 0 };
            let page = Page::of(&mut header)?;
            read += header.read + page.packed;
            values = values.saturating_add(page.values);
            if page.unpacked > self.page {
                let problem = format!("a page of {} bytes says that it unpacks to {}", page.packed, page.unpacked);
                return Err(ParquetError::General(format!("{problem}, expected {} at the most", self.page)));
            }
            if values > self.values {
                let problem = format!("its pages say that it has {values} rows or more");
                return Err(ParquetError::General(format!("{problem}, expected {} at the most", self.values)));
            }
            if read > length {
                return Err(apart());
            }
            let packed_values = page.packed.saturating_sub(page.levels);
            check_unpacked(column.compression(), &page, &mut file.get_read(begins + read - packed_values)?)?;
        }
        Ok(values)
    }
}

/// Refuses a page that unpacks to more than it says; what cannot be unpacked is told by the library.
fn check_unpacked(codec: Compression, page: &Page, file: &mut impl Read) -> Result<()> {
    let packed = file.take(page.packed.saturating_sub(page.levels));
    let unpacked = page.unpacked.saturating_sub(page.levels);
    let count = |unpack: &mut dyn Read| std::io::copy(&mut unpack.take(unpacked + 1), &mut std::io::sink());
    let count = match codec {
        Compression::GZIP(_) => count(&mut MultiGzDecoder::new(packed)),
        Compression::BROTLI(_) => count(&mut brotli::Decompressor::new(packed, 1 << 12)),
        Compression::LZ4 => count(&mut FrameDecoder::new(packed)),
        _ => return Ok(()),
    };
    if count.is_ok_and(|count| count > unpacked) {
        return Err(ParquetError::General(format!("a page says that it unpacks to {unpacked} bytes, and has more")));
    }
    Ok(())
}

fn apart() -> ParquetError {
    ParquetError::General("its pages do not fit together".into())
}

/// What a page's header says of it.
#[derive(Debug, Default)]
struct Page {
    unpacked: u64,
    packed: u64,
    values: u64,
    /// Bytes before the values that are never packed.
    levels: u64,
}

impl Page {
    fn of(header: &mut Compact<impl Read>) -> Result<Page> {
        let mut page = Page::default();
        let mut last = 0;
        while let Some((id, kind)) = header.field(&mut last)? {
            match (id, kind) {
                (2, Kind::WHOLE) => page.unpacked = header.size()?,
                (3, Kind::WHOLE) => page.packed = header.size()?,
                (5 | 8, Kind::STRUCT) => {
                    let (is_second, mut last) = (id == 8, 0);
                    while let Some((id, kind)) = header.field(&mut last)? {
                        match (id, kind) {
                            (1, Kind::WHOLE) => page.values = header.size()?,
                            (5 | 6, Kind::WHOLE) if is_second => {
                                page.levels = page.levels.saturating_add(header.size()?)
                            }
                            _ => header.skip(kind, DEEPEST)?,
                        }
                    }
                }
                _ => header.skip(kind, DEEPEST)?,
            }
        }
        Ok(page)
    }
}

/// The kinds of values that the protocol has.
struct Kind;

impl Kind {
    const TRUE: u8 = 1;
    const FALSE: u8 = 2;
    const BYTE: u8 = 3;
    const SHORT: u8 = 4;
    const WHOLE: u8 = 5;
    const LONG: u8 = 6;
    const DOUBLE: u8 = 7;
    const BYTES: u8 = 8;
    const LIST: u8 = 9;
    const SET: u8 = 10;
    const STRUCT: u8 = 12;
}

/// Thrift's compact protocol.
struct Compact<R> {
    from: R,
    /// Bytes so far.
    read: u64,
}

impl<R: Read> Compact<R> {
    fn byte(&mut self) -> Result<u8> {
        let mut byte = [0];
        self.from.read_exact(&mut byte)?;
        self.read += 1;
        Ok(byte[0])
    }

    fn number(&mut self) -> Result<u64> {
        let mut number = 0;
        for shift in (0..64).step_by(7) {
            let byte = self.byte()?;
            number |= u64::from(byte & 0x7f) << shift;
            if byte < 0x80 {
                return Ok(number);
            }
        }
        Err(apart())
    }

    /// A whole number with a sign, which has to have none.
    fn size(&mut self) -> Result<u64> {
        let folded = self.number()?;
        if folded & 1 == 0 { Ok(folded >> 1) } else { Err(apart()) }
    }

    /// The next field of a struct, with the kind of its value; none at the struct's end.
    fn field(&mut self, last: &mut u64) -> Result<Option<(u64, u8)>> {
        let byte = self.byte()?;
        if byte == 0 {
            return Ok(None);
        }
        *last = match byte >> 4 {
            0 => self.size()?,
            step => last.saturating_add(u64::from(step)),
        };
        Ok(Some((*last, byte & 0xf)))
    }

    /// Passes over a value.
    fn skip(&mut self, kind: u8, depth: u8) -> Result<()> {
        let depth = depth.checked_sub(1).ok_or_else(apart)?;
        match kind {
            Kind::TRUE | Kind::FALSE => Ok(()),
            Kind::BYTE => self.byte().map(drop),
            Kind::SHORT | Kind::WHOLE | Kind::LONG => self.number().map(drop),
            Kind::DOUBLE => (0..8).try_for_each(|_| self.byte().map(drop)),
            Kind::BYTES => {
                let length = self.number()?;
                (0..length).try_for_each(|_| self.byte().map(drop))
            }
            Kind::LIST | Kind::SET => {
                let head = self.byte()?;
                let count = if head >> 4 == 0xf { self.number()? } else { u64::from(head >> 4) };
                (0..count).try_for_each(|_| match head & 0xf {
                    Kind::TRUE | Kind::FALSE => self.byte().map(drop),
                    kind => self.skip(kind, depth),
                })
            }
            Kind::STRUCT => {
                let mut last = 0;
                while let Some((_, kind)) = self.field(&mut last)? {
                    self.skip(kind, depth)?;
                }
                Ok(())
            }
            _ => Err(apart()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use std::fs::File;
    use std::path::Path;

    #[test]
    fn the_pages_of_files_that_libraries_wrote_have_the_rows_that_they_tell() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/recordings");
        for name in ["table-none.parquet", "table-zstd.parquet", "table-brotli.parquet"] {
            let file = File::open(folder.join(name)).unwrap();
            let reader = SerializedFileReader::new(file.try_clone().unwrap()).unwrap();
            for group in reader.metadata().row_groups() {
                for column in group.columns() {
                    let generous = Bounds { page: 1 << 20, values: group.num_rows() as u64 };
                    assert_eq!(generous.check(&file, column).unwrap(), group.num_rows() as u64, "{name}");
                    let few = Bounds { values: generous.values - 1, ..generous };
                    assert!(few.check(&file, column).unwrap_err().to_string().contains("rows or more"));
                    let small = Bounds { page: 3, ..generous };
                    assert!(small.check(&file, column).unwrap_err().to_string().contains("unpacks to"));
                }
            }
        }
    }

    #[test]
    fn a_page_that_unpacks_to_more_than_it_says_is_refused() {
        let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
        std::io::Write::write_all(&mut packed, &[7; 1000]).unwrap();
        let packed = packed.finish().unwrap();
        let gzip = Compression::GZIP(parquet::basic::GzipLevel::default());
        for (levels, says, is_sound) in [(0, 1000, true), (0, 999, false), (5, 1005, true), (5, 1004, false)] {
            let page = Page { unpacked: says, packed: packed.len() as u64 + levels, values: 1, levels };
            assert_eq!(check_unpacked(gzip, &page, &mut &packed[..]).is_ok(), is_sound, "{page:?}");
            assert!(check_unpacked(Compression::SNAPPY, &page, &mut &packed[..]).is_ok());
        }
    }

    #[test]
    fn a_header_that_goes_on_and_on_ends() {
        for endless in
            [vec![0x1c; 100], vec![0x15, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff], vec![0x1d]]
        {
            let mut header = Compact { from: &endless[..], read: 0 };
            assert!(Page::of(&mut header).is_err(), "{endless:?}");
        }
    }
}
