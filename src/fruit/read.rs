//! A fruit from its files: the cloud, its unit, and its peduncle.

use serde::{Deserialize, Serialize};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::{
    AxisFiles, CloudFile, PickedPoints, ReadError, Request, read_annotations, read_cloud, read_cloud_watched,
    unit_guess,
};
use crate::annotate::Annotation;
use crate::files::read_regular;
use crate::geometry::{Cloud, Unit};
use crate::parallel::Watch;
use crate::peduncle::{HueRange, Peduncle, PeduncleError, PeduncleSource};
use crate::simulate::Truth;

/// The source of the peduncle.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub enum PeduncleChoice {
    /// Labels in the file, else a companion file, else none.
    #[default]
    Auto,
    /// No source: the fruit has no peduncle.
    None,
    /// The file's labels.
    Label,
    /// A separate file.
    File(PathBuf),
    /// A folder with the same cloud, under the same name, from which the peduncle was removed.
    Removed(PathBuf),
    /// The points of a color.
    Hue(HueRange),
    /// The points that were picked by hand; [`PeduncleChoice::Auto`] for a cloud without any.
    Points(PickedPoints),
}

/// A fruit as its files describe it.
#[derive(Debug, Clone)]
pub struct Fruit {
    /// The file and its cloud.
    pub file: Arc<CloudFile>,
    /// The unit of its coordinates.
    pub unit: Unit,
    /// Its peduncle, if it has one.
    pub peduncle: Option<Peduncle>,
    /// The simulator's truth about it, from `NAME.truth.json` beside the cloud; in the cloud's unit.
    pub truth: Option<Truth>,
    /// The reason, a sentence, why [`Fruit::from_file_lenient`] found no peduncle.
    pub peduncle_problem: Option<String>,
    /// The annotators' axes, from `NAME.ANNOTATOR.axis.json` beside the cloud.
    pub annotations: Vec<Annotation>,
    /// Warnings about the files, one sentence each.
    pub warnings: Vec<String>,
}

/// The reason why a fruit's files could not be used. One sentence that names the file.
#[derive(Debug, thiserror::Error)]
pub enum FruitError {
    /// A file could not be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The peduncle was not found in the requested source.
    #[error("{}: {error}", path.display())]
    Peduncle {
        /// The cloud's file.
        path: PathBuf,
        /// The reason.
        error: PeduncleError,
    },
}

impl FruitError {
    /// The cause without the file's name, for a list that names it already.
    pub fn reason(&self) -> String {
        match self {
            Self::Read(error) => error.kind.to_string(),
            Self::Peduncle { error, .. } => error.to_string(),
        }
    }
}

impl Fruit {
    /// Reads a cloud with the request's unit (`None`: as stated in the file, or else guessed), and finds its peduncle in
    /// the request's source.
    ///
    /// # Errors
    /// Returns an error if a file cannot be read, or if the peduncle is not found in its source.
    pub fn read(path: &Path, request: &Request) -> Result<Self, FruitError> {
        Self::read_watched(path, request, &())
    }

    /// [`Fruit::read`] with its progress reported to `watch`.
    ///
    /// # Errors
    /// Returns the errors of [`Fruit::read`], and an error if the watch calls the work off.
    pub fn read_watched(path: &Path, request: &Request, watch: &dyn Watch) -> Result<Self, FruitError> {
        let file = read_cloud_watched(path, watch)?;
        Self::from_file(Arc::new(file), request.unit, &request.peduncle)
    }

    fn from_file(
        file: Arc<CloudFile>,
        unit: Option<Unit>,
        choice: &PeduncleChoice,
    ) -> Result<Self, FruitError> {
        let peduncle = find_peduncle(&file, choice)?;
        Ok(Self::with_peduncle(file, unit, peduncle))
    }

    fn with_peduncle(file: Arc<CloudFile>, unit: Option<Unit>, peduncle: Option<Peduncle>) -> Self {
        let path = &file.path;
        let mut warnings: Vec<String> = file.ply.notes.iter().map(|note| format!("{note}.")).collect();
        let dropped = file.ply.dropped_not_finite;
        if dropped > 0 {
            warnings.push(format!(
                "{dropped} points were left out, since their coordinates are not finite."
            ));
        }
        let stated = unit.or(file.ply.stated_unit);
        let (unit, _, doubt) = unit_guess::resolve(&file.ply.cloud, stated);
        warnings.extend(doubt);
        let truth = match read_truth(&truth_path(path)) {
            Ok(truth) => truth.map(|truth| truth.in_unit(unit)),
            Err(problem) => {
                warnings.push(problem);
                None
            }
        };
        let (annotations, unusable) = read_annotations(&AxisFiles::default().of(path), &file.sha256);
        warnings.extend(unusable);
        Self {
            file,
            unit,
            peduncle,
            truth,
            peduncle_problem: None,
            annotations,
            warnings,
        }
    }

    /// [`Fruit::read`] for a cloud that was read before, which gives a fruit without a peduncle if it is not found in its
    /// source; [`Fruit::peduncle_problem`] tells the reason. So the window shows the cloud while a range of hues or a path is
    /// still being entered.
    pub fn from_file_lenient(file: &Arc<CloudFile>, unit: Option<Unit>, choice: &PeduncleChoice) -> Self {
        Self::from_file(file.clone(), unit, choice).unwrap_or_else(|error| {
            let problem = format!("{error}.");
            let mut fruit = Self::with_peduncle(file.clone(), unit, None);
            fruit
                .warnings
                .push(format!("The peduncle was not found as asked. {problem}"));
            fruit.peduncle_problem = Some(problem);
            fruit
        })
    }

    /// The fruit with the simulator's truth, given as the text of a truth file.
    #[must_use]
    pub fn with_truth(mut self, name: &Path, text: &str) -> Self {
        match parse_truth(name, text) {
            Ok(truth) => self.truth = Some(truth.in_unit(self.unit)),
            Err(problem) => self.warnings.push(problem),
        }
        self
    }

    /// The file's cloud.
    pub fn cloud(&self) -> &Cloud {
        &self.file.ply.cloud
    }

    /// Labels of the cloud's points that name the peduncle as it was found; `None` if the file's own labels name it,
    /// or there is none.
    pub fn labels_by_peduncle(&self) -> Option<Vec<i32>> {
        let peduncle = self.peduncle.as_ref()?;
        if peduncle.source == PeduncleSource::Label {
            return None;
        }
        let cloud = self.cloud();
        // Points that the file alone calls peduncle belong to the fruit.
        let in_file = |i: usize| match cloud.labels().map(|labels| labels[i]) {
            None | Some(Cloud::PEDUNCLE) => Cloud::FRUIT,
            Some(other) => other,
        };
        let mut labels: Vec<i32> = (0..cloud.len()).map(in_file).collect();
        for &i in &peduncle.in_cloud {
            labels[i] = Cloud::PEDUNCLE;
        }
        Some(labels)
    }

    /// The cloud without the peduncle's points; the whole cloud if there are none.
    pub fn body(&self) -> Cloud {
        match &self.peduncle {
            Some(peduncle) => peduncle.removed_from(self.cloud()),
            None => self.cloud().clone(),
        }
    }
}

/// The path of a cloud's separate peduncle file: `NAME_peduncle.ply` beside `NAME.ply`.
pub fn companion_path(path: &Path) -> PathBuf {
    let mut name = path.file_stem().unwrap_or_default().to_os_string();
    name.push("_peduncle.ply");
    path.with_file_name(name)
}

/// The path of the simulator's truth about a cloud: `NAME.truth.json` beside `NAME.ply`.
pub fn truth_path(path: &Path) -> PathBuf {
    path.with_extension("truth.json")
}

/// The path of the cloud without its peduncle: the file of the same name in another folder.
pub fn removed_path(path: &Path, folder: &Path) -> PathBuf {
    folder.join(path.file_name().unwrap_or_default())
}

/// The longest truth file that is read, in bytes. Ours have some thousand.
const LONGEST_TRUTH: u64 = 1 << 20;

/// The content of a truth file; `None` if there is no file. The error is a sentence.
fn read_truth(path: &Path) -> Result<Option<Truth>, String> {
    let text = match read_regular(path, LONGEST_TRUTH) {
        Ok(text) => text,
        // A name that is too long is the name of no file.
        Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::InvalidFilename) => {
            return Ok(None);
        }
        Err(error) => return Err(format!("{}: {error}.", path.display())),
    };
    let text = str::from_utf8(&text).map_err(|error| format!("{}: {error}.", path.display()))?;
    parse_truth(path, text).map(Some)
}

fn parse_truth(path: &Path, text: &str) -> Result<Truth, String> {
    let unusable = |why: String| format!("{}: this truth is not used: {why}.", path.display());
    let truth: Truth = serde_json::from_str(text).map_err(|error| unusable(error.to_string()))?;
    if truth.schema == Truth::SCHEMA {
        Ok(truth)
    } else {
        Err(unusable(format!(
            "its schema is {:?}, not {:?}",
            truth.schema,
            Truth::SCHEMA
        )))
    }
}

fn find_peduncle(file: &CloudFile, choice: &PeduncleChoice) -> Result<Option<Peduncle>, FruitError> {
    let (path, cloud) = (&file.path, &file.ply.cloud);
    let by_file = |companion: &Path| {
        Peduncle::by_companion(cloud, &read_cloud(companion)?.ply.cloud).map_err(|error| {
            FruitError::Peduncle {
                path: companion.to_path_buf(),
                error,
            }
        })
    };
    let asked = |found: Result<Peduncle, PeduncleError>| {
        found.map(Some).map_err(|error| FruitError::Peduncle {
            path: path.clone(),
            error,
        })
    };
    match choice {
        PeduncleChoice::None => Ok(None),
        PeduncleChoice::Label => asked(Peduncle::by_label(cloud)),
        PeduncleChoice::Hue(range) => asked(Peduncle::by_hue(cloud, *range)),
        PeduncleChoice::File(companion) => by_file(companion).map(Some),
        PeduncleChoice::Removed(folder) => {
            let body = removed_path(path, folder);
            match Peduncle::by_removal(cloud, &read_cloud(&body)?.ply.cloud) {
                Ok(peduncle) => Ok(Some(peduncle)),
                Err(error) => Err(FruitError::Peduncle { path: body, error }),
            }
        }
        PeduncleChoice::Points(picked) if picked.of(&file.sha256).is_some() => {
            let picked = picked.of(&file.sha256).map(|p| Peduncle::by_points(cloud, p));
            picked.unwrap_or(Ok(None)).map_err(|error| FruitError::Peduncle {
                path: path.clone(),
                error,
            })
        }
        PeduncleChoice::Auto | PeduncleChoice::Points(_) => {
            if let Ok(peduncle) = Peduncle::by_label(cloud) {
                return Ok(Some(peduncle));
            }
            let companion = companion_path(path);
            if companion.is_file() {
                by_file(&companion).map(Some)
            } else {
                Ok(None)
            }
        }
    }
}

impl std::fmt::Display for PeduncleChoice {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::None => f.write_str("none"),
            Self::Label => f.write_str("label"),
            Self::File(path) => write!(f, "{}", path.display()),
            Self::Removed(folder) => write!(f, "removed={}", folder.display()),
            Self::Hue(range) => write!(f, "hue={}..{}", range.from_deg, range.to_deg),
            Self::Points(_) => f.write_str("picked"),
        }
    }
}
