//! What there is to show of the estimates.

use std::sync::Arc;

use super::BodyResult;
use crate::app::state::State;
use crate::estimate::{Estimate, Estimator};
use crate::method::AxisEstimate;
use crate::view::{BodyDrawing, BodyParts};

/// The estimates of the current cloud, and how they are shown.
#[derive(Debug, Clone)]
pub struct EstimatorsState {
    /// The estimator whose axis counts: the paper's or the body's.
    pub counts: Estimator,
    /// The parts of the body that the view shows.
    pub parts: BodyParts,
    /// The paper's estimate.
    pub paper: Option<Arc<Estimate>>,
    /// The body's estimate, which may be of older settings while another is on its way.
    pub body: Option<Arc<BodyResult>>,
    /// Whether the body is being fitted.
    pub is_pending: bool,
    /// Why the body could not be fitted, a sentence, if the program failed.
    pub problem: Option<String>,
}

impl Default for EstimatorsState {
    /// The paper's axis counts, and the view shows nothing of the body until somebody asks for it.
    fn default() -> Self {
        Self {
            counts: Estimator::Paper,
            parts: BodyParts::default(),
            paper: None,
            body: None,
            is_pending: false,
            problem: None,
        }
    }
}

impl EstimatorsState {
    /// Forgets the estimates of a cloud that is no longer shown.
    pub(super) fn forget(&mut self) {
        (self.paper, self.body, self.problem, self.is_pending) = (None, None, None, false);
    }

    /// The axis of the fitted body, if there is one.
    pub fn body_axis(&self) -> Option<&AxisEstimate> {
        self.body.as_ref()?.estimate.axis.as_ref()
    }
}

impl State {
    /// The axis that counts: of the estimator that was chosen.
    pub fn counted_axis(&self) -> Option<&AxisEstimate> {
        match self.estimators.counts {
            Estimator::Body => self.estimators.body_axis(),
            _ => self.analysis()?.axis.as_ref(),
        }
    }

    /// The fitted body and the parts of it that the view shows; the axis that counts is always one of them. Blind mode
    /// hides all of it.
    pub fn shown_body(&self) -> Option<(Arc<BodyDrawing>, BodyParts)> {
        if self.true_axes.is_blind {
            return None;
        }
        let mut parts = self.estimators.parts;
        parts.axis |= self.estimators.counts == Estimator::Body;
        let fitted = self.estimators.body.as_ref()?.fitted.as_ref()?;
        (parts != BodyParts::default()).then(|| (fitted.drawing.clone(), parts))
    }
}
