//! Takes a fit that has come, and asks for the one that is wanted now.

use std::sync::Arc;

use glam::DVec3;

use super::{BodyResult, Estimators};
use crate::app::context::Context;
use crate::app::inspector::stages::AnalyzedFruit;
use crate::app::workers::{Crashed, PATIENCE};
use crate::estimate::{EstimateError, Estimator, Prior, estimate};
use crate::geometry::Unit;
use crate::method::OutlierFilter;
use crate::parallel::Cancelled;

/// Everything that the fit of the body depends on.
#[derive(Debug, Clone)]
pub(super) struct FitKey {
    positions: Arc<Vec<DVec3>>,
    /// The indices of the peduncle's points.
    peduncle: Vec<usize>,
    unit: Unit,
    viewpoint: DVec3,
    outliers: Option<OutlierFilter>,
    prior: Prior,
}

impl FitKey {
    fn new(walked: &AnalyzedFruit, prior: Prior) -> Self {
        let (fruit, params) = (&walked.fruit, &walked.analysis.params);
        let peduncle = fruit.peduncle.as_ref().map(|peduncle| peduncle.in_cloud.clone());
        Self {
            positions: fruit.cloud().shared_positions(),
            peduncle: peduncle.unwrap_or_default(),
            unit: params.unit,
            viewpoint: params.viewpoint,
            outliers: params.filters.outliers,
            prior,
        }
    }

    fn is_of_cloud(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.positions, &other.positions)
    }
}

impl PartialEq for FitKey {
    /// Clouds are compared by their addresses.
    fn eq(&self, other: &Self) -> bool {
        self.is_of_cloud(other)
            && (self.unit, self.viewpoint, self.prior) == (other.unit, other.viewpoint, other.prior)
            && self.outliers == other.outliers
            && self.peduncle == other.peduncle
    }
}

impl Estimators {
    /// To be called once a frame, after the inspector's analysis and before its view.
    pub(in crate::app) fn update(&mut self, cx: &mut Context) {
        if let Some(result) = self.fits.take() {
            take(result, cx);
        }
        let Some(walked) = cx.state.walked.clone() else {
            if self.known.take().is_some() || self.asked.take().is_some() {
                self.fits.cancel();
                self.asked = None;
                cx.state.estimators.forget();
            }
            return;
        };
        let prior = cx.state.settings.request.estimates.prior;
        let is_known =
            |(known, with): &(Arc<AnalyzedFruit>, Prior)| Arc::ptr_eq(known, &walked) && *with == prior;
        if self.known.as_ref().is_some_and(is_known) {
            return;
        }
        self.known = Some((walked.clone(), prior));
        let no_surface = Err(EstimateError::NoFit);
        let paper = estimate(Estimator::Paper, &walked.analysis, &no_surface, prior, &());
        cx.state.estimators.paper = paper.ok().map(Arc::new);
        self.ask(&walked, prior, cx);
    }

    fn ask(&mut self, walked: &Arc<AnalyzedFruit>, prior: Prior, cx: &mut Context) {
        let wanted = FitKey::new(walked, prior);
        if self.asked.as_ref() == Some(&wanted) {
            return;
        }
        let state = &mut cx.state.estimators;
        if self
            .asked
            .as_ref()
            .is_none_or(|asked| !asked.is_of_cloud(&wanted))
        {
            cx.pool.discard(state.body.take());
        }
        self.asked = Some(wanted);
        (state.is_pending, state.problem) = (true, None);
        let walked = walked.clone();
        self.fits
            .submit(move |watch| BodyResult::of(&walked.fruit, &walked.analysis.params, prior, watch));
        if let Some(result) = self.fits.take_within(PATIENCE) {
            take(result, cx);
        }
    }
}

fn take(result: Result<Result<BodyResult, Cancelled>, Crashed>, cx: &mut Context) {
    let state = &mut cx.state.estimators;
    match result {
        Ok(Ok(body)) => state.body = Some(Arc::new(body)),
        // Another one has been asked for.
        Ok(Err(Cancelled)) => return,
        Err(Crashed(fault)) => {
            state.body = None;
            state.problem = Some(format!(
                "The fit of the body broke off by a fault of the program: {fault}"
            ));
        }
    }
    state.is_pending = false;
}
