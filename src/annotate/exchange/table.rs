//! Annotations as CSV: one row per annotator and cloud.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::annotate::{Annotation, Confidence, Ends, Judgment, Method, Role};
use crate::geometry::Unit;
use crate::text::{from_spreadsheet_field, spreadsheet_field};

/// The reason why a table cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    /// The text is not CSV, a column is missing, or a field has another type.
    #[error("{0}")]
    Csv(#[from] csv::Error),
    /// A row cannot be used.
    #[error("row {row}: {reason}")]
    Row {
        /// The row's number, from 1 after the header.
        row: usize,
        /// The reason, as the end of a sentence.
        reason: String,
    },
}

/// The fields of a row. Only the columns of the file, the annotator and the ends are required.
#[derive(Debug, Default, Serialize, Deserialize)]
struct Fields {
    file: String,
    #[serde(default)]
    sha256: Option<String>,
    annotator: String,
    #[serde(default)]
    role: Option<Role>,
    peduncle_base_x: Option<f64>,
    peduncle_base_y: Option<f64>,
    peduncle_base_z: Option<f64>,
    blossom_end_x: Option<f64>,
    blossom_end_y: Option<f64>,
    blossom_end_z: Option<f64>,
    #[serde(default)]
    unit: Option<Unit>,
    #[serde(default)]
    cannot_tell: Option<bool>,
    #[serde(default)]
    method: Option<Method>,
    #[serde(default)]
    confidence: Option<f64>,
    #[serde(default)]
    note: Option<String>,
    #[serde(default)]
    blind: Option<bool>,
    #[serde(default)]
    created: Option<String>,
    #[serde(default)]
    modified: Option<String>,
}

/// A row of a table. The caller finds its cloud.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportedRow {
    /// The cloud's file within the folder.
    pub file: String,
    /// The hash of the cloud that the axis was set for, if the table has it.
    pub sha256: Option<String>,
    /// The annotator's name.
    pub annotator: String,
    /// The annotator's role; [`Role::Annotator`] by default.
    pub role: Role,
    /// The unit of the ends; by default the cloud's.
    pub unit: Option<Unit>,
    /// The judgment; its method is [`Method::Imported`] by default.
    pub judgment: Judgment,
}

impl ImportedRow {
    /// Returns the judgment with its ends in the cloud's unit.
    ///
    /// # Errors
    /// Returns an error if the converted ends are not an axis.
    pub fn in_unit(&self, unit: Unit) -> Result<Judgment, crate::annotate::EndsError> {
        let mut judgment = self.judgment.clone();
        if let (Some(ends), Some(own)) = (judgment.ends, self.unit)
            && own != unit
        {
            let scale = own.in_cm() / unit.in_cm();
            judgment.ends = Some(Ends::new(
                ends.peduncle_base() * scale,
                ends.blossom_end() * scale,
            )?);
        }
        Ok(judgment)
    }
}

/// Formats annotations as CSV with a header; each comes with the name of its cloud's file.
///
/// # Errors
/// Returns an error if CSV cannot be written to memory.
pub fn write_table<'a>(
    annotations: impl IntoIterator<Item = (&'a str, &'a Annotation)>,
) -> Result<Vec<u8>, TableError> {
    let mut table = csv::Writer::from_writer(Vec::new());
    for (file, annotation) in annotations {
        let ends = annotation.ends();
        let base = ends.map(Ends::peduncle_base);
        let blossom = ends.map(Ends::blossom_end);
        let judgment = &annotation.judgment;
        table.serialize(Fields {
            file: spreadsheet_field(file).into(),
            sha256: Some(annotation.cloud.sha256.clone()),
            annotator: spreadsheet_field(&annotation.annotator).into(),
            role: Some(annotation.role),
            peduncle_base_x: base.map(|p| p.x),
            peduncle_base_y: base.map(|p| p.y),
            peduncle_base_z: base.map(|p| p.z),
            blossom_end_x: blossom.map(|p| p.x),
            blossom_end_y: blossom.map(|p| p.y),
            blossom_end_z: blossom.map(|p| p.z),
            unit: Some(annotation.unit),
            cannot_tell: Some(ends.is_none()),
            method: Some(judgment.method),
            confidence: judgment.confidence.map(Confidence::value),
            note: Some(spreadsheet_field(&judgment.note).into()),
            blind: Some(judgment.blind),
            created: Some(annotation.created.clone()),
            modified: Some(annotation.modified.clone()),
        })?;
    }
    table
        .into_inner()
        .map_err(|error| TableError::Csv(error.into_error().into()))
}

/// Reads a table: the columns `file`, `annotator`, `peduncle_base_x` … `blossom_end_z`, and as many of
/// the others that [`write_table`] writes as there are.
///
/// # Errors
/// Returns an error if the text is not such a table, or if a row neither has an axis nor says that it cannot be told.
pub fn read_table(bytes: &[u8]) -> Result<Vec<ImportedRow>, TableError> {
    // Spreadsheets begin their files with a byte-order mark.
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(bytes);
    let mut rows = Vec::new();
    for (i, fields) in reader.deserialize::<Fields>().enumerate() {
        let row = i + 1;
        rows.push(imported(fields?).map_err(|reason| TableError::Row { row, reason })?);
    }
    Ok(rows)
}

fn imported(fields: Fields) -> Result<ImportedRow, String> {
    let point = |x: Option<f64>, y: Option<f64>, z: Option<f64>| Some(DVec3::new(x?, y?, z?));
    let base = point(
        fields.peduncle_base_x,
        fields.peduncle_base_y,
        fields.peduncle_base_z,
    );
    let blossom = point(fields.blossom_end_x, fields.blossom_end_y, fields.blossom_end_z);
    let ends = match (base, blossom, fields.cannot_tell.unwrap_or(false)) {
        (Some(base), Some(blossom), false) => {
            Some(Ends::new(base, blossom).map_err(|error| error.to_string())?)
        }
        (None, None, true) => None,
        (_, _, true) => return Err("it has an end, and says that none can be told".into()),
        (_, _, false) => return Err("an end is missing, and it does not say that none can be told".into()),
    };
    let confidence = match fields.confidence {
        None => None,
        Some(value) => Some(Confidence::new(value).ok_or("its confidence is not from 0 to 1")?),
    };
    Ok(ImportedRow {
        file: from_spreadsheet_field(&fields.file).into(),
        sha256: fields.sha256.filter(|hash| !hash.is_empty()),
        annotator: from_spreadsheet_field(&fields.annotator).into(),
        role: fields.role.unwrap_or(Role::Annotator),
        unit: fields.unit,
        judgment: Judgment {
            ends,
            method: fields.method.unwrap_or(Method::Imported),
            confidence,
            note: from_spreadsheet_field(&fields.note.unwrap_or_default()).into(),
            blind: fields.blind.unwrap_or(false),
        },
    })
}
