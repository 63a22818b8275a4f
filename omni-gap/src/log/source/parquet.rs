//! # Parquet: columns of numbers, read as they are wanted
//!
//! Any compression that the format knows. A timestamp or a time of day is handed out in seconds (timestamps since 1970),
//! whatever its unit; a decimal with its scale; a truth value as 1 or 0; null as a missing sample. A member of a struct has
//! its path for a name, `pose.x`. Text and lists are columns too, and are refused once they are wanted.

use super::guarded::guarded;
use super::opened::Source;
use super::parquet_pages::Bounds;
use crate::error::{Error, InputKind, Result};
use crate::log::channel::{Channel, Missing};
use bytes::Bytes;
use parquet::basic::{LogicalType, TimeUnit, Type as Physical};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::DataType;
use parquet::errors::ParquetError;
use parquet::file::metadata::{ParquetMetaData, RowGroupMetaData};
use parquet::file::reader::{ChunkReader, FileReader, RowGroupReader, SerializedFileReader};
use parquet::schema::types::ColumnDescriptor;
use std::fs::File;
use std::path::{Path, PathBuf};

/// An opened file, of which only the description was read.
pub(super) struct Parquet {
    path: PathBuf,
    names: Vec<String>,
    file: Described<File>,
}

impl Parquet {
    pub fn open(path: &Path) -> Result<Parquet> {
        let opened = File::open(path).map_err(|reason| Error::unreadable(path, &reason))?;
        let file = Described::of_file(opened).map_err(|reason| broken(path, &reason))?;
        let leaves = file.metadata().file_metadata().schema_descr().columns();
        let names = leaves.iter().map(|leaf| leaf.path().parts().join(".")).collect();
        Ok(Parquet { path: path.into(), names, file })
    }

    fn leaf(&self, column: usize) -> std::sync::Arc<ColumnDescriptor> {
        self.file.metadata().file_metadata().schema_descr().column(column)
    }

    fn column(&self, column: usize) -> Result<Channel> {
        let leaf = self.leaf(column);
        let Some(scale) = Scale::of(&leaf) else {
            let problem = format!("it holds {}, expected numbers", told(&leaf));
            return Err(Error::input(&self.path, problem, "Map another column, or write the file with numbers in it")
                .of_kind(InputKind::Invalid)
                .in_column(self.title(column)));
        };
        let rows = self.file.metadata().file_metadata().num_rows();
        let mut channel = Channel::with_capacity(usize::try_from(rows).unwrap_or(0).min(MOST_ROWS_AHEAD));
        for group in 0..self.file.metadata().num_row_groups() {
            let mut take = |reader: &SerializedFileReader<File>| {
                reader.get_row_group(group).and_then(|group| read(&*group, column, scale, &mut channel))
            };
            let read = self.file.check(group, column).and_then(|()| self.file.within_pages(&mut take));
            read.map_err(|reason| broken(&self.path, &reason).in_column(self.title(column)))?;
        }
        Ok(channel)
    }
}

/// A file by its description, which is not believed before it fits the file.
pub(crate) struct Described<F: ChunkReader + 'static> {
    reader: SerializedFileReader<F>,
    file: F,
    bounds: Bounds,
}

type ParquetResult<T> = std::result::Result<T, ParquetError>;

impl Described<File> {
    /// Reads the description of a file.
    pub fn of_file(file: File) -> ParquetResult<Self> {
        Self::of(file.try_clone()?, file)
    }
}

impl Described<Bytes> {
    /// Reads the description of a file with these bytes.
    pub fn of_bytes(bytes: Bytes) -> ParquetResult<Self> {
        Self::of(bytes.clone(), bytes)
    }
}

impl<F: ChunkReader + 'static> Described<F> {
    /// `again` is the same file as `opened`.
    fn of(opened: F, again: F) -> ParquetResult<Self> {
        let length = again.len();
        let reader = guarded(|| SerializedFileReader::new(opened))
            .unwrap_or_else(|| Err(ParquetError::General("its footer does not fit together".into())))?;
        if !columns_are_within(reader.metadata(), length) {
            return Err(ParquetError::General("its footer tells of columns that are not in it".into()));
        }
        Ok(Self { reader, file: again, bounds: Bounds::of(length) })
    }

    fn metadata(&self) -> &ParquetMetaData {
        self.reader.metadata()
    }

    /// Refuses a column of a group of rows whose pages would take more room than such a file has.
    fn check(&self, group: usize, column: usize) -> ParquetResult<()> {
        self.bounds.check(&self.file, self.metadata().row_group(group).column(column)).map(drop)
    }

    /// Reads all columns, none of whose pages takes more room than such a file has.
    pub fn read<T>(&self, read: impl FnOnce(&SerializedFileReader<F>) -> ParquetResult<T>) -> ParquetResult<T> {
        for group in 0..self.metadata().num_row_groups() {
            (0..self.metadata().row_group(group).num_columns()).try_for_each(|column| self.check(group, column))?;
        }
        self.within_pages(read)
    }

    /// Reads pages: where the library panics on them they do not fit together.
    fn within_pages<T>(&self, read: impl FnOnce(&SerializedFileReader<F>) -> ParquetResult<T>) -> ParquetResult<T> {
        guarded(|| read(&self.reader))
            .unwrap_or_else(|| Err(ParquetError::General("its pages do not fit together".into())))
    }
}

/// True where every column of every group of rows stands within a file so long (bytes): the library does not ask.
fn columns_are_within(description: &ParquetMetaData, length: u64) -> bool {
    description.row_groups().iter().flat_map(RowGroupMetaData::columns).all(|column| {
        let begins = column.dictionary_page_offset().unwrap_or(column.data_page_offset());
        let ends = begins.checked_add(column.compressed_size());
        begins >= 0 && column.compressed_size() >= 0 && ends.is_some_and(|ends| ends as u64 <= length)
    })
}

/// Rows that a file's description is believed of before one was read.
const MOST_ROWS_AHEAD: usize = 1 << 24;

/// Records that are decoded at a time.
const AT_A_TIME: usize = 1 << 14;

impl Source for Parquet {
    fn path(&self) -> &Path {
        &self.path
    }

    fn names(&self) -> &[String] {
        &self.names
    }

    fn columns(&mut self, wanted: &[usize]) -> Result<Vec<Channel>> {
        wanted.iter().map(|column| self.column(*column)).collect()
    }
}

/// How a stored number becomes the one that is meant.
#[derive(Clone, Copy)]
enum Scale {
    Plain,
    /// So many to one: ticks in a second, parts of a decimal.
    Parts(i64),
    /// Whole numbers without a sign.
    Unsigned,
}

impl Scale {
    /// None where the column holds no numbers, or several in a row.
    fn of(leaf: &ColumnDescriptor) -> Option<Scale> {
        let is_number = !matches!(leaf.physical_type(), Physical::BYTE_ARRAY | Physical::FIXED_LEN_BYTE_ARRAY);
        if leaf.max_rep_level() > 0 || !is_number {
            return None;
        }
        Some(match leaf.logical_type_ref() {
            Some(LogicalType::Timestamp(of) | LogicalType::Time(of)) => Scale::Parts(match of.unit {
                TimeUnit::MILLIS => 1_000,
                TimeUnit::MICROS => 1_000_000,
                TimeUnit::NANOS => 1_000_000_000,
            }),
            Some(LogicalType::Decimal(of)) => Scale::Parts(10_i64.checked_pow(u32::try_from(of.scale).ok()?)?),
            Some(LogicalType::Integer(of)) if !of.is_signed => Scale::Unsigned,
            _ => Scale::Plain,
        })
    }

    fn of_whole(self, value: i64) -> f64 {
        match self {
            Scale::Plain => value as f64,
            // whole ones apart: nanoseconds since 1970 are more than a double holds to the last one
            Scale::Parts(parts) => (value / parts) as f64 + (value % parts) as f64 / parts as f64,
            Scale::Unsigned => value as u64 as f64,
        }
    }
}

/// Reads one column of a group of rows.
fn read(
    group: &dyn RowGroupReader,
    column: usize,
    scale: Scale,
    to: &mut Channel,
) -> std::result::Result<(), ParquetError> {
    let whole = group.metadata().column(column).column_descr().max_def_level();
    match group.get_column_reader(column)? {
        ColumnReader::BoolColumnReader(from) => each(from, whole, to, |value| f64::from(u8::from(*value))),
        ColumnReader::Int32ColumnReader(from) => each(from, whole, to, |value| match scale {
            Scale::Unsigned => f64::from(*value as u32),
            _ => scale.of_whole(i64::from(*value)),
        }),
        ColumnReader::Int64ColumnReader(from) => each(from, whole, to, |value| scale.of_whole(*value)),
        // timestamps of older writers
        ColumnReader::Int96ColumnReader(from) => {
            each(from, whole, to, |value| Scale::Parts(1_000_000_000).of_whole(value.to_nanos()))
        }
        ColumnReader::FloatColumnReader(from) => each(from, whole, to, |value| f64::from(*value)),
        ColumnReader::DoubleColumnReader(from) => each(from, whole, to, |value| *value),
        ColumnReader::ByteArrayColumnReader(_) | ColumnReader::FixedLenByteArrayColumnReader(_) => Ok(()),
    }
}

fn each<T: DataType>(
    mut from: ColumnReaderImpl<T>,
    whole: i16,
    to: &mut Channel,
    number: impl Fn(&T::T) -> f64,
) -> std::result::Result<(), ParquetError> {
    let (mut levels, mut values) = (Vec::new(), Vec::new());
    loop {
        levels.clear();
        values.clear();
        let (records, ..) = from.read_records(AT_A_TIME, Some(&mut levels), None, &mut values)?;
        if records == 0 {
            return Ok(());
        }
        if levels.is_empty() {
            values.iter().for_each(|value| to.push(number(value)));
            continue;
        }
        let mut values = values.iter();
        for level in &levels {
            match (*level == whole).then(|| values.next()).flatten() {
                Some(value) => to.push(number(value)),
                None => to.push_missing(Missing::Blank),
            }
        }
    }
}

fn told(leaf: &ColumnDescriptor) -> &'static str {
    match leaf.max_rep_level() {
        0 => "text or bytes",
        _ => "lists",
    }
}

fn broken(path: &Path, reason: &ParquetError) -> Error {
    let problem = format!("cannot be read as Parquet: {reason}");
    Error::input(path, problem, "Write the file again; a writer that was not closed leaves no footer")
        .of_kind(InputKind::Malformed)
}
