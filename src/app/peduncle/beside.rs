//! The paper's two experiments on one cloud, side by side: with the peduncle and without it.

use crate::app::inspector::key::AnalysisKey;
use crate::app::inspector::stages::{AnalyzeError, FruitStages};
use crate::app::workers::JobWatch;
use crate::evaluate::collect_references;
use crate::fruit::Request;
use crate::method::{AxisEstimate, AxisSource, axis_error_rad};
use crate::parallel::Watch as _;
use crate::text::sentence;

/// The axis' error against each reference in degrees, or why there is no axis.
pub type Errors = Result<Vec<(AxisSource, f64)>, String>;

/// The results of both experiments.
#[derive(Debug, Clone, PartialEq)]
pub struct Beside {
    /// With the peduncle's points.
    pub with: Errors,
    /// Without them.
    pub without: Errors,
    pub(super) key: AnalysisKey,
}

impl Beside {
    /// Analyzes the cloud of a key both ways; `None` if the work is called off.
    pub(super) fn compute(key: AnalysisKey, mut stages: FruitStages, watch: &JobWatch) -> Option<Self> {
        let with = errors(&mut stages, &key, false, watch);
        let without = errors(&mut stages, &key, true, watch);
        (!watch.is_cancelled()).then_some(Self { with, without, key })
    }
}

fn errors(stages: &mut FruitStages, key: &AnalysisKey, without_peduncle: bool, watch: &JobWatch) -> Errors {
    let request = Request {
        without_peduncle,
        ..key.request.clone()
    };
    let walked = stages
        .analyze(&key.source, &request, watch, &|_, _| {})
        .map_err(|error| match error {
            AnalyzeError::Fruit(error) => sentence(&error.reason()),
            AnalyzeError::Analysis { error, .. } => sentence(&error.to_string()),
            AnalyzeError::Cancelled => "It was called off.".into(),
        })?;
    let (references, _) = collect_references(&walked.fruit, &request, &walked.analysis);
    let axis = walked.analysis.axis.as_ref().ok_or("There is no axis.")?;
    let error = |reference: &AxisEstimate| {
        let degrees = axis_error_rad(axis, reference).to_degrees();
        (reference.source.clone(), degrees)
    };
    Ok(references.iter().map(error).collect())
}
