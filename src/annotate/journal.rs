//! The journal of an annotator's edits of one cloud: append-only, a line an edit, each with a checksum.
//!
//! A line that was cut short when the program or the machine died is told by its checksum. It is the
//! last one, and nobody was ever told that it is saved.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::{Annotation, Author, Role};
use crate::undo::History;

/// The name and version of the format.
const SCHEMA: &str = "axiscope.axis-journal/1";
/// Digits of the checksum: 64 bits of SHA-256.
const DIGITS: usize = 16;

/// What was done.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Deed {
    /// A new state.
    Edit(Box<Annotation>),
    /// Back by one.
    Undo,
    /// Forward by one.
    Redo,
}

/// The first line. It holds no time and no version of the program, so that the same journal always
/// begins with the same bytes.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Head {
    schema: String,
    cloud_sha256: String,
    annotator: String,
    role: Role,
}

/// Any other line.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Line {
    /// From 1.
    n: u64,
    /// When (RFC 3339).
    at: String,
    #[serde(rename = "do")]
    deed: Deed,
}

/// Why a journal cannot be gone on with.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum JournalError {
    /// It begins in another way.
    #[error("it is no journal of this program's")]
    Foreign,
    /// A newer program began it.
    #[error("a newer version of this program began it ({0})")]
    Newer(String),
    /// It belongs to another cloud.
    #[error("it belongs to another cloud")]
    OtherCloud,
    /// It is somebody else's.
    #[error("it is {0}'s")]
    OtherAnnotator(String),
    /// A line inside is not what was written.
    #[error("its line {0} is damaged")]
    Damaged(usize),
}

/// A journal, read.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Journal {
    /// The edits, undone and done again as they were.
    pub history: History<Annotation>,
    /// Every annotation that there ever was, the oldest first; those that can no longer be redone as well.
    pub ever: Vec<Annotation>,
    /// How many lines were understood, the first one apart.
    pub deeds: u64,
    /// How many bytes they are. What follows was cut short, and is to be written over.
    pub length: u64,
    /// Whether something follows.
    pub is_cut_short: bool,
}

/// The first line of a journal, which also stands before the first deed.
pub fn head_line(cloud_sha256: &str, author: &Author) -> Vec<u8> {
    line(&Head {
        schema: SCHEMA.into(),
        cloud_sha256: cloud_sha256.into(),
        annotator: match author.role() {
            Role::Annotator => author.name().into(),
            // Whoever decides; each line says who it was.
            Role::Adjudicator => String::new(),
        },
        role: author.role(),
    })
}

/// The `n`-th deed's line, from 1.
pub fn deed_line(n: u64, at: &str, deed: Deed) -> Vec<u8> {
    line(&Line {
        n,
        at: at.into(),
        deed,
    })
}

/// Reads the journal of this author for this cloud.
///
/// # Errors
/// Where it is another one, or a line that is not the last is damaged.
pub fn read_journal(bytes: &[u8], cloud_sha256: &str, author: &Author) -> Result<Journal, JournalError> {
    let head = head_line(cloud_sha256, author);
    let mut journal = Journal::default();
    if bytes.len() < head.len() && head.starts_with(bytes) {
        // Killed while it was begun.
        journal.is_cut_short = !bytes.is_empty();
        return Ok(journal);
    }
    let Some(mut rest) = bytes.strip_prefix(head.as_slice()) else {
        return Err(other_head(bytes, cloud_sha256));
    };
    journal.length = head.len() as u64;
    while let Some(end) = rest.iter().position(|&byte| byte == b'\n') {
        let (line, after) = rest.split_at(end + 1);
        let n = journal.deeds + 1;
        // The first line is the head, and people count from 1.
        let damaged = || JournalError::Damaged(usize::try_from(n).unwrap_or(usize::MAX).saturating_add(1));
        let deed = deed_of(line, n).ok_or_else(damaged)?;
        let history = &mut journal.history;
        let could = match deed {
            Deed::Edit(state) => {
                journal.ever.push((*state).clone());
                history.push(*state);
                true
            }
            Deed::Undo => history.undo().is_some(),
            Deed::Redo => history.redo().is_some(),
        };
        if !could {
            return Err(damaged());
        }
        journal.deeds = n;
        journal.length += line.len() as u64;
        rest = after;
    }
    journal.is_cut_short = !rest.is_empty();
    Ok(journal)
}

/// A line: the checksum, a space, JSON.
fn line(content: &impl Serialize) -> Vec<u8> {
    // Strings and finite numbers cannot fail to become JSON.
    let json = serde_json::to_string(content).unwrap_or_default();
    format!("{} {json}\n", checksum(json.as_bytes())).into_bytes()
}

fn checksum(bytes: &[u8]) -> String {
    hex::encode(&Sha256::digest(bytes)[..DIGITS / 2])
}

/// The JSON of a whole line whose checksum is right.
fn content(line: &[u8]) -> Option<&[u8]> {
    let (sum, rest) = line.split_at_checked(DIGITS)?;
    let json = rest.strip_prefix(b" ")?.strip_suffix(b"\n")?;
    (checksum(json).as_bytes() == sum).then_some(json)
}

fn deed_of(line: &[u8], n: u64) -> Option<Deed> {
    let line: Line = serde_json::from_slice(content(line)?).ok()?;
    (line.n == n).then_some(line.deed)
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
