//! The journal of an annotator's operations on one cloud: append-only, one line per operation, each with a checksum.
//!
//! If the program or the machine dies while a line is written, the line is truncated and its checksum or line end is
//! missing. It can only be the last one, and it was never reported as saved, so it is dropped.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::{Annotation, Author, Role};
use crate::undo::History;

/// The name and version of the format.
const SCHEMA: &str = "axiscope.axis-journal/1";
/// The number of hexadecimal digits of a checksum: the first 64 bits of SHA-256.
const DIGITS: usize = 16;

/// One operation on an annotation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Operation {
    /// A new annotation.
    Edit(Box<Annotation>),
    /// One step back.
    Undo,
    /// One step forward.
    Redo,
}

/// The first line. It holds neither a time nor the program's version, so that every journal of an author and cloud
/// begins with the same bytes.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Head {
    schema: String,
    cloud_sha256: String,
    annotator: String,
    role: Role,
}

/// A line after the first: one operation.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Line {
    /// The number of the operation, from 1.
    n: u64,
    /// The time of the operation (RFC 3339).
    at: String,
    #[serde(rename = "do")]
    operation: Operation,
}

/// The reason why a journal cannot be continued.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum JournalError {
    /// The first line is not a journal's.
    #[error("it is no journal of this program's")]
    Foreign,
    /// A newer version of the program began it.
    #[error("a newer version of this program began it ({0})")]
    Newer(String),
    /// It belongs to another cloud.
    #[error("it belongs to another cloud")]
    OtherCloud,
    /// It belongs to another annotator.
    #[error("it is {0}'s")]
    OtherAnnotator(String),
    /// A line before the last has a wrong checksum or an impossible operation.
    #[error("its line {0} is damaged")]
    Damaged(usize),
}

/// The content of a journal.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Journal {
    /// The edits, undone and done again as they were.
    pub history: History<Annotation>,
    /// Every annotation that there ever was, the oldest first; those that can no longer be redone as well.
    pub ever: Vec<Annotation>,
    /// The number of lines that were understood, not counting the first.
    pub operations: u64,
    /// Their length in bytes. The rest was cut short, and is to be overwritten.
    pub length: u64,
    /// Whether something follows.
    pub is_truncated: bool,
}

/// Returns the first line of a journal. It is written together with the first operation.
pub fn head_line(cloud_sha256: &str, author: &Author) -> Vec<u8> {
    line(&Head {
        schema: SCHEMA.into(),
        cloud_sha256: cloud_sha256.into(),
        annotator: match author.role() {
            Role::Annotator => author.name().into(),
            // Each cloud has one adjudicated axis, whoever set it; every edit names its annotator.
            Role::Adjudicator => String::new(),
        },
        role: author.role(),
    })
}

/// Returns the line of the `n`-th operation, counted from 1.
pub fn operation_line(n: u64, at: &str, operation: Operation) -> Vec<u8> {
    line(&Line {
        n,
        at: at.into(),
        operation,
    })
}

/// Reads the journal of this author for this cloud.
///
/// # Errors
/// Returns an error if it is another journal, or if a line before the last is damaged.
pub fn read_journal(bytes: &[u8], cloud_sha256: &str, author: &Author) -> Result<Journal, JournalError> {
    let head = head_line(cloud_sha256, author);
    let mut journal = Journal::default();
    if bytes.len() < head.len() && head.starts_with(bytes) {
        // The program died while it wrote the first line.
        journal.is_truncated = !bytes.is_empty();
        return Ok(journal);
    }
    let Some(mut rest) = bytes.strip_prefix(head.as_slice()) else {
        return Err(other_head(bytes, cloud_sha256));
    };
    journal.length = head.len() as u64;
    while let Some(end) = rest.iter().position(|&byte| byte == b'\n') {
        let (line, after) = rest.split_at(end + 1);
        let n = journal.operations + 1;
        // The first line is the head, and people count from 1.
        let damaged = || JournalError::Damaged(usize::try_from(n).unwrap_or(usize::MAX).saturating_add(1));
        let operation = operation_of(line, n).ok_or_else(damaged)?;
        let history = &mut journal.history;
        let could = match operation {
            Operation::Edit(state) => {
                journal.ever.push((*state).clone());
                history.push(*state);
                true
            }
            Operation::Undo => history.undo().is_some(),
            Operation::Redo => history.redo().is_some(),
        };
        if !could {
            return Err(damaged());
        }
        journal.operations = n;
        journal.length += line.len() as u64;
        rest = after;
    }
    journal.is_truncated = !rest.is_empty();
    Ok(journal)
}

/// Formats a line: the checksum, a space, JSON.
fn line(content: &impl Serialize) -> Vec<u8> {
    // Strings and finite numbers cannot fail to become JSON.
    let json = serde_json::to_string(content).unwrap_or_default();
    format!("{} {json}\n", checksum(json.as_bytes())).into_bytes()
}

fn checksum(bytes: &[u8]) -> String {
    hex::encode(&Sha256::digest(bytes)[..DIGITS / 2])
}

/// Returns the JSON of a complete line; `None` if the checksum is wrong.
fn content(line: &[u8]) -> Option<&[u8]> {
    let (sum, rest) = line.split_at_checked(DIGITS)?;
    let json = rest.strip_prefix(b" ")?.strip_suffix(b"\n")?;
    (checksum(json).as_bytes() == sum).then_some(json)
}

fn operation_of(line: &[u8], n: u64) -> Option<Operation> {
    let line: Line = serde_json::from_slice(content(line)?).ok()?;
    (line.n == n).then_some(line.operation)
}

fn other_head(bytes: &[u8], cloud_sha256: &str) -> JournalError {
    let end = bytes.iter().position(|&byte| byte == b'\n').map_or(0, |i| i + 1);
    let Some(json) = content(&bytes[..end]) else {
        return JournalError::Foreign;
    };
    match serde_json::from_slice::<Head>(json) {
        Ok(head) if head.schema == SCHEMA && head.cloud_sha256 != cloud_sha256 => JournalError::OtherCloud,
        Ok(head) if head.schema == SCHEMA => JournalError::OtherAnnotator(head.annotator),
        _ => match serde_json::from_slice::<serde_json::Value>(json) {
            Ok(value)
                if value["schema"]
                    .as_str()
                    .is_some_and(|s| s.starts_with("axiscope.axis-journal/")) =>
            {
                JournalError::Newer(value["schema"].as_str().unwrap_or_default().into())
            }
            _ => JournalError::Foreign,
        },
    }
}
