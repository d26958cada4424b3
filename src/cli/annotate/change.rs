//! One edit of an axis, as it stands on the command line or in a line of a script.

use std::str::FromStr;

use axiscope::annotate::{Annotation, Confidence, Ends, EndsError, Finding, Judgment, Method, Pivot};
use clap::{ArgGroup, Args};
use glam::DVec3;

use crate::cli::options::{number, position};

/// What to change. Several changes at once are one edit; they are made in the order of this list.
#[derive(Debug, Clone, Default, Args)]
#[allow(
    clippy::struct_excessive_bools,
    reason = "each is a flag of its own on the command line"
)]
#[command(next_help_heading = "Edit", group = ArgGroup::new("edit").multiple(true))]
pub(super) struct Change {
    /// Undo the last edit
    #[arg(long, conflicts_with_all = ["redo", "edit"])]
    pub(super) undo: bool,
    /// Redo the edit that was undone last
    #[arg(long, conflicts_with = "edit")]
    pub(super) redo: bool,
    /// Position of the peduncle's base, in the file's unit and frame
    #[arg(long, value_name = "X,Y,Z", group = "edit", value_parser = position, allow_hyphen_values = true, conflicts_with = "start")]
    base: Option<DVec3>,
    /// Position of the blossom end
    #[arg(long, value_name = "X,Y,Z", group = "edit", value_parser = position, allow_hyphen_values = true, conflicts_with = "start")]
    blossom: Option<DVec3>,
    /// Start from a known axis, which the axis file records
    #[arg(long, value_enum, group = "edit")]
    start: Option<Method>,
    /// Record that the axis cannot be told
    #[arg(long, group = "edit", conflicts_with_all = ["base", "blossom", "start", "flip", "turn", "shift", "lengthen"])]
    cannot_tell: bool,
    /// Exchange the ends
    #[arg(long, group = "edit")]
    flip: bool,
    /// Turn by DEG about a direction: lean (towards the viewer or away), picture (within the picture), or X,Y,Z
    #[arg(long, value_name = "ABOUT=DEG", group = "edit", allow_hyphen_values = true)]
    turn: Vec<Turn>,
    /// Move the whole axis by this vector
    #[arg(long, value_name = "X,Y,Z", group = "edit", value_parser = position, allow_hyphen_values = true)]
    shift: Option<DVec3>,
    /// Make the axis longer by L, or shorter if L is negative
    #[arg(long, value_name = "L", group = "edit", value_parser = number, allow_negative_numbers = true)]
    lengthen: Option<f64>,
    /// Point that stays in place when the axis is turned or lengthened
    #[arg(long, value_enum, default_value = "middle")]
    hold: Pivot,
    /// Your confidence: 0 to 1, or low, medium, high (0.25, 0.5, 0.75)
    #[arg(long, value_name = "SURE", group = "edit", value_parser = confidence)]
    confidence: Option<Confidence>,
    /// A note on the axis
    #[arg(long, value_name = "TEXT", group = "edit")]
    note: Option<String>,
    /// Record that you saw no computed axis
    #[arg(long, requires = "edit")]
    blind: bool,
}

/// A turn by degrees about a direction.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Turn {
    about: About,
    degrees: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum About {
    Lean,
    Picture,
    Direction(DVec3),
}

impl FromStr for Turn {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (about, degrees) = text
            .split_once('=')
            .ok_or("expected lean=DEG, picture=DEG or X,Y,Z=DEG")?;
        Ok(Self {
            about: match about {
                "lean" => About::Lean,
                "picture" => About::Picture,
                _ => {
                    About::Direction(position(about).map_err(|_| "expected lean, picture or X,Y,Z before =")?)
                }
            },
            degrees: number(degrees)?,
        })
    }
}

fn confidence(text: &str) -> Result<Confidence, String> {
    match text {
        "low" => Ok(Confidence::LOW),
        "medium" => Ok(Confidence::MEDIUM),
        "high" => Ok(Confidence::HIGH),
        _ => Confidence::new(number(text)?).ok_or_else(|| "expected 0 to 1, or low, medium, high".into()),
    }
}

impl Change {
    /// Whether anything is to be edited, undone or redone.
    pub(super) fn is_any(&self) -> bool {
        let moves = self.flip || !self.turn.is_empty() || self.shift.is_some() || self.lengthen.is_some();
        let ends = self.base.is_some() || self.blossom.is_some() || self.start.is_some() || self.cannot_tell;
        self.undo || self.redo || moves || ends || self.confidence.is_some() || self.note.is_some()
    }

    /// What it makes of the present state. `start` gives the axis to start from, `viewpoint` is where the
    /// camera is.
    pub(super) fn judgment(
        &self,
        current: Option<&Annotation>,
        viewpoint: DVec3,
        start: impl FnOnce(Method) -> anyhow::Result<Ends>,
    ) -> anyhow::Result<Judgment> {
        let before = current.map(|annotation| annotation.judgment.clone());
        let known = current.and_then(Annotation::ends).copied();
        let (method, mut ends) = match (self.start, self.base, self.blossom) {
            (Some(method), ..) => (method, Some(start(method)?)),
            // Both ends anew: this does not follow from what was there.
            (None, Some(base), Some(blossom)) => (Method::ByHand, Some(Ends::new(base, blossom)?)),
            (None, base, blossom) => {
                let mut ends = known;
                if base.is_some() || blossom.is_some() {
                    let known = known.ok_or_else(no_axis)?;
                    ends = Some(Ends::new(
                        base.unwrap_or(known.peduncle_base()),
                        blossom.unwrap_or(known.blossom_end()),
                    )?);
                }
                (before.as_ref().map_or(Method::ByHand, |b| b.method), ends)
            }
        };
        if self.flip || !self.turn.is_empty() || self.shift.is_some() || self.lengthen.is_some() {
            ends = Some(self.moved(ends.ok_or_else(no_axis)?, viewpoint)?);
        }
        let finding = match ends {
            _ if self.cannot_tell => Finding::CannotTell,
            Some(ends) => Finding::Axis(ends),
            None if before.is_some() => Finding::CannotTell,
            None => return Err(no_axis()),
        };
        let (confidence, note) = before.map_or((None, String::new()), |b| (b.confidence, b.note));
        Ok(Judgment {
            finding,
            method: if self.cannot_tell { Method::ByHand } else { method },
            confidence: self.confidence.or(confidence),
            note: self.note.clone().unwrap_or(note),
            blind: self.blind,
        })
    }

    fn moved(&self, mut ends: Ends, viewpoint: DVec3) -> Result<Ends, EndsError> {
        if self.flip {
            ends = ends.flipped();
        }
        for turn in &self.turn {
            let [lean, picture] = ends.across(ends.middle() - viewpoint);
            let about = match turn.about {
                About::Lean => lean,
                About::Picture => picture,
                About::Direction(direction) => direction,
            };
            ends = ends.turned(about, turn.degrees, self.hold)?;
        }
        if let Some(by) = self.shift {
            ends = ends.shifted(by)?;
        }
        if let Some(by) = self.lengthen {
            ends = ends.lengthened(by, self.hold)?;
        }
        Ok(ends)
    }
}

fn no_axis() -> anyhow::Error {
    anyhow::anyhow!("there is no axis yet to change: give both ends, or a start")
}
