//! Columns of Arrow, read from the memory of whoever made them.

use arrow_array::cast::AsArray;
use arrow_array::ffi_stream::RecordBatchStreamReader;
use arrow_array::types::{
    ArrowPrimitiveType, Float16Type, Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type,
    TimestampMicrosecondType, TimestampMillisecondType, TimestampNanosecondType, TimestampSecondType, UInt8Type,
    UInt16Type, UInt32Type, UInt64Type,
};
use arrow_array::{Array, RecordBatch, RecordBatchReader};
use arrow_pyarrow::PyArrowType;
use arrow_schema::{DataType, TimeUnit};
use omni_gap::log::Table;
use pyo3::prelude::*;

use crate::work::mistake;

/// A number, unless it is NaN.
pub fn there(value: f64) -> Option<f64> {
    (!value.is_nan()).then_some(value)
}

/// Adds the columns of a stream to a table.
pub fn add(table: &mut Table, stream: &Bound<'_, PyAny>) -> PyResult<()> {
    let PyArrowType(reader) = stream.extract::<PyArrowType<RecordBatchStreamReader>>()?;
    let schema = reader.schema();
    let broken = |why| mistake(format!("{}: cannot be read as a table of Arrow: {why}", table.name()));
    let batches: Vec<RecordBatch> = reader.collect::<Result<_, _>>().map_err(broken)?;
    for (at, field) in schema.fields().iter().enumerate() {
        let columns: Vec<&dyn Array> = batches.iter().map(|batch| &**batch.column(at)).collect();
        let numbers: Option<Vec<Numbers<'_>>> = columns.iter().map(|column| numbers(*column)).collect();
        match numbers.filter(|_| is_number(field.data_type())) {
            Some(numbers) => table.add(field.name(), numbers.into_iter().flatten()),
            None => table.add_other(field.name(), &field.data_type().to_string()),
        }
        .map_err(mistake)?;
    }
    Ok(())
}

type Numbers<'a> = Box<dyn Iterator<Item = Option<f64>> + 'a>;

fn is_number(kind: &DataType) -> bool {
    kind.is_integer() || kind.is_floating() || matches!(kind, DataType::Boolean | DataType::Timestamp(..))
}

/// The numbers of a column, a timestamp in seconds since 1970; none where it has no numbers.
fn numbers(column: &dyn Array) -> Option<Numbers<'_>> {
    Some(match column.data_type() {
        DataType::Float64 => each::<Float64Type>(column, there),
        DataType::Float32 => each::<Float32Type>(column, |x| there(f64::from(x))),
        DataType::Float16 => each::<Float16Type>(column, |x| there(x.to_f64())),
        DataType::Int8 => each::<Int8Type>(column, |x| Some(f64::from(x))),
        DataType::Int16 => each::<Int16Type>(column, |x| Some(f64::from(x))),
        DataType::Int32 => each::<Int32Type>(column, |x| Some(f64::from(x))),
        DataType::Int64 => each::<Int64Type>(column, |x| Some(x as f64)),
        DataType::UInt8 => each::<UInt8Type>(column, |x| Some(f64::from(x))),
        DataType::UInt16 => each::<UInt16Type>(column, |x| Some(f64::from(x))),
        DataType::UInt32 => each::<UInt32Type>(column, |x| Some(f64::from(x))),
        DataType::UInt64 => each::<UInt64Type>(column, |x| Some(x as f64)),
        DataType::Boolean => Box::new(column.as_boolean().iter().map(|x| x.map(|x| f64::from(u8::from(x))))),
        DataType::Timestamp(unit, _) => match unit {
            TimeUnit::Second => each::<TimestampSecondType>(column, |x| Some(x as f64)),
            TimeUnit::Millisecond => each::<TimestampMillisecondType>(column, |x| Some(seconds(x, 1_000))),
            TimeUnit::Microsecond => each::<TimestampMicrosecondType>(column, |x| Some(seconds(x, 1_000_000))),
            TimeUnit::Nanosecond => each::<TimestampNanosecondType>(column, |x| Some(seconds(x, 1_000_000_000))),
        },
        _ => return None,
    })
}

fn each<'a, T: ArrowPrimitiveType>(
    column: &'a dyn Array,
    number: impl Fn(T::Native) -> Option<f64> + 'a,
) -> Numbers<'a> {
    Box::new(column.as_primitive::<T>().iter().map(move |x| x.and_then(&number)))
}

/// Whole seconds apart: nanoseconds since 1970 are more than a double holds to the last one.
fn seconds(ticks: i64, in_a_second: i64) -> f64 {
    (ticks / in_a_second) as f64 + (ticks % in_a_second) as f64 / in_a_second as f64
}
