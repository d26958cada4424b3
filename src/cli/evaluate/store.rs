//! Finished rows on disk, so that a run that was broken off can be resumed.

use std::path::{Path, PathBuf};
use std::sync::Mutex;

use anyhow::Context;
use axiscope::evaluate::{Outcome, Row, SweepSettings, TruthChoice, sweep_cloud};
use axiscope::fruit::annotation_paths;
use axiscope::fruit::sha256_hex;
use axiscope::fruit::{Request, files_behind};
use axiscope::text::sentence;
use serde::{Deserialize, Serialize};

/// What is kept of one cloud.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Stored {
    pub(super) row: Row,
    /// The error at each setting of the sweep, u-major, in degrees.
    pub(super) sweep_deg: Option<Vec<Option<f64>>>,
}

/// A folder with a file for each finished cloud, under a hash of all that its row follows from: the
/// bytes of its files, the settings, and the program's version.
pub(super) struct Store<'a> {
    folder: PathBuf,
    request: &'a Request,
    choice: TruthChoice,
    sweep: Option<&'a SweepSettings>,
    resume: bool,
    problem: Mutex<Option<std::io::Error>>,
}

impl<'a> Store<'a> {
    /// Opens the store of the output folder.
    pub(super) fn open(
        out: &Path,
        request: &'a Request,
        choice: TruthChoice,
        sweep: Option<&'a SweepSettings>,
        resume: bool,
    ) -> anyhow::Result<Self> {
        let folder = out.join("rows");
        std::fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;
        Ok(Self {
            folder,
            request,
            choice,
            sweep,
            resume,
            problem: Mutex::default(),
        })
    }

    /// The first row that could not be kept, if any.
    pub(super) fn problem(&self) -> Option<std::io::Error> {
        self.problem.lock().ok()?.take()
    }

    /// One cloud's row: kept from an earlier run where that is allowed and it is there, else worked
    /// out and kept. Whatever goes wrong with the cloud is in its row.
    pub(super) fn evaluate(&self, name: &str, path: &Path) -> Stored {
        let key = self.key(name, path);
        if self.resume
            && let Some(stored) = self.find(&key)
        {
            return stored;
        }
        let stored = self.work_out(name, path);
        if let Err(error) = self.keep(&key, &stored)
            && let Ok(mut problem) = self.problem.lock()
        {
            problem.get_or_insert(error);
        }
        stored
    }

    fn key(&self, name: &str, path: &Path) -> String {
        let (request, choice, sweep) = (self.request, self.choice, self.sweep);
        let mut parts = format!(
            "{} {name} {request:?} {choice:?} {sweep:?}",
            env!("CARGO_PKG_VERSION")
        );
        let files = files_behind(path, request, &annotation_paths(path));
        for file in files {
            // Reading a pipe would wait for somebody to write into it.
            let bytes = file.is_file().then(|| std::fs::read(file).ok()).flatten();
            parts.push(' ');
            parts.push_str(&bytes.map_or_else(|| "none".into(), |bytes| sha256_hex(&bytes)));
        }
        sha256_hex(parts.as_bytes())
    }

    fn find(&self, key: &str) -> Option<Stored> {
        let text = std::fs::read_to_string(self.folder.join(format!("{key}.json"))).ok()?;
        serde_json::from_str(&text).ok()
    }

    /// Under a name of its own first: a run that is killed leaves no half of a row.
    fn keep(&self, key: &str, stored: &Stored) -> std::io::Result<()> {
        let part = self.folder.join(format!("{key}.part"));
        std::fs::write(&part, serde_json::to_string(stored)?)?;
        std::fs::rename(&part, self.folder.join(format!("{key}.json")))
    }

    fn work_out(&self, name: &str, path: &Path) -> Stored {
        // Nobody calls it off.
        let (outcome, examined) = Outcome::of_file(name, path, self.request, &())
            .unwrap_or_else(|cancelled| (Outcome::failed(name, cancelled.to_string()), None));
        let mut row = outcome.against(self.choice);
        let Some(examined) = examined else {
            return Stored { row, sweep_deg: None };
        };
        let sweep_deg = self
            .sweep
            .map(|settings| sweep_cloud(&examined, self.choice, settings, &()));
        let sweep_deg = match sweep_deg.transpose() {
            Ok(errors) => errors,
            Err(error) => {
                row.warnings.push(' ');
                row.warnings.push_str(&sentence(&error.to_string()));
                None
            }
        };
        Stored { row, sweep_deg }
    }
}
