//! The estimates of the current cloud: the paper's beside the fitted body's.
//!
//! The paper's estimate is its analysis. The body is fitted by a job of its own, again only when something that it depends
//! on has changed: the points, the peduncle, the viewpoint, the unit, the filter of outliers or the prior. Changes of the
//! grid, of τ and of the scores leave it as it is.

mod commands;
mod fitted;
mod state;
mod update;

use std::sync::Arc;

use super::context::Context;
use super::inspector::stages::AnalyzedFruit;
use super::workers::{Lane, Pool};
use crate::estimate::Prior;
use crate::parallel::Cancelled;

pub use commands::{BodyPart, EstimatorsCommand};
pub use fitted::{BodyResult, FittedBody, OutlineSector};
pub use state::EstimatorsState;
use update::FitKey;

/// The job of the body's fit.
pub(super) struct Estimators {
    fits: Lane<Result<BodyResult, Cancelled>>,
    /// The analysis and the prior that were looked at last.
    known: Option<(Arc<AnalyzedFruit>, Prior)>,
    /// The input of the newest fit that was asked for.
    asked: Option<FitKey>,
}

impl Estimators {
    pub(super) fn new(pool: &Pool) -> Self {
        Self {
            fits: Lane::new(pool),
            known: None,
            asked: None,
        }
    }

    /// Does what is asked about estimates.
    #[expect(clippy::unused_self, reason = "as every part's")]
    pub(super) fn apply(&mut self, command: EstimatorsCommand, cx: &mut Context) {
        match command {
            EstimatorsCommand::Count(estimator) => cx.state.estimators.counts = estimator,
            EstimatorsCommand::Show(part, on) => {
                let parts = &mut cx.state.estimators.parts;
                match part {
                    BodyPart::Axis => parts.axis = on,
                    BodyPart::Alternatives => parts.alternatives = on,
                    BodyPart::Surface => parts.surface = on,
                }
            }
            EstimatorsCommand::Prior(prior) => {
                let mut request = cx.state.settings.request.clone();
                request.estimates.prior = prior;
                cx.set_request(request, None);
            }
        }
    }

    /// Whether a fit is still to come or to be taken.
    pub(super) fn is_busy(&self) -> bool {
        self.fits.is_busy()
    }
}
