//! The cloud that is looked at: its analysis, and the view of one of its candidate planes.

mod apply;
pub(super) mod command_line;
pub(super) mod details;
pub(super) mod image;
pub(super) mod key;
pub mod look;
pub(super) mod navigate;
pub mod planes;
pub(super) mod stages;
mod update;
pub mod why;

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

use glam::DVec2;

use super::workers::{Lane, Pool};
use crate::app::source::Source;
use crate::fruit::Fruit;
use crate::geometry::Extent;
use crate::method::PlaneDetail;
use crate::parallel::Cancelled;
use crate::view::ShownPoints;
use details::Details;
use key::AnalysisKey;
use look::{Look, LookRequest};
use stages::{AnalyzeError, AnalyzedFruit, FruitStages};

/// A cloud that has been read and is still to be analyzed.
type Arrival = (Source, Arc<Fruit>, Arc<ShownPoints>);

/// A place of the view, of which the nearest point is sought.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Pick {
    at_px: DVec2,
    /// Whether it was clicked, not only pointed at.
    is_click: bool,
}

/// The jobs of the inspector, and what it remembers from frame to frame.
pub(super) struct Inspector {
    analyses: Lane<(FruitStages, Result<AnalyzedFruit, AnalyzeError>)>,
    /// The input of the newest analysis that was asked for.
    asked: Option<AnalysisKey>,
    arrivals: (Sender<Arrival>, Receiver<Arrival>),
    looks: Lane<Result<Look, Cancelled>>,
    /// The input of the newest look that was asked for.
    asked_look: Option<LookRequest>,
    details: Details,
    picks: Lane<(Pick, Option<usize>)>,
    /// The last click that has not been answered.
    pending_click: Option<Pick>,
    images: Lane<Result<String, String>>,
    /// The part of a plane that playing has passed since the last one, 0 to 1.
    play_phase: f64,
    /// Whether the next cloud is to be framed.
    needs_framing: bool,
    /// The extent of the cloud that the camera was set for.
    framed: Option<Extent>,
}

impl Inspector {
    pub(super) fn new(pool: &Pool) -> Self {
        Self {
            analyses: Lane::new(pool),
            asked: None,
            arrivals: channel(),
            looks: Lane::new(pool),
            asked_look: None,
            details: Details::default(),
            picks: Lane::new(pool),
            pending_click: None,
            images: Lane::new(pool),
            play_phase: 0.0,
            needs_framing: true,
            framed: None,
        }
    }

    /// Whether a result is still to come or to be taken.
    pub(super) fn is_busy(&self) -> bool {
        self.is_computing() || self.picks.is_busy() || self.images.is_busy()
    }

    /// Whether the analysis or the view of the current cloud is being computed.
    pub(super) fn is_computing(&self) -> bool {
        self.analyses.is_busy() || self.looks.is_busy()
    }

    /// The details of planes that are kept in memory.
    pub(super) fn kept_details(&self) -> Vec<Arc<PlaneDetail>> {
        self.details.all()
    }
}
