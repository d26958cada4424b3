//! One cloud, analyzed and compared with every reference that is known of it.

use crate::annotate::{Role, estimates};
use crate::fruit::{Fruit, Request};
use crate::method::{Analysis, AnalysisError, AxisEstimate, AxisSource, Observe, Stages, axis_error_rad};
use crate::text::sentence;
use serde::{Deserialize, Serialize};

/// Which reference an error is measured against.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum TruthChoice {
    /// The simulator's truth where there is one, else the annotators', else the peduncle's.
    Auto,
    /// The peduncle's axis (§ 3.2).
    Peduncle,
    /// The peduncle's own direction.
    PeduncleDirection,
    /// The axis that was set by hand: the adjudicated one where there is one, else the mean of the
    /// annotators'.
    Manual,
    /// The axis in `NAME.truth.json`.
    Truth,
}

/// A cloud's analysis and its references.
#[derive(Debug, Clone)]
pub struct Examined {
    /// The cloud.
    pub fruit: Fruit,
    /// Its analysis.
    pub analysis: Analysis,
    /// The axes to compare with, the peduncle's first.
    pub references: Vec<AxisEstimate>,
    /// What the reader ought to know: the file's warnings, then the method's. Sentences.
    pub warnings: Vec<String>,
    /// The stages of the analysis, for others of the same cloud.
    pub(super) stages: Stages,
}

/// Analyzes a fruit as asked, and gathers its references.
///
/// # Errors
/// Where the cloud cannot be analyzed, or the watcher calls the work off.
pub fn examine(fruit: Fruit, request: &Request, observe: &dyn Observe) -> Result<Examined, AnalysisError> {
    let mut stages = Stages::new(if request.without_peduncle {
        fruit.body()
    } else {
        fruit.cloud().clone()
    });
    let analysis = stages.analyze(&request.params(&fruit), observe)?;
    let (references, warnings) = compared(&fruit, request, &analysis);
    Ok(Examined {
        fruit,
        analysis,
        references,
        warnings,
        stages,
    })
}

/// The axes that an analysis can be compared with, the peduncle's first, and what the reader ought to
/// know: the file's warnings, then the method's, as sentences.
pub fn compared(fruit: &Fruit, request: &Request, analysis: &Analysis) -> (Vec<AxisEstimate>, Vec<String>) {
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

/// The reference that `choice` asks for, if it is there.
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

/// How far the peduncle's two references are apart, in degrees; `None` where there are not both. Where it
/// is much, an error against one of them says little of the method.
pub fn peduncle_disagreement_deg(references: &[AxisEstimate]) -> Option<f64> {
    let first = reference_of(references, TruthChoice::Peduncle)?;
    let second = reference_of(references, TruthChoice::PeduncleDirection)?;
    Some(axis_error_rad(first, second).to_degrees())
}
