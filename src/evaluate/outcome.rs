//! One cloud against every reference at once, and the files that its row follows from.

use std::collections::HashMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::{Examined, Request, Row, TruthChoice, examine, peduncle_disagreement_deg, reference_of};
use crate::annotate::axis_file_of;
use crate::io::{Fruit, FruitError, PeduncleChoice, ReadErrorKind, companion_path, removed_path, truth_path};
use crate::method::{Analysis, AxisEstimate, Observe};
use crate::parallel::Cancelled;
use crate::reference::axis_error_rad;

/// A reference axis that is known of a cloud.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct KnownAxis {
    /// Where it comes from, as in [`Row::truth`].
    pub name: String,
    /// Its direction.
    pub direction: [f64; 3],
    /// The angle to it from the computed axis, 0 to 90 degrees.
    pub error_deg: Option<f64>,
}

/// What came of one cloud, measured against each reference that is known of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// Measured against [`TruthChoice::Auto`].
    row: Row,
    peduncle: Option<KnownAxis>,
    #[serde(default)]
    peduncle_direction: Option<KnownAxis>,
    truth: Option<KnownAxis>,
    manual: Option<KnownAxis>,
}

impl Outcome {
    /// Of a cloud that could not be read or analyzed.
    pub fn failed(file: &str, failure: String) -> Self {
        Self {
            row: Row::failed(file, failure),
            peduncle: None,
            peduncle_direction: None,
            truth: None,
            manual: None,
        }
    }

    /// Of a cloud that was examined.
    pub fn of(file: &str, examined: &Examined) -> Self {
        let Examined {
            fruit,
            analysis,
            references,
            warnings,
        } = examined;
        Self::of_parts(file, fruit, analysis, references, warnings)
    }

    /// As [`Outcome::of`], where the parts lie apart.
    pub fn of_parts(
        file: &str,
        fruit: &Fruit,
        analysis: &Analysis,
        references: &[AxisEstimate],
        warnings: &[String],
    ) -> Self {
        let used = analysis.surface.len();
        let axis = analysis.axis.as_ref();
        let known = |choice| {
            reference_of(references, choice).map(|reference| KnownAxis {
                name: reference.source.name().into_owned(),
                direction: reference.direction.to_array(),
                error_deg: axis.map(|axis| axis_error_rad(axis, reference).to_degrees()),
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

    /// Reads and analyzes the cloud at `path`; whatever goes wrong with it is in its row.
    ///
    /// # Errors
    /// Where the work is called off.
    pub fn of_file(
        file: &str,
        path: &Path,
        request: &Request,
        observe: &dyn Observe,
    ) -> Result<(Self, Option<Examined>), Cancelled> {
        let failed = |reason| Ok((Self::failed(file, reason), None));
        let fruit = match Fruit::read_watched(path, request.unit, &request.peduncle, observe) {
            Ok(fruit) => fruit,
            Err(FruitError::Read(error)) if matches!(error.kind, ReadErrorKind::Cancelled) => {
                return Err(Cancelled);
            }
            Err(error) => return failed(error.reason()),
        };
        match examine(fruit, request, observe) {
            Ok(examined) => Ok((Self::of(file, &examined), Some(examined))),
            Err(error) if error.is_cancelled() => Err(Cancelled),
            Err(error) => failed(error.to_string()),
        }
    }

    /// Measured against [`TruthChoice::Auto`].
    pub fn row(&self) -> &Row {
        &self.row
    }

    /// The same, called `file`: what was kept may have had another name.
    #[must_use]
    pub fn named(mut self, file: &str) -> Self {
        file.clone_into(&mut self.row.file);
        self
    }

    /// The reference that `choice` asks for, if it is known.
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

    /// The error in degrees that `choice` asks for.
    pub fn error_deg(&self, choice: TruthChoice) -> Option<f64> {
        self.reference(choice)?.error_deg
    }

    /// Why there is no such error; `None` where there is one.
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

    /// The row, measured against `choice`.
    pub fn against(&self, choice: TruthChoice) -> Row {
        let reference = self.reference(choice);
        Row {
            truth: reference.map(|r| r.name.clone()),
            truth_axis: reference.map(|r| r.direction),
            error_deg: reference.and_then(|r| r.error_deg),
            failure: self.failure(choice).map(str::to_owned),
            ..self.row.clone()
        }
    }
}

/// Every cloud in the folder, by name. A companion that holds a peduncle alone is no cloud of its own.
///
/// # Errors
/// Where the folder cannot be read.
pub fn clouds_in(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut clouds = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let entry = entry?;
        let path = entry.path();
        let is_ply = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("ply"));
        // Only where the folder's own list does not say it is the file asked for.
        if is_ply && (entry.file_type().is_ok_and(|kind| kind.is_file()) || !path.is_dir()) {
            clouds.push(path);
        }
    }
    clouds.sort();
    let companions: std::collections::HashSet<PathBuf> =
        clouds.iter().map(|path| companion_path(path)).collect();
    clouds.retain(|path| !companions.contains(path));
    Ok(clouds)
}

/// The annotators' files of each of the clouds of one folder, which is read once for all of them.
pub fn annotations_in(folder: &Path, clouds: &[PathBuf]) -> HashMap<PathBuf, Vec<PathBuf>> {
    let folder = if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    };
    let Ok(entries) = std::fs::read_dir(folder) else {
        return HashMap::new();
    };
    let is_axis = |name: &OsString| name.to_string_lossy().ends_with(".axis.json");
    let names: Vec<OsString> = entries
        .filter_map(|entry| Some(entry.ok()?.file_name()))
        .filter(is_axis)
        .collect();
    if names.is_empty() {
        return HashMap::new();
    }
    // A cloud's axis files begin with its stem and a dot.
    let mut by_stem: HashMap<String, Vec<&PathBuf>> = HashMap::new();
    for cloud in clouds {
        let stem = cloud.file_stem().unwrap_or_default().to_string_lossy();
        by_stem.entry(stem.into_owned()).or_default().push(cloud);
    }
    let mut found: HashMap<PathBuf, Vec<PathBuf>> = HashMap::new();
    for name in names {
        let text = name.to_string_lossy();
        for (dot, _) in text.match_indices('.') {
            for cloud in by_stem.get(&text[..dot]).into_iter().flatten() {
                if axis_file_of(cloud, &name).is_some() {
                    let paths = found.entry((*cloud).clone()).or_default();
                    paths.push(cloud.with_file_name(&name));
                }
            }
        }
    }
    for paths in found.values_mut() {
        paths.sort();
    }
    found
}

/// The files whose bytes a cloud's row follows from, the cloud's own first; some may not exist.
/// `annotations` are those of its annotators.
pub fn files_behind(path: &Path, request: &Request, annotations: &[PathBuf]) -> Vec<PathBuf> {
    let mut files = vec![path.to_path_buf(), companion_path(path), truth_path(path)];
    match &request.peduncle {
        PeduncleChoice::Removed(folder) => files.push(removed_path(path, folder)),
        PeduncleChoice::File(companion) => files.push(companion.clone()),
        _ => {}
    }
    files.extend_from_slice(annotations);
    files
}
