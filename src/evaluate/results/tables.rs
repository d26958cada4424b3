//! The rows as CSV and as Parquet, with the same columns.

use std::borrow::Cow;
use std::sync::Arc;

use parquet::basic::{ConvertedType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

use crate::estimate::Estimator;
use crate::evaluate::{EstimateInRow, Row};
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
enum Value {
    Text(Option<String>),
    Count(Option<u64>),
    Number(Option<f64>),
}

/// The name of a column, and its value in a row.
type Column = (Cow<'static, str>, Box<dyn Fn(&Row) -> Value>);

macro_rules! components {
    ($field:ident, $index:literal) => {
        |row| Value::Number(row.$field.map(|v| v[$index]))
    };
}

/// A column of the parts of the error.
macro_rules! parts {
    ($kind:ident, |$parts:ident| $value:expr) => {
        |row| Value::$kind(row.error_parts.as_ref().and_then(|$parts| $value))
    };
}

/// A column's name, and its value in a row.
type NamedColumn = (&'static str, fn(&Row) -> Value);

/// The columns that every table has, in order.
const COLUMNS: [NamedColumn; 45] = [
    ("file", |row| Value::Text(Some(row.file.clone()))),
    ("sha256", |row| Value::Text(row.sha256.clone())),
    ("points", |row| Value::Count(row.points)),
    ("used_points", |row| Value::Count(row.used_points)),
    ("unit", |row| Value::Text(row.unit.map(|u| u.symbol().into()))),
    ("center_x", components!(center, 0)),
    ("center_y", components!(center, 1)),
    ("center_z", components!(center, 2)),
    ("g", |row| Value::Count(row.best.map(|b| b[0]))),
    ("h", |row| Value::Count(row.best.map(|b| b[1]))),
    ("score_cm", |row| Value::Number(row.score_cm)),
    ("runner_up_score_cm", |row| Value::Number(row.runner_up_score_cm)),
    ("lead", |row| Value::Number(row.lead)),
    ("partner_fraction", |row| Value::Number(row.partner_fraction)),
    ("axis_x", components!(axis, 0)),
    ("axis_y", components!(axis, 1)),
    ("axis_z", components!(axis, 2)),
    ("truth", |row| Value::Text(row.truth.clone())),
    ("truth_x", components!(truth_axis, 0)),
    ("truth_y", components!(truth_axis, 1)),
    ("truth_z", components!(truth_axis, 2)),
    ("error_deg", |row| Value::Number(row.error_deg)),
    ("peduncle_error_deg", |row| Value::Number(row.peduncle_error_deg)),
    ("peduncle_direction_error_deg", |row| {
        Value::Number(row.peduncle_direction_error_deg)
    }),
    ("peduncle_disagreement_deg", |row| {
        Value::Number(row.peduncle_disagreement_deg)
    }),
    ("true_axis_error_deg", |row| {
        Value::Number(row.true_axis_error_deg)
    }),
    ("measured", |row| {
        Value::Count(Some(u64::from(row.error_deg.is_some())))
    }),
    ("failed", |row| {
        Value::Count(Some(u64::from(row.failure.is_some())))
    }),
    ("warnings", |row| Value::Text(Some(row.warnings.clone()))),
    ("failure", |row| Value::Text(row.failure.clone())),
    ("manual_error_deg", |row| Value::Number(row.manual_error_deg)),
    ("annotators", |row| Value::Text(Some(row.annotators.clone()))),
    ("tags", |row| Value::Text(Some(row.tags.clone()))),
    ("note", |row| Value::Text(Some(row.note.clone()))),
    ("coverage", |row| Value::Number(row.coverage)),
    ("lean_deg", parts!(Number, |parts| Some(parts.lean_deg))),
    ("lean_part_deg", parts!(Number, |parts| Some(parts.lean_part_deg))),
    ("grid_part_deg", parts!(Number, |parts| Some(parts.grid_part_deg))),
    ("choice_part_deg", parts!(Number, |parts| parts.choice_part_deg)),
    (
        "nearest_candidate_g",
        parts!(Count, |parts| Some(parts.nearest_candidate.g)),
    ),
    (
        "nearest_candidate_h",
        parts!(Count, |parts| Some(parts.nearest_candidate.h)),
    ),
    (
        "nearest_candidate_rank",
        parts!(Count, |parts| parts.nearest_candidate.rank),
    ),
    (
        "nearest_candidate_error_deg",
        parts!(Number, |parts| Some(parts.nearest_candidate.error_deg)),
    ),
    (
        "center_distance_cm",
        parts!(Number, |parts| Some(parts.true_center.as_ref()?.distance_cm)),
    ),
    (
        "error_true_center_deg",
        parts!(Number, |parts| parts.true_center.as_ref()?.error_deg),
    ),
];

/// Returns all columns in order: after those of every table, the ones of the estimators that were asked for.
fn columns(rows: &[Row]) -> Vec<Column> {
    let mut columns: Vec<Column> = Vec::new();
    for (name, value) in COLUMNS {
        columns.push((name.into(), Box::new(value)));
    }
    let asked = |estimator: &&Estimator| rows.iter().any(|row| row.estimate(**estimator).is_some());
    for &estimator in Estimator::ALL.iter().filter(asked) {
        let mut add = |what: &str, value: fn(&EstimateInRow) -> Value, missing: fn() -> Value| {
            let of = move |row: &Row| row.estimate(estimator).map_or_else(missing, value);
            columns.push((format!("{}_{what}", estimator.name()).into(), Box::new(of)));
        };
        add(
            "error_deg",
            |e| Value::Number(e.error_deg),
            || Value::Number(None),
        );
        if estimator != Estimator::Paper {
            add(
                "confidence",
                |e| Value::Number(e.confidence),
                || Value::Number(None),
            );
            add(
                "ambiguous",
                |e| Value::Count(Some(e.ambiguous.into())),
                || Value::Count(None),
            );
        }
        if estimator == Estimator::Body {
            add(
                "seen_share",
                |e| Value::Number(e.seen_share),
                || Value::Number(None),
            );
            let class = |e: &EstimateInRow| Value::Text(e.occlusion.map(|o| o.name().into()));
            add("occlusion", class, || Value::Text(None));
            let priority =
                |row: &Row| Value::Count(row.estimate(Estimator::Body).map(EstimateInRow::priority));
            columns.push(("priority".into(), Box::new(priority)));
        }
    }
    columns
}

/// Writes the rows as CSV with a header.
///
/// # Errors
/// Returns an error if the writer fails.
pub fn csv(rows: &[Row]) -> Result<Vec<u8>, TableError> {
    let columns = columns(rows);
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
        let field = |(_, value): &Column| match value(row) {
            Value::Text(text) => spreadsheet_field(&text.unwrap_or_default()).into_owned(),
            Value::Count(count) => count.map(|c| c.to_string()).unwrap_or_default(),
            Value::Number(number) => number.map(|n| n.to_string()).unwrap_or_default(),
        };
        write(&mut table, columns.iter().map(field).collect())?;
    }
    table.into_inner().map_err(|e| TableError::Csv(e.to_string()))
}

/// Writes the rows as a Parquet file of one row group, with nulls for missing values.
///
/// # Errors
/// Returns an error if the writer fails.
pub fn parquet(rows: &[Row]) -> Result<Vec<u8>, TableError> {
    let columns = columns(rows);
    let sample = Row::failed("", String::new());
    let field = |(name, value): &Column| {
        let (physical, converted) = match value(&sample) {
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
    let schema = Type::group_type_builder("clouds").with_fields(fields).build()?;
    let properties = WriterProperties::builder()
        .set_created_by(concat!("axiscope ", env!("CARGO_PKG_VERSION")).into())
        .build();
    let mut bytes = Vec::new();
    let mut file = SerializedFileWriter::new(&mut bytes, Arc::new(schema), Arc::new(properties))?;
    let mut group = file.next_row_group()?;
    for (_, value) in &columns {
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
        match value(&sample) {
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
