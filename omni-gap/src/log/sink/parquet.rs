//! A run as Parquet: a column each, holes as nulls.

use std::fmt::Write;
use std::sync::Arc;

use parquet::basic::{Compression, ZstdLevel};
use parquet::data_type::DoubleType;
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;

use crate::log::channel::Channel;
use crate::log::run::Run;

/// The bytes of a file with this run.
pub(super) fn bytes(run: &Run) -> Result<Vec<u8>, String> {
    written(run).map_err(|why| why.to_string())
}

fn written(run: &Run) -> Result<Vec<u8>, ParquetError> {
    let signals = run.signals();
    let mut schema = "message run { required double t_s; ".to_owned();
    for (name, _) in &signals {
        let _ = write!(schema, "optional double {name}; ");
    }
    let schema = Arc::new(parse_message_type(&(schema + "}"))?);
    let compression = Compression::ZSTD(ZstdLevel::default());
    let properties = Arc::new(WriterProperties::builder().set_compression(compression).build());
    let mut out = SerializedFileWriter::new(Vec::new(), schema, properties)?;
    let mut rows = out.next_row_group()?;
    let mut columns =
        std::iter::once((run.t_s.clone(), None)).chain(signals.iter().map(|(_, channel)| column(run, channel)));
    while let (Some(mut writer), Some((values, levels))) = (rows.next_column()?, columns.next()) {
        writer.typed::<DoubleType>().write_batch(&values, levels.as_deref(), None)?;
        writer.close()?;
    }
    rows.close()?;
    out.into_inner()
}

/// The numbers that are there, and for each row whether there is one.
fn column(run: &Run, channel: &Channel) -> (Vec<f64>, Option<Vec<i16>>) {
    let rows: Vec<Option<f64>> = (0..run.rows()).map(|row| channel.get(row).ok()).collect();
    let levels = rows.iter().map(|value| i16::from(value.is_some())).collect();
    (rows.into_iter().flatten().collect(), Some(levels))
}
