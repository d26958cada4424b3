//! Tables as CSV and as Parquet: columns of text, counts and numbers, each with its value in a row.

use std::borrow::Cow;
use std::sync::Arc;

use parquet::basic::{ConvertedType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

use crate::text::spreadsheet_field;

/// The reason why a table could not be written.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    /// The CSV writer failed.
    #[error("the CSV could not be written: {0}")]
    Csv(String),
    /// The Parquet writer failed.
    #[error("the Parquet file could not be written")]
    Parquet(#[from] ParquetError),
}

/// The value of a cell; `None` is an empty field in CSV and a null in Parquet.
pub(super) enum Value {
    Text(Option<String>),
    Count(Option<u64>),
    Number(Option<f64>),
}

/// The name of a column, and its value in a row.
pub(super) type Column<R> = (Cow<'static, str>, Box<dyn Fn(&R) -> Value>);

/// Writes the rows as CSV with a header.
///
/// # Errors
/// Returns an error if the writer fails.
pub(super) fn csv_of<R>(columns: &[Column<R>], rows: &[R]) -> Result<Vec<u8>, TableError> {
    let mut table = csv::Writer::from_writer(Vec::new());
    let write = |table: &mut csv::Writer<Vec<u8>>, fields: Vec<String>| {
        table
            .write_record(fields)
            .map_err(|e| TableError::Csv(e.to_string()))
    };
    write(
        &mut table,
        columns.iter().map(|(name, _)| name.to_string()).collect(),
    )?;
    for row in rows {
        let field = |(_, value): &Column<R>| match value(row) {
            Value::Text(text) => spreadsheet_field(&text.unwrap_or_default()).into_owned(),
            Value::Count(count) => count.map(|c| c.to_string()).unwrap_or_default(),
            Value::Number(number) => number.map(|n| n.to_string()).unwrap_or_default(),
        };
        write(&mut table, columns.iter().map(field).collect())?;
    }
    table.into_inner().map_err(|e| TableError::Csv(e.to_string()))
}

/// Writes the rows as a Parquet file of one row group, with nulls for missing values. `sample` is any row: a
/// column's type is that of its value there.
///
/// # Errors
/// Returns an error if the writer fails.
pub(super) fn parquet_of<R>(
    name: &str,
    columns: &[Column<R>],
    rows: &[R],
    sample: &R,
) -> Result<Vec<u8>, TableError> {
    let field = |(name, value): &Column<R>| {
        let (physical, converted) = match value(sample) {
            Value::Text(_) => (Physical::BYTE_ARRAY, ConvertedType::UTF8),
            Value::Count(_) => (Physical::INT64, ConvertedType::NONE),
            Value::Number(_) => (Physical::DOUBLE, ConvertedType::NONE),
        };
        let built = Type::primitive_type_builder(name, physical)
            .with_repetition(Repetition::OPTIONAL)
            .with_converted_type(converted)
            .build();
        built.map(Arc::new)
    };
    let fields = columns.iter().map(field).collect::<Result<_, _>>()?;
    let schema = Type::group_type_builder(name).with_fields(fields).build()?;
    let properties = WriterProperties::builder()
        .set_created_by(concat!("axiscope ", env!("CARGO_PKG_VERSION")).into())
        .build();
    let mut bytes = Vec::new();
    let mut file = SerializedFileWriter::new(&mut bytes, Arc::new(schema), Arc::new(properties))?;
    let mut group = file.next_row_group()?;
    for (_, value) in columns {
        let Some(mut column) = group.next_column()? else {
            break;
        };
        let (mut texts, mut counts, mut numbers, mut present) = (vec![], vec![], vec![], vec![]);
        for row in rows {
            let some = match value(row) {
                Value::Text(text) => text.map(|t| texts.push(ByteArray::from(t.into_bytes()))),
                // Counts are far below 2^63.
                Value::Count(count) => count.map(|c| counts.push(c.cast_signed())),
                Value::Number(number) => number.map(|n| numbers.push(n)),
            };
            present.push(i16::from(some.is_some()));
        }
        match value(sample) {
            Value::Text(_) => column
                .typed::<ByteArrayType>()
                .write_batch(&texts, Some(&present), None)?,
            Value::Count(_) => column
                .typed::<Int64Type>()
                .write_batch(&counts, Some(&present), None)?,
            Value::Number(_) => column
                .typed::<DoubleType>()
                .write_batch(&numbers, Some(&present), None)?,
        };
        column.close()?;
    }
    group.close()?;
    file.close()?;
    Ok(bytes)
}
