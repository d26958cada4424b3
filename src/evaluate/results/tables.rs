//! The rows as CSV and as Parquet, with the same columns.

use crate::estimate::Estimator;
use crate::evaluate::table::{Column, TableError, Value, csv_of, parquet_of};
use crate::evaluate::{EstimateInRow, Row};

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
fn columns(rows: &[Row]) -> Vec<Column<Row>> {
    let mut columns: Vec<Column<Row>> = Vec::new();
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
    csv_of(&columns(rows), rows)
}

/// Writes the rows as a Parquet file of one row group, with nulls for missing values.
///
/// # Errors
/// Returns an error if the writer fails.
pub fn parquet(rows: &[Row]) -> Result<Vec<u8>, TableError> {
    parquet_of("clouds", &columns(rows), rows, &Row::failed("", String::new()))
}
