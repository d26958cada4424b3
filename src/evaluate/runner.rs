//! The evaluation of clouds one by one: from the store where nothing has changed, else read and analyzed.

use std::collections::HashMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::row_store::{params_key, stable_hash};
use super::{KnownHash, Outcome, RowStore, StoredRow, SweepSettings, TruthChoice, sweep_cloud};
use crate::fruit::{AxisFiles, Request, files_behind};
use crate::method::Observe;
use crate::parallel::Cancelled;
use crate::text::sentence;

/// The use that a run makes of rows that are stored already.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reuse {
    /// Every cloud is analyzed, whatever is stored.
    Never,
    /// Stored rows are taken, and only the other clouds are analyzed.
    WhereStored,
    /// Stored rows are looked up, and nothing is read or analyzed.
    Only,
}

/// A cloud's row, and its origin.
#[derive(Debug, Clone, PartialEq)]
pub struct EvaluatedCloud {
    /// The row.
    pub row: StoredRow,
    /// Whether it was stored before.
    pub was_stored: bool,
}

/// Evaluates clouds under one set of parameters. Any number of threads may use it.
#[derive(Debug)]
pub struct Runner<'a> {
    store: &'a RowStore,
    request: &'a Request,
    sweep: Option<(&'a SweepSettings, TruthChoice)>,
    reuse: Reuse,
    params_key: String,
}

impl<'a> Runner<'a> {
    /// Creates a runner that also sweeps each cloud where settings for that are given.
    pub fn new(
        store: &'a RowStore,
        request: &'a Request,
        sweep: Option<(&'a SweepSettings, TruthChoice)>,
        reuse: Reuse,
    ) -> Self {
        Self {
            store,
            request,
            sweep,
            reuse,
            params_key: params_key(request, sweep),
        }
    }

    /// Evaluates the cloud at `path`, called `file` in its row, with these files of its annotators. Whatever
    /// goes wrong with the cloud is in its row. `None` if the row is not stored and [`Reuse::Only`] was asked.
    ///
    /// # Errors
    /// Returns an error if the observer cancels the work.
    pub fn evaluate(
        &self,
        file: &str,
        path: &Path,
        annotations: &[PathBuf],
        observe: &dyn Observe,
    ) -> Result<Option<EvaluatedCloud>, Cancelled> {
        let Some(hashes) = self.hashes(path, annotations) else {
            return Ok(None);
        };
        let cloud_key = stable_hash(&hashes);
        if self.reuse != Reuse::Never
            && hashes[0].is_some()
            && let Some(mut row) = self.store.get(&self.params_key, &cloud_key)
        {
            if row.outcome.row().file != file {
                row.outcome = Arc::new((*row.outcome).clone().named(file));
            }
            let was_stored = true;
            return Ok(Some(EvaluatedCloud { row, was_stored }));
        }
        if self.reuse == Reuse::Only {
            return Ok(None);
        }
        let row = match evaluate_file(file, path, self.request, self.sweep, observe) {
            Ok(row) => row,
            Err(EvaluateError::Cancelled) => return Err(Cancelled),
            Err(fault @ EvaluateError::Fault) => {
                let outcome = Arc::new(Outcome::failed(file, fault.to_string()));
                let row = StoredRow {
                    outcome,
                    sweep_deg: None,
                };
                let was_stored = false;
                return Ok(Some(EvaluatedCloud { row, was_stored }));
            }
        };
        // A file that changed while it was read has another key.
        let analyzed = row.outcome.row().sha256.as_ref();
        if hashes[0].is_some() && analyzed.is_none_or(|sha256| hashes[0].as_ref() == Some(sha256)) {
            self.store.insert(&self.params_key, cloud_key, row.clone());
        }
        let was_stored = false;
        Ok(Some(EvaluatedCloud { row, was_stored }))
    }

    /// Returns the hashes of the files that the row follows from, the cloud's first; `None` if one would have
    /// to be read for it where nothing is to be read.
    fn hashes(&self, path: &Path, annotations: &[PathBuf]) -> Option<Vec<Option<String>>> {
        let files = files_behind(path, self.request, annotations);
        let hash = |file: &PathBuf| match self.reuse {
            Reuse::Only => match self.store.known_hash(file) {
                KnownHash::Known(hash) => Some(hash),
                KnownHash::Unread => None,
            },
            _ => Some(self.store.hash(file)),
        };
        files.iter().map(hash).collect()
    }
}

/// The reason why a cloud has no row. A clause.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum EvaluateError {
    /// The observer called the work off.
    #[error("cancelled")]
    Cancelled,
    /// The program has a fault, which ends the evaluation of this cloud alone.
    #[error("the analysis broke off by a fault of the program")]
    Fault,
}

impl From<Cancelled> for EvaluateError {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

/// Reads and analyzes one cloud, called `file` in its row, and sweeps it where settings for that are given.
/// Whatever is wrong with the cloud is in its row.
///
/// # Errors
/// Returns an error if the observer cancels the work, or if the analysis panics.
pub fn evaluate_file(
    file: &str,
    path: &Path,
    request: &Request,
    sweep: Option<(&SweepSettings, TruthChoice)>,
    observe: &dyn Observe,
) -> Result<StoredRow, EvaluateError> {
    let work = || {
        let (mut outcome, examined) = Outcome::of_file(file, path, request, observe)?;
        let swept = examined
            .zip(sweep)
            .map(|(examined, (settings, choice))| sweep_cloud(&examined, choice, settings, observe));
        let sweep_deg = match swept.transpose() {
            Ok(errors_deg) => errors_deg,
            Err(error) if error.is_cancelled() => return Err(EvaluateError::Cancelled),
            Err(error) => {
                outcome.add_warning(&sentence(&error.to_string()));
                None
            }
        };
        let outcome = Arc::new(outcome);
        Ok(StoredRow { outcome, sweep_deg })
    };
    catch_unwind(AssertUnwindSafe(work)).unwrap_or(Err(EvaluateError::Fault))
}

/// Lists the annotators' files of each cloud; each folder is read once.
pub fn annotation_files(clouds: &[PathBuf]) -> HashMap<PathBuf, Vec<PathBuf>> {
    let mut files = AxisFiles::default();
    let mut of = |cloud: &PathBuf| {
        let paths: Vec<PathBuf> = files.of(cloud).into_iter().map(|file| file.path).collect();
        (!paths.is_empty()).then(|| (cloud.clone(), paths))
    };
    clouds.iter().filter_map(&mut of).collect()
}
