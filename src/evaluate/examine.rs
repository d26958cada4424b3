//! The analysis of one cloud and its comparison with every known reference axis.

use std::path::Path;

use super::ErrorBreakdown;
use crate::annotate::{Role, estimates};
use crate::fruit::{Fruit, FruitError, ReadErrorKind, Request};
use crate::method::{
    Analysis, AnalysisError, AxisEstimate, AxisSource, CandidateAxes, Observe, Stages, axis_error_rad,
};
use crate::parallel::Cancelled;
use crate::text::sentence;
use serde::{Deserialize, Serialize};

/// A choice among the reference axes of a cloud.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum TruthChoice {
    /// The axis of the simulator if there is one, else the one set by hand, else that of the peduncle.
    Auto,
    /// The line from the fruit center through the mean of the peduncle's points (§ 3.2).
    Peduncle,
    /// The direction in which the peduncle's points are spread most.
    PeduncleDirection,
    /// The axis set by hand: the adjudicated one if there is one, else the mean of the annotators' axes.
    Manual,
    /// The axis of the simulator, from `NAME.truth.json`.
    Truth,
}

impl TruthChoice {
    /// Returns the name of the choice on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Peduncle => "peduncle",
            Self::PeduncleDirection => "peduncle-direction",
            Self::Manual => "manual",
            Self::Truth => "truth",
        }
    }
}

/// A cloud with its analysis and its reference axes.
#[derive(Debug, Clone)]
pub struct Examination {
    /// The cloud.
    pub fruit: Fruit,
    /// Its analysis.
    pub analysis: Analysis,
    /// The known reference axes, that of the peduncle first.
    pub references: Vec<AxisEstimate>,
    /// The warnings of the file, then those of the method, as sentences.
    pub warnings: Vec<String>,
    /// The analysis with the simulator's center given instead of the computed one, once
    /// [`Examination::with_true_center`] has made it.
    pub at_true_center: Option<Analysis>,
    /// The stages of the analysis, for others of the same cloud.
    pub(super) stages: Stages,
}

impl Examination {
    /// Analyzes the cloud once more with its true center given, where the simulator's truth tells it: what the
    /// errors are without that of the center. Takes as long as the plane terms.
    ///
    /// # Errors
    /// Returns an error if the observer cancels the work.
    pub fn with_true_center(mut self, observe: &dyn Observe) -> Result<Self, Cancelled> {
        let Some(truth) = &self.fruit.truth else {
            return Ok(self);
        };
        let params = self.analysis.params.with_center(truth.center);
        self.at_true_center = match self.stages.analyze(&params, observe) {
            Ok(analysis) => Some(analysis),
            Err(error) if error.is_cancelled() => return Err(Cancelled),
            Err(_) => None,
        };
        Ok(self)
    }

    /// Takes the error against a reference axis apart; `None` if the viewpoint is the center.
    pub fn error_breakdown(&self, reference: &AxisEstimate) -> Option<ErrorBreakdown> {
        let given = self.at_true_center.as_ref().map(CandidateAxes::new);
        let computed = CandidateAxes::new(&self.analysis);
        ErrorBreakdown::new(&self.fruit, &computed, given.as_ref(), reference)
    }
}

#[cfg(feature = "window")]
impl Examination {
    /// Returns the cloud as it is drawn: under `name`, and compared with the chosen reference, or else with the first
    /// one.
    pub fn drawn<'a>(&'a self, name: &'a str, choice: TruthChoice) -> crate::view::DrawnCloud<'a> {
        let references = &self.references;
        crate::view::DrawnCloud {
            name,
            cloud: self.fruit.cloud(),
            unit: self.fruit.unit,
            analysis: &self.analysis,
            references,
            reference: reference_of(references, choice).or(references.first()),
        }
    }
}

/// Analyzes a fruit and collects its reference axes.
///
/// # Errors
/// Returns an error if the cloud cannot be analyzed, or the observer cancels the work.
pub fn examine(fruit: Fruit, request: &Request, observe: &dyn Observe) -> Result<Examination, AnalysisError> {
    let mut stages = Stages::new(if request.without_peduncle {
        fruit.body()
    } else {
        fruit.cloud().clone()
    });
    let analysis = stages.analyze(&request.params(&fruit), observe)?;
    let (references, warnings) = collect_references(&fruit, request, &analysis);
    Ok(Examination {
        fruit,
        analysis,
        references,
        warnings,
        at_true_center: None,
        stages,
    })
}

/// Reads and analyzes the cloud at `path`; a clause without the file's name if that is not possible.
///
/// # Errors
/// Returns an error if the observer cancels the work.
pub fn examine_file(
    path: &Path,
    request: &Request,
    observe: &dyn Observe,
) -> Result<Result<Examination, String>, Cancelled> {
    let fruit = match Fruit::read_watched(path, request, observe) {
        Ok(fruit) => fruit,
        Err(FruitError::Read(error)) if matches!(error.kind, ReadErrorKind::Cancelled) => {
            return Err(Cancelled);
        }
        Err(error) => return Ok(Err(error.reason())),
    };
    match examine(fruit, request, observe) {
        Ok(examined) => Ok(Ok(examined)),
        Err(error) if error.is_cancelled() => Err(Cancelled),
        Err(error) => Ok(Err(error.to_string())),
    }
}

/// Collects the reference axes of an analysis, that of the peduncle first, and the warnings: those of the file, then
/// those of the method, as sentences.
pub fn collect_references(
    fruit: &Fruit,
    request: &Request,
    analysis: &Analysis,
) -> (Vec<AxisEstimate>, Vec<String>) {
    let mut warnings = fruit.warnings.clone();
    if request.without_peduncle && fruit.peduncle.is_none() {
        warnings.push("There is no peduncle to leave out: the cloud is analyzed as it stands.".into());
    }
    warnings.extend(analysis.warnings.iter().map(|w| sentence(&w.to_string())));
    let mut references = Vec::new();
    if let Some(peduncle) = &fruit.peduncle {
        for axis in [
            peduncle.reference_axis(analysis.center),
            peduncle.direction_axis(analysis.center),
        ] {
            match axis {
                Ok(axis) => references.push(axis),
                Err(error) => warnings.push(sentence(&error.to_string())),
            }
        }
    }
    if let Some(truth) = &fruit.truth {
        if truth.revolution_axis.is_some() {
            warnings.extend(truth.note.clone());
        }
        references.push(AxisEstimate {
            source: AxisSource::Simulation,
            origin: truth.axis.origin,
            direction: truth.axis.direction,
            confidence: None,
        });
    }
    let by_hand = estimates(&fruit.annotations);
    let decided = fruit.annotations.iter().find(|a| a.role == Role::Adjudicator);
    let has_mean = by_hand
        .iter()
        .any(|a| matches!(a.source, AxisSource::Annotators(_)));
    if decided.is_some_and(|a| a.ends().is_none()) {
        warnings.push("It was decided by hand that this cloud's axis cannot be told.".into());
    } else if !by_hand.is_empty() && !has_mean && decided.is_none() {
        warnings.push("The axes set by hand contradict one another: they have no mean.".into());
    }
    references.extend(by_hand);
    (references, warnings)
}

/// Returns the chosen reference axis, if it is known.
pub fn reference_of(references: &[AxisEstimate], choice: TruthChoice) -> Option<&AxisEstimate> {
    let of = |source: AxisSource| references.iter().find(|axis| axis.source == source);
    let mean = || {
        let is_mean = |axis: &&AxisEstimate| matches!(axis.source, AxisSource::Annotators(_));
        references.iter().find(is_mean)
    };
    let manual = || of(AxisSource::Adjudicated).or_else(mean);
    match choice {
        TruthChoice::Manual => manual(),
        TruthChoice::Peduncle => of(AxisSource::Peduncle),
        TruthChoice::PeduncleDirection => of(AxisSource::PeduncleDirection),
        TruthChoice::Truth => of(AxisSource::Simulation),
        TruthChoice::Auto => of(AxisSource::Simulation)
            .or_else(manual)
            .or_else(|| of(AxisSource::Peduncle)),
    }
}

/// Returns the angle in degrees between the two reference axes of the peduncle; `None` unless both are known. If it is
/// large, an error against either of them says little about the method.
pub fn peduncle_disagreement_deg(references: &[AxisEstimate]) -> Option<f64> {
    let first = reference_of(references, TruthChoice::Peduncle)?;
    let second = reference_of(references, TruthChoice::PeduncleDirection)?;
    Some(axis_error_rad(first, second).to_degrees())
}
