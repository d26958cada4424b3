//! The paper's two experiments on one cloud, side by side: with the peduncle and without it.

use crate::app::App;
use crate::app::inspector::stages::{AnalyzeError, FruitStages, Source};
use crate::evaluate::collect_references;
use crate::fruit::Request;
use crate::method::AxisSource;
use crate::method::axis_error_rad;
use crate::parallel::Watch as _;
use crate::text::sentence;

/// The axis' error against each reference in degrees, or why there is no axis.
pub type Errors = Result<Vec<(AxisSource, f64)>, String>;

/// What both analyses came to.
#[derive(Debug, Clone, PartialEq)]
pub struct Beside {
    /// With the peduncle's points.
    pub with: Errors,
    /// Without them.
    pub without: Errors,
    key: Key,
}

/// What both are computed from.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::app) struct Key {
    source: Source,
    /// Whether the peduncle is left out is set aside.
    request: Request,
    turn: u64,
}

impl App {
    pub(in crate::app) fn update_beside(&mut self) {
        if let Some(result) = self.peduncle.besides.take() {
            match result {
                Ok(beside) => self.state.peduncle.beside = beside,
                Err(crash) => self.say(true, format!("The comparison broke off by {crash}.")),
            }
        }
        let key = self.state.source().cloned().map(|source| Key {
            source,
            request: Request {
                without_peduncle: false,
                ..self.state.settings.request.clone()
            },
            turn: self.turn,
        });
        if self.state.peduncle.beside.as_ref().map(|b| &b.key) != key.as_ref() {
            self.state.peduncle.beside = None;
        }
        let is_settled = self.state.current_walked().is_some() && !self.state.is_stale;
        let wanted = key.filter(|_| self.state.peduncle.wants_beside && is_settled);
        if wanted.is_none() || self.peduncle.asked_beside == wanted {
            return;
        }
        self.peduncle.asked_beside.clone_from(&wanted);
        let Some(key) = wanted else { return };
        let mut stages = self.stages.clone();
        self.peduncle.besides.submit(move |watch| {
            let mut of = |without_peduncle: bool| {
                let request = Request {
                    without_peduncle,
                    ..key.request.clone()
                };
                errors(&mut stages, &key.source, &request, watch)
            };
            let (with, without) = (of(false), of(true));
            (!watch.is_cancelled()).then_some(Beside { with, without, key })
        });
    }
}

fn errors(
    stages: &mut FruitStages,
    source: &Source,
    request: &Request,
    watch: &crate::app::workers::JobWatch,
) -> Errors {
    let walked = stages
        .analyze(source, request, watch, &|_, _| {})
        .map_err(|error| match error {
            AnalyzeError::Fruit(error) => sentence(&error.reason()),
            AnalyzeError::Analysis { error, .. } => sentence(&error.to_string()),
            AnalyzeError::Cancelled => "It was called off.".into(),
        })?;
    let (references, _) = collect_references(&walked.fruit, request, &walked.analysis);
    let axis = walked.analysis.axis.as_ref().ok_or("There is no axis.")?;
    let error = |reference: &crate::method::AxisEstimate| {
        let degrees = axis_error_rad(axis, reference).to_degrees();
        (reference.source.clone(), degrees)
    };
    Ok(references.iter().map(error).collect())
}
