//! The used points of a cloud under one plane as a table, or as a cloud with scalar fields.

use std::path::Path;

use glam::DVec3;

use super::PointRow;
use super::table::{Column, TableError, Value, csv_of, parquet_of};
use crate::geometry::{Cloud, LengthMismatch, Unit};
use crate::method::{PointSteps, Side};
use crate::ply::{self, Precision, WriteError, WriteOptions};

/// A format of the table of points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum PointsFormat {
    /// Comma-separated values with a header.
    Csv,
    /// A Parquet file.
    Parquet,
    /// A point cloud with scalar fields.
    Ply,
}

impl PointsFormat {
    /// Returns the format that the ending of a file's name stands for.
    pub fn of_path(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?.to_ascii_lowercase();
        match ending.as_str() {
            "csv" => Some(Self::Csv),
            "parquet" => Some(Self::Parquet),
            "ply" => Some(Self::Ply),
            _ => None,
        }
    }
}

/// The reason why the points of a plane could not be written. A clause.
#[derive(Debug, thiserror::Error)]
pub enum PointTableError {
    /// There is no row.
    #[error("no point is used")]
    NoPoints,
    /// A table could not be written.
    #[error(transparent)]
    Table(#[from] TableError),
    /// The points are no cloud.
    #[error(transparent)]
    Cloud(#[from] LengthMismatch),
    /// The cloud could not be written.
    #[error(transparent)]
    Ply(#[from] WriteError),
}

/// Writes the rows as a file of the given format. Missing values are empty fields in CSV, nulls in Parquet, and NaN in
/// PLY, which knows nothing else. `unit` is the file's.
///
/// # Errors
/// Returns an error if there is no row, or if a writer fails.
pub fn point_table(rows: &[PointRow], unit: Unit, format: PointsFormat) -> Result<Vec<u8>, PointTableError> {
    let first = rows.first().ok_or(PointTableError::NoPoints)?;
    Ok(match format {
        PointsFormat::Csv => csv_of(&columns(), rows)?,
        PointsFormat::Parquet => parquet_of("points", &columns(), rows, first)?,
        PointsFormat::Ply => cloud_with_scalars(rows, unit)?,
    })
}

/// A column's name, and its value in a row.
type NamedColumn = (&'static str, fn(&PointRow) -> Value);

fn columns() -> Vec<Column<PointRow>> {
    fn count(index: Option<usize>) -> Value {
        Value::Count(index.map(|i| i as u64))
    }
    let mut columns: Vec<Column<PointRow>> = vec![("index".into(), Box::new(|row| count(row.index_in_file)))];
    let mut vector = |names: [&'static str; 3], of: fn(&PointSteps) -> DVec3| {
        for (i, name) in names.into_iter().enumerate() {
            let value = move |row: &PointRow| Value::Number(Some(of(&row.steps)[i]));
            columns.push((name.into(), Box::new(value)));
        }
    };
    vector(["x", "y", "z"], |steps| steps.position);
    vector(["nx", "ny", "nz"], |steps| steps.normal);
    vector(["reflection_x", "reflection_y", "reflection_z"], |steps| {
        steps.reflection
    });
    let rest: [NamedColumn; 7] = [
        ("side", |row| Value::Text(Some(row.steps.side.name().into()))),
        ("plane_distance_cm", |row| {
            Value::Number(Some(row.steps.plane_distance_cm))
        }),
        ("visibility_cm", |row| {
            Value::Number(Some(row.steps.visibility_cm))
        }),
        ("partner_index", |row| count(row.partner_in_file)),
        ("d_cm", |row| {
            Value::Number(row.steps.partner.as_ref().map(|p| p.distance_cm))
        }),
        ("xi_rad", |row| {
            Value::Number(row.steps.partner.as_ref().map(|p| p.angle_rad))
        }),
        ("score_cm", |row| {
            Value::Number(row.steps.partner.as_ref().map(|p| p.score_cm))
        }),
    ];
    for (name, value) in rest {
        columns.push((name.into(), Box::new(value)));
    }
    columns
}

fn cloud_with_scalars(rows: &[PointRow], unit: Unit) -> Result<Vec<u8>, PointTableError> {
    let positions = rows.iter().map(|row| row.steps.position).collect();
    let normals = rows.iter().map(|row| row.steps.normal.as_vec3()).collect();
    let cloud = Cloud::new(positions).with_normals(normals)?;
    let scalar = |value: fn(&PointRow) -> Option<f64>| -> Vec<f32> {
        rows.iter()
            .map(|row| value(row).map_or(f32::NAN, |value| value as f32))
            .collect()
    };
    let side = scalar(|row| Some(f64::from(row.steps.side == Side::Front)));
    let has_partner = scalar(|row| Some(f64::from(row.steps.partner.is_some())));
    let distance_cm = scalar(|row| Some(row.steps.partner.as_ref()?.distance_cm));
    let angle_rad = scalar(|row| Some(row.steps.partner.as_ref()?.angle_rad));
    let score_cm = scalar(|row| Some(row.steps.partner.as_ref()?.score_cm));
    let options = WriteOptions {
        unit: Some(unit),
        precision: Precision::needed_by(&cloud),
        scalars: &[
            ("is_front", &side),
            ("has_partner", &has_partner),
            ("d_cm", &distance_cm),
            ("xi_rad", &angle_rad),
            ("score_cm", &score_cm),
        ],
        ..WriteOptions::default()
    };
    let mut bytes = Vec::new();
    ply::write(&mut bytes, &cloud, &options)?;
    Ok(bytes)
}
