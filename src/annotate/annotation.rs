//! One annotation: an annotator's axis of a cloud, with its confidence and its origin.

use serde::{Deserialize, Serialize};

use super::{Author, Ends, Role};
use crate::geometry::Unit;
use crate::method::{AxisEstimate, AxisSource};

/// The starting point of an annotation. An axis that is shown first biases the one set after it, so the starting point is
/// recorded for good: a computed axis that was nudged does not become one set by hand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Method {
    /// Both ends were set by hand.
    #[cfg_attr(feature = "cli", value(skip))]
    ByHand,
    /// The annotator started from the peduncle's axis (§ 3.2).
    #[cfg_attr(feature = "cli", value(name = "peduncle"))]
    FromPeduncle,
    /// The annotator started from the computed axis (Eq. 16).
    #[cfg_attr(feature = "cli", value(name = "computed"))]
    FromComputed,
    /// The axis was imported from another program.
    #[cfg_attr(feature = "cli", value(skip))]
    Imported,
}

impl Method {
    /// Returns the name that files and tables use.
    pub fn name(self) -> &'static str {
        match self {
            Self::ByHand => "by-hand",
            Self::FromPeduncle => "from-peduncle",
            Self::FromComputed => "from-computed",
            Self::Imported => "imported",
        }
    }
}

/// An annotator's confidence, from 0 (a guess) to 1 (certain).
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct Confidence(f64);

impl Confidence {
    /// The value of the word "low".
    pub const LOW: Self = Self(0.25);
    /// The value of the word "medium".
    pub const MEDIUM: Self = Self(0.5);
    /// The value of the word "high".
    pub const HIGH: Self = Self(0.75);

    /// Creates a confidence; `None` outside 0 to 1.
    pub fn new(value: f64) -> Option<Self> {
        (0.0..=1.0).contains(&value).then_some(Self(value))
    }

    /// Returns the value, 0 to 1.
    pub fn value(self) -> f64 {
        self.0
    }
}

/// An annotator's judgment of a cloud. The rest of an [`Annotation`] is bookkeeping.
#[derive(Debug, Clone, PartialEq)]
pub struct Judgment {
    /// The axis; `None` if the cloud does not show it.
    pub ends: Option<Ends>,
    /// The starting point of the axis.
    pub method: Method,
    /// The annotator's confidence, if stated.
    pub confidence: Option<Confidence>,
    /// A note in the annotator's words; empty without one.
    pub note: String,
    /// Whether the annotator saw nothing computed for this cloud: in the window, as far as its file of shown clouds goes
    /// back. What the command line showed cannot be known. [`super::Store`] clears it unless it can be true: the axis is set by
    /// hand, and all edits before it were blind, undone ones included.
    pub blind: bool,
}

impl Judgment {
    /// Creates the judgment of an axis set by hand, without confidence or note.
    pub fn by_hand(ends: Ends) -> Self {
        Self::bare(Some(ends))
    }

    /// Creates the judgment that the axis cannot be told, without confidence or note.
    pub fn cannot_tell() -> Self {
        Self::bare(None)
    }

    fn bare(ends: Option<Ends>) -> Self {
        Self {
            ends,
            method: Method::ByHand,
            confidence: None,
            note: String::new(),
            blind: false,
        }
    }
}

/// The identity of the cloud that an axis belongs to.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CloudId {
    /// The file's name, for people; clouds may be renamed.
    pub file: String,
    /// SHA-256 of the file's bytes, in 64 lowercase hexadecimal digits.
    pub sha256: String,
}

/// One annotator's axis of one cloud: the content of an axis file.
#[derive(Debug, Clone, PartialEq)]
pub struct Annotation {
    /// The cloud.
    pub cloud: CloudId,
    /// The unit in which the coordinates of the cloud's file, and of this axis, were taken.
    pub unit: Unit,
    /// The annotator's name.
    pub annotator: String,
    /// The annotator's role.
    pub role: Role,
    /// The judgment.
    pub judgment: Judgment,
    /// The time of the annotator's first axis of this cloud (RFC 3339).
    pub created: String,
    /// The time of this axis (RFC 3339).
    pub modified: String,
    /// The program and version that wrote it.
    pub program: String,
}

impl Annotation {
    /// Returns the ends of the axis; `None` if it cannot be told.
    pub fn ends(&self) -> Option<&Ends> {
        self.judgment.ends.as_ref()
    }

    /// Returns whether this author made the annotation.
    pub fn is_by(&self, author: &Author) -> bool {
        // A cloud has one adjudicated axis, whoever set it.
        self.role == author.role() && (self.role == Role::Adjudicator || self.annotator == author.name())
    }

    /// Returns the axis as one estimate among several, through the middle of its ends.
    pub fn estimate(&self) -> Option<AxisEstimate> {
        self.ends().map(|ends| AxisEstimate {
            source: match self.role {
                Role::Annotator => AxisSource::Annotator(self.annotator.clone()),
                Role::Adjudicator => AxisSource::Adjudicated,
            },
            origin: ends.middle(),
            direction: ends.direction(),
            confidence: self.judgment.confidence.map(Confidence::value),
        })
    }
}
