//! What somebody says of a cloud's axis.

use serde::{Deserialize, Serialize};

use super::{Author, Ends, Role};
use crate::geometry::Unit;
use crate::method::{AxisEstimate, AxisSource};

/// The axis, or that it cannot be told.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Finding {
    /// Both ends.
    Axis(Ends),
    /// The cloud does not show it.
    CannotTell,
}

/// Where the annotator began. An axis that was shown first draws the hand that follows it, so it is
/// recorded for good: nudging a computed axis does not make it one set by hand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Method {
    /// Both ends were set by hand.
    #[cfg_attr(feature = "cli", value(skip))]
    ByHand,
    /// From the peduncle's axis (§ 3.2).
    #[cfg_attr(feature = "cli", value(name = "peduncle"))]
    FromPeduncle,
    /// From the method's own axis (Eq. 16).
    #[cfg_attr(feature = "cli", value(name = "computed"))]
    FromComputed,
    /// From another program.
    #[cfg_attr(feature = "cli", value(skip))]
    Imported,
}

impl Method {
    /// The name that files and tables use.
    pub fn name(self) -> &'static str {
        match self {
            Self::ByHand => "by-hand",
            Self::FromPeduncle => "from-peduncle",
            Self::FromComputed => "from-computed",
            Self::Imported => "imported",
        }
    }
}

/// How sure somebody is, from 0 (a guess) to 1 (certain).
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct Confidence(f64);

impl Confidence {
    /// In a word: low.
    pub const LOW: Self = Self(0.25);
    /// In a word: medium.
    pub const MEDIUM: Self = Self(0.5);
    /// In a word: high.
    pub const HIGH: Self = Self(0.75);

    /// A confidence; `None` outside 0 to 1.
    pub fn new(value: f64) -> Option<Self> {
        (0.0..=1.0).contains(&value).then_some(Self(value))
    }

    /// From 0 to 1.
    pub fn value(self) -> f64 {
        self.0
    }
}

/// What an annotator decides; the rest of an [`Annotation`] is bookkeeping.
#[derive(Debug, Clone, PartialEq)]
pub struct Judgment {
    /// The axis, or that it cannot be told.
    pub finding: Finding,
    /// Where the annotator began.
    pub method: Method,
    /// How sure the annotator is, where that was said.
    pub confidence: Option<Confidence>,
    /// Anything else, in words.
    pub note: String,
    /// Whether nothing computed was shown meanwhile. [`super::Store`] keeps it only where it can be true:
    /// set by hand, and after nothing but blind edits, undone ones included.
    pub blind: bool,
}

impl Judgment {
    /// An axis set by hand, with nothing else said.
    pub fn by_hand(ends: Ends) -> Self {
        Self::bare(Finding::Axis(ends))
    }

    /// That the axis cannot be told, with nothing else said.
    pub fn cannot_tell() -> Self {
        Self::bare(Finding::CannotTell)
    }

    fn bare(finding: Finding) -> Self {
        Self {
            finding,
            method: Method::ByHand,
            confidence: None,
            note: String::new(),
            blind: false,
        }
    }
}

/// Which cloud an axis belongs to.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CloudId {
    /// The file's name, for people; clouds may be renamed.
    pub file: String,
    /// SHA-256 of the file's bytes, in 64 lowercase hexadecimal digits.
    pub sha256: String,
}

/// One annotator's axis of one cloud: what an axis file holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Annotation {
    /// The cloud.
    pub cloud: CloudId,
    /// What a coordinate of the cloud's file, and of this axis, was taken for.
    pub unit: Unit,
    /// Who set it.
    pub annotator: String,
    /// In which role.
    pub role: Role,
    /// What was decided.
    pub judgment: Judgment,
    /// When the annotator first set an axis of this cloud (RFC 3339).
    pub created: String,
    /// When this one was set (RFC 3339).
    pub modified: String,
    /// The program and version that wrote it.
    pub program: String,
}

impl Annotation {
    /// The axis, unless it cannot be told.
    pub fn ends(&self) -> Option<&Ends> {
        match &self.judgment.finding {
            Finding::Axis(ends) => Some(ends),
            Finding::CannotTell => None,
        }
    }

    /// Whether it is this author's.
    pub fn is_by(&self, author: &Author) -> bool {
        // Whoever decides, there is one decision a cloud.
        self.role == author.role() && (self.role == Role::Adjudicator || self.annotator == author.name())
    }

    /// The axis as one estimate among several, through the middle of its ends.
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
