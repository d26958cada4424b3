//! The format of an axis file, `axiscope.axis/1` (assets/axis.schema.json), read strictly: a file that
//! is understood in part would lose the rest when it is written again.

use glam::DVec3;
use jiff::Timestamp;
use serde::{Deserialize, Serialize};

use super::{Annotation, CloudId, Confidence, Ends, EndsError, Judgment, Method, Role};
use crate::geometry::{Unit, angle_between_directions_rad};
use crate::text::one_line;

/// The name of the format, without its version.
const FORMAT: &str = "axiscope.axis/";
/// The version that is written, and the newest that is read.
const VERSION: u32 = 1;
/// The longest file that is read. Ours have a thousand bytes, a long note aside.
pub const LONGEST_FILE: u64 = 1 << 20;

/// The reason why an axis file cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum FileError {
    /// The text is not JSON, or a field is missing, unknown or of another type.
    #[error("it is no axis file: {0}")]
    Malformed(String),
    /// A newer version of the program wrote the file.
    #[error("it is of version {version} of the format, and this program knows version {VERSION}")]
    Newer {
        /// The file's version.
        version: u32,
    },
    /// The two ends are not an axis.
    #[error("its ends are no axis: {0}")]
    Ends(#[from] EndsError),
    /// Two fields contradict each other, or a value is out of its range.
    #[error("it contradicts itself: {0}")]
    Contradiction(&'static str),
}

/// The fields in their order.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Fields {
    schema: String,
    program: String,
    cloud: CloudId,
    unit: Unit,
    frame: Frame,
    annotator: String,
    role: Role,
    cannot_tell: bool,
    // Without this attribute serde would take a missing field for null.
    #[serde(deserialize_with = "Option::deserialize")]
    peduncle_base: Option<DVec3>,
    #[serde(deserialize_with = "Option::deserialize")]
    blossom_end: Option<DVec3>,
    #[serde(deserialize_with = "Option::deserialize")]
    direction: Option<DVec3>,
    method: Method,
    #[serde(deserialize_with = "Option::deserialize")]
    confidence: Option<f64>,
    note: String,
    blind: bool,
    created: String,
    modified: String,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Frame {
    /// The coordinates of the cloud's file.
    File,
}

/// The field that is read first, whatever the version.
#[derive(Deserialize)]
struct Head {
    schema: String,
}

impl Annotation {
    /// Formats the content of the axis file.
    pub fn to_json(&self) -> String {
        // Strings and finite numbers cannot fail to become JSON.
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }

    /// Reads an axis file.
    ///
    /// # Errors
    /// Returns an error if the file is of a newer version, is not an axis file, or contradicts itself.
    pub fn from_json(text: &[u8]) -> Result<Self, FileError> {
        let malformed = |error: serde_json::Error| FileError::Malformed(one_line(&error.to_string()));
        let head: Head = serde_json::from_slice(text).map_err(malformed)?;
        let version = head.schema.strip_prefix(FORMAT).and_then(|v| v.parse().ok());
        match version {
            Some(VERSION) => {}
            Some(version) if version > VERSION => return Err(FileError::Newer { version }),
            _ => {
                let text = format!("its schema is {:?}, not {FORMAT}{VERSION}", head.schema);
                return Err(FileError::Malformed(text));
            }
        }
        let fields: Fields = serde_json::from_slice(text).map_err(malformed)?;
        fields.try_into()
    }

    fn fields(&self) -> Fields {
        let Judgment {
            ends,
            method,
            confidence,
            note,
            blind,
        } = self.judgment.clone();
        Fields {
            schema: format!("{FORMAT}{VERSION}"),
            program: self.program.clone(),
            cloud: self.cloud.clone(),
            unit: self.unit,
            frame: Frame::File,
            annotator: self.annotator.clone(),
            role: self.role,
            cannot_tell: ends.is_none(),
            peduncle_base: ends.map(|e| e.peduncle_base()),
            blossom_end: ends.map(|e| e.blossom_end()),
            direction: ends.map(|e| e.direction()),
            method,
            confidence: confidence.map(Confidence::value),
            note,
            blind,
            created: self.created.clone(),
            modified: self.modified.clone(),
        }
    }
}

/// The tolerance of a direction, about 0.0006°: one written with few digits still agrees with its ends.
const SAME_DIRECTION_RAD: f64 = 1e-5;

impl TryFrom<Fields> for Annotation {
    type Error = FileError;

    fn try_from(fields: Fields) -> Result<Self, FileError> {
        let ends = match (fields.cannot_tell, fields.peduncle_base, fields.blossom_end) {
            (false, Some(base), Some(blossom)) => Some(Ends::new(base, blossom)?),
            (true, None, None) => None,
            (true, ..) => return Err(FileError::Contradiction("it has an end, and none can be told")),
            (false, ..) => return Err(FileError::Contradiction("an end is missing")),
        };
        let agrees = match (&ends, fields.direction) {
            (Some(ends), Some(direction)) => {
                angle_between_directions_rad(ends.direction(), direction) < SAME_DIRECTION_RAD
            }
            (None, None) => true,
            _ => false,
        };
        if !agrees {
            return Err(FileError::Contradiction("its direction is not that of its ends"));
        }
        let confidence = match fields.confidence {
            None => None,
            Some(value) => Some(
                Confidence::new(value)
                    .ok_or(FileError::Contradiction("its confidence is not from 0 to 1"))?,
            ),
        };
        if !is_rfc3339(&fields.created) || !is_rfc3339(&fields.modified) {
            return Err(FileError::Contradiction("a time of it is no time (RFC 3339)"));
        }
        Ok(Self {
            cloud: fields.cloud,
            unit: fields.unit,
            annotator: fields.annotator,
            role: fields.role,
            judgment: Judgment {
                ends,
                method: fields.method,
                confidence,
                note: fields.note,
                blind: fields.blind,
            },
            created: fields.created,
            modified: fields.modified,
            program: fields.program,
        })
    }
}

impl Serialize for Annotation {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.fields().serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Annotation {
    /// Reads this version alone; [`Annotation::from_json`] distinguishes newer files from malformed ones.
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let fields = Fields::deserialize(deserializer)?;
        if fields.schema != format!("{FORMAT}{VERSION}") {
            return Err(serde::de::Error::custom("another version of the format"));
        }
        fields.try_into().map_err(serde::de::Error::custom)
    }
}

/// Checks that a text is a time in RFC 3339: `2026-03-01T12:00:00Z`, with a fraction or an offset if need be.
fn is_rfc3339(text: &str) -> bool {
    // Of the spellings of ISO 8601 that jiff reads, RFC 3339 has the one with a `T` and with seconds.
    let has = |at: usize, byte| text.as_bytes().get(at) == Some(&byte);
    has(10, b'T') && has(16, b':') && !text.ends_with(']') && text.parse::<Timestamp>().is_ok()
}

/// The present time in UTC and to the second, as annotations record it: `2026-03-01T12:00:00Z`.
pub fn now() -> String {
    format!("{:.0}", Timestamp::now())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_times_in_rfc_3339_pass_for_times() {
        let now = now();
        assert!(now.len() == 20 && now.ends_with('Z'), "{now}");
        for time in [
            now.as_str(),
            "1970-01-01T00:00:00Z",
            "2000-02-29T00:00:00Z",
            "2026-03-01T12:00:00.25Z",
            "2026-03-01T12:00:00-05:30",
        ] {
            assert!(is_rfc3339(time), "{time}");
        }
        let others = [
            "",
            "yesterday",
            "2026-03-01",
            "2026-03-01T12:00:00",
            "2026-03-01 12:00:00Z",
            "2026-03-01T12:00Z",
            "2026-03-01T12:00:00.Z",
            "2026-03-01T12:00:00Z ",
            "2026-03-01T12:00:00Z[UTC]",
            "2026-03-01T12:00:0éZ",
            "2026-02-29T12:00:00Z",
        ];
        for other in others {
            assert!(!is_rfc3339(other), "{other}");
        }
    }
}
