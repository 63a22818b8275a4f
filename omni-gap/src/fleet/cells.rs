//! Rows as Parquet, and back: a column a field.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::sync::Arc;

use parquet::basic::{Compression, ZstdLevel};
use parquet::column::writer::ColumnWriter;
use parquet::data_type::ByteArray;
use parquet::errors::{ParquetError, Result};
use parquet::file::properties::WriterProperties;
use parquet::file::reader::FileReader;
use parquet::file::writer::SerializedFileWriter;
use parquet::record::Field;
use parquet::schema::parser::parse_message_type;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

use crate::log::source::Described;

/// What a column holds; any of them may be missing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cell {
    Text,
    Whole,
    Number,
    Truth,
}

/// A row of a table.
pub(super) trait Row: Serialize + DeserializeOwned {
    /// The table's name.
    const TABLE: &'static str;

    /// Its columns.
    fn columns() -> Vec<(String, Cell)>;

    /// The session that it is of.
    fn session(&self) -> &str;

    /// Its fields as columns; they are the same where no field is a list.
    fn flattened(object: Map<String, Value>) -> Map<String, Value> {
        object
    }

    /// The other way round.
    fn gathered(object: Map<String, Value>) -> Map<String, Value> {
        object
    }
}

/// The bytes of a file with these rows, without the columns of the names `left_out`; the same rows always give the same bytes.
pub(super) fn written<R: Row>(rows: &[R], left_out: &[&str]) -> Result<Vec<u8>> {
    let mut columns = R::columns();
    columns.retain(|(name, _)| !left_out.contains(&name.as_str()));
    let objects: Vec<Map<String, Value>> = rows.iter().map(object).collect::<Result<_>>()?;
    let mut schema = format!("message {} {{ ", R::TABLE);
    for (name, cell) in &columns {
        let _ = match cell {
            Cell::Text => write!(schema, "optional binary {name} (STRING); "),
            Cell::Whole => write!(schema, "optional int64 {name}; "),
            Cell::Number => write!(schema, "optional double {name}; "),
            Cell::Truth => write!(schema, "optional boolean {name}; "),
        };
    }
    let schema = Arc::new(parse_message_type(&(schema + "}"))?);
    let compression = Compression::ZSTD(ZstdLevel::default());
    let properties = Arc::new(WriterProperties::builder().set_compression(compression).build());
    let mut out = SerializedFileWriter::new(Vec::new(), schema, properties)?;
    let mut group = out.next_row_group()?;
    for (name, _) in &columns {
        let Some(mut writer) = group.next_column()? else { break };
        let values: Vec<&Value> = objects.iter().map(|object| object.get(name).unwrap_or(&Value::Null)).collect();
        put(writer.untyped(), &values)?;
        writer.close()?;
    }
    group.close()?;
    out.into_inner()
}

fn object<R: Row>(row: &R) -> Result<Map<String, Value>> {
    match serde_json::to_value(row) {
        Ok(Value::Object(object)) => Ok(R::flattened(object)),
        Ok(_) => Err(ParquetError::General("a row is no object".into())),
        Err(why) => Err(ParquetError::General(why.to_string())),
    }
}

fn put(writer: &mut ColumnWriter<'_>, values: &[&Value]) -> Result<()> {
    let levels: Vec<i16> = values.iter().map(|value| i16::from(!value.is_null())).collect();
    let there = values.iter().filter(|value| !value.is_null());
    let levels = Some(&levels[..]);
    match writer {
        ColumnWriter::ByteArrayColumnWriter(text) => {
            let texts: Vec<ByteArray> = there.map(|value| value.as_str().unwrap_or_default().into()).collect();
            text.write_batch(&texts, levels, None)
        }
        ColumnWriter::Int64ColumnWriter(whole) => {
            let wholes: Vec<i64> = there.map(|value| value.as_i64().unwrap_or_default()).collect();
            whole.write_batch(&wholes, levels, None)
        }
        ColumnWriter::DoubleColumnWriter(number) => {
            let numbers: Vec<f64> = there.map(|value| value.as_f64().unwrap_or(f64::NAN)).collect();
            number.write_batch(&numbers, levels, None)
        }
        ColumnWriter::BoolColumnWriter(truth) => {
            let truths: Vec<bool> = there.map(|value| value.as_bool().unwrap_or_default()).collect();
            truth.write_batch(&truths, levels, None)
        }
        _ => Err(ParquetError::General("a column is of no known sort".into())),
    }
    .map(|_| ())
}

/// The rows of a file with these bytes; `known` is what columns hold that were left out.
pub(super) fn read<R: Row>(bytes: Vec<u8>, known: &[(&str, String)]) -> Result<Vec<R>> {
    let file = Described::of_bytes(bytes.into())?;
    let row = |row: parquet::record::Row| {
        let cells: BTreeMap<&String, &Field> = row.get_column_iter().collect();
        let known = known.iter().map(|(name, text)| ((*name).to_owned(), text.as_str().into()));
        let object = known.chain(cells.into_iter().map(|(name, field)| (name.clone(), value(field)))).collect();
        let of = serde_json::from_value(Value::Object(R::gathered(object)));
        of.map_err(|why| ParquetError::General(format!("a row is not of this form: {why}")))
    };
    file.read(|reader| reader.get_row_iter(None)?.map(|read| read.and_then(row)).collect())
}

fn value(field: &Field) -> Value {
    match field {
        Field::Str(text) => text.clone().into(),
        Field::Long(whole) => (*whole).into(),
        Field::Double(number) => (*number).into(),
        Field::Bool(truth) => (*truth).into(),
        _ => Value::Null,
    }
}
