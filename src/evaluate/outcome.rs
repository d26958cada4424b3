//! The comparison of one cloud with all of its references at once.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::{
    ErrorBreakdown, Examination, Row, TruthChoice, examine_file, peduncle_disagreement_deg, reference_of,
};
use crate::fruit::{Fruit, Request};
use crate::method::{Analysis, AxisEstimate, CandidateAxes, Observe, axis_error_rad};
use crate::parallel::Cancelled;

/// A reference axis of a cloud, and the error against it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct KnownAxis {
    /// Its origin, as in [`Row::truth`].
    pub name: String,
    /// Its direction.
    pub direction: [f64; 3],
    /// The angle to it from the computed axis, 0 to 90 degrees.
    pub error_deg: Option<f64>,
    /// The parts of that error.
    pub error_parts: Option<ErrorBreakdown>,
}

/// The result of one cloud against each of its reference axes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// The row against [`TruthChoice::Auto`].
    row: Row,
    peduncle: Option<KnownAxis>,
    #[serde(default)]
    peduncle_direction: Option<KnownAxis>,
    truth: Option<KnownAxis>,
    manual: Option<KnownAxis>,
}

impl Outcome {
    /// Creates the outcome of a cloud that could not be read or analyzed.
    pub fn failed(file: &str, failure: String) -> Self {
        Self {
            row: Row::failed(file, failure),
            peduncle: None,
            peduncle_direction: None,
            truth: None,
            manual: None,
        }
    }

    /// Creates the outcome of an analyzed cloud.
    pub fn of(file: &str, examined: &Examination) -> Self {
        let Examination {
            fruit,
            analysis,
            references,
            warnings,
            at_true_center,
            ..
        } = examined;
        let given = at_true_center.as_ref();
        Self::of_parts(file, fruit, analysis, given, references, warnings)
    }

    /// Creates the same outcome as [`Outcome::of`] from the fields of an [`Examination`].
    pub fn of_parts(
        file: &str,
        fruit: &Fruit,
        analysis: &Analysis,
        at_true_center: Option<&Analysis>,
        references: &[AxisEstimate],
        warnings: &[String],
    ) -> Self {
        let used = analysis.surface.len();
        let axis = analysis.axis.as_ref();
        let (computed, given) = (
            CandidateAxes::new(analysis),
            at_true_center.map(CandidateAxes::new),
        );
        let known = |choice| {
            reference_of(references, choice).map(|reference| KnownAxis {
                name: reference.source.name().into_owned(),
                direction: reference.direction.to_array(),
                error_deg: axis.map(|axis| axis_error_rad(axis, reference).to_degrees()),
                error_parts: ErrorBreakdown::new(fruit, &computed, given.as_ref(), reference),
            })
        };
        let (peduncle, truth) = (known(TruthChoice::Peduncle), known(TruthChoice::Truth));
        let (peduncle_direction, manual) =
            (known(TruthChoice::PeduncleDirection), known(TruthChoice::Manual));
        let error = |known: &Option<KnownAxis>| known.as_ref().and_then(|k| k.error_deg);
        let best = analysis.best.ok();
        let partners = best.and_then(|b| {
            let index = analysis.planes.grid.index_of(b.candidate.g, b.candidate.h)?;
            Some(analysis.planes.terms[index].partners)
        });
        let annotators: Vec<&str> = fruit.annotations.iter().map(|a| a.annotator.as_str()).collect();
        let row = Row {
            sha256: Some(fruit.file.sha256.clone()),
            points: Some(fruit.cloud().len() as u64),
            used_points: Some(used as u64),
            unit: Some(fruit.unit),
            center: Some(analysis.center.to_array()),
            best: best.map(|b| [b.candidate.g as u64, b.candidate.h as u64]),
            score_cm: best.map(|b| b.score_cm),
            runner_up_score_cm: best.and_then(|b| b.runner_up).map(|(_, score)| score),
            lead: best.and_then(|b| b.lead()),
            partner_fraction: partners.map(|p| p as f64 / used as f64),
            axis: axis.map(|a| a.direction.to_array()),
            peduncle_error_deg: error(&peduncle),
            peduncle_direction_error_deg: error(&peduncle_direction),
            peduncle_disagreement_deg: peduncle_disagreement_deg(references),
            true_axis_error_deg: error(&truth),
            manual_error_deg: error(&manual),
            coverage: fruit.truth.as_ref().and_then(|truth| truth.coverage),
            annotators: annotators.join(", "),
            warnings: warnings.join(" "),
            failure: None,
            ..Row::failed(file, String::new())
        };
        let mut outcome = Self {
            row,
            peduncle,
            peduncle_direction,
            truth,
            manual,
        };
        outcome.row = outcome.against(TruthChoice::Auto);
        outcome
    }

    /// Reads and analyzes the cloud at `path`. Whatever is wrong with it is in its row.
    ///
    /// # Errors
    /// Returns an error if the observer cancels the work.
    pub fn of_file(
        file: &str,
        path: &Path,
        request: &Request,
        observe: &dyn Observe,
    ) -> Result<(Self, Option<Examination>), Cancelled> {
        match examine_file(path, request, observe)? {
            Ok(examined) => {
                let examined = examined.with_true_center(observe)?;
                Ok((Self::of(file, &examined), Some(examined)))
            }
            Err(reason) => Ok((Self::failed(file, reason), None)),
        }
    }

    /// Returns the row against [`TruthChoice::Auto`].
    pub fn row(&self) -> &Row {
        &self.row
    }

    /// Returns the outcome with another file name in its row.
    #[must_use]
    pub fn named(mut self, file: &str) -> Self {
        file.clone_into(&mut self.row.file);
        self
    }

    /// Adds a sentence to the warnings of the row.
    pub(super) fn add_warning(&mut self, sentence: &str) {
        self.row.warnings.push(' ');
        self.row.warnings.push_str(sentence);
    }

    /// Returns the chosen reference, if it is known.
    pub fn reference(&self, choice: TruthChoice) -> Option<&KnownAxis> {
        match choice {
            TruthChoice::Peduncle => self.peduncle.as_ref(),
            TruthChoice::PeduncleDirection => self.peduncle_direction.as_ref(),
            TruthChoice::Truth => self.truth.as_ref(),
            TruthChoice::Manual => self.manual.as_ref(),
            TruthChoice::Auto => {
                let known = self.truth.as_ref().or(self.manual.as_ref());
                known.or(self.peduncle.as_ref())
            }
        }
    }

    /// Returns the error in degrees against the chosen reference, if there is one.
    pub fn error_deg(&self, choice: TruthChoice) -> Option<f64> {
        self.reference(choice)?.error_deg
    }

    /// Returns the reason, as a clause, why there is no such error; `None` if there is one.
    pub fn failure(&self, choice: TruthChoice) -> Option<&str> {
        if self.row.sha256.is_none() {
            return self.row.failure.as_deref();
        }
        match (self.row.axis, self.reference(choice)) {
            (None, _) => Some("there is no symmetry axis"),
            (_, None) => Some("there is no reference axis"),
            _ => None,
        }
    }

    /// Returns the row against the chosen reference.
    pub fn against(&self, choice: TruthChoice) -> Row {
        let reference = self.reference(choice);
        Row {
            truth: reference.map(|r| r.name.clone()),
            truth_axis: reference.map(|r| r.direction),
            error_deg: reference.and_then(|r| r.error_deg),
            error_parts: reference.and_then(|r| r.error_parts.clone()),
            failure: self.failure(choice).map(str::to_owned),
            ..self.row.clone()
        }
    }
}
