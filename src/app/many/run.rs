//! The clouds of the list, one after another in the background: from the cache where they have not
//! changed, else read and analyzed, on threads of their own that wait while the current cloud is worked on.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::Sender;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::cache::{Cache, Hash, params_hash, read_hash, row_key};
use crate::app::workers::JobWatch;
use crate::evaluate::Outcome;
use crate::fruit::ReadErrorKind;
use crate::fruit::{AxisFiles, Request, files_behind};
use crate::method::Observe;
use crate::parallel::{Crew, Watch};

/// What is longer in the way than this is not waited for.
const PATIENCE: Duration = Duration::from_secs(20);

/// What the background needs and shares.
#[derive(Clone)]
pub(super) struct Background {
    pub(super) cache: Arc<Mutex<Cache>>,
    /// Whether the current cloud is being worked on.
    pub(super) is_in_the_way: Arc<AtomicBool>,
}

impl Background {
    pub(super) fn cache(&self) -> MutexGuard<'_, Cache> {
        self.cache.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Waits while the current cloud is being worked on; else as the job's own watch.
pub(super) struct Polite<'a> {
    pub(super) watch: &'a JobWatch,
    pub(super) background: &'a Background,
}

impl Watch for Polite<'_> {
    fn is_cancelled(&self) -> bool {
        let began = Instant::now();
        while self.background.is_in_the_way.load(Ordering::Relaxed)
            && !self.watch.is_cancelled()
            && began.elapsed() < PATIENCE
        {
            std::thread::sleep(Duration::from_millis(4));
        }
        self.watch.is_cancelled()
    }
}

impl Observe for Polite<'_> {}

/// Something that a run has to tell.
#[derive(Debug)]
pub(super) struct Found {
    /// Which run tells it.
    pub(super) turn: u64,
    pub(super) path: PathBuf,
    /// `None` where the cache has nothing and nothing is to be worked out.
    pub(super) outcome: Option<Arc<Outcome>>,
    /// Whether it came from the cache.
    pub(super) was_kept: bool,
}

/// What is asked of a run.
pub(super) struct Task {
    pub(super) turn: u64,
    pub(super) clouds: Vec<PathBuf>,
    pub(super) request: Request,
    /// Nothing is read: only what the cache knows is wanted.
    pub(super) only_kept: bool,
}

/// Runs; each cloud's result goes to `found`.
pub(super) fn run(
    task: &Task,
    background: &Background,
    crew: &Crew,
    watch: &JobWatch,
    found: &Sender<Found>,
) {
    let params = params_hash(&task.request);
    let annotations = annotations_of(&task.clouds);
    let next = AtomicUsize::new(0);
    let polite = Polite { watch, background };
    let work = || {
        loop {
            let place = next.fetch_add(1, Ordering::Relaxed);
            let Some(path) = task.clouds.get(place) else {
                return;
            };
            if watch.is_cancelled() || (!task.only_kept && polite.is_cancelled()) {
                return;
            }
            let of_cloud = annotations.get(path).map_or(&[][..], Vec::as_slice);
            let Some(one) = one(task, path, of_cloud, &params, background, &polite) else {
                return;
            };
            // Nobody listens any more where the window has closed.
            let _ = found.send(one);
        }
    };
    if task.only_kept {
        work();
    } else {
        crew.each(work);
    }
}

/// The annotators' files of all clouds, each folder read once.
pub(super) fn annotations_of(clouds: &[PathBuf]) -> HashMap<PathBuf, Vec<PathBuf>> {
    let mut files = AxisFiles::default();
    let mut of = |cloud: &PathBuf| {
        let paths: Vec<PathBuf> = files.of(cloud).into_iter().map(|file| file.path).collect();
        (!paths.is_empty()).then(|| (cloud.clone(), paths))
    };
    clouds.iter().filter_map(&mut of).collect()
}

/// One cloud; `None` where the work was called off.
fn one(
    task: &Task,
    path: &Path,
    annotations: &[PathBuf],
    params: &str,
    background: &Background,
    polite: &Polite<'_>,
) -> Option<Found> {
    let tell = |outcome, was_kept| {
        Some(Found {
            turn: task.turn,
            path: path.to_owned(),
            outcome,
            was_kept,
        })
    };
    let name = name_of(path);
    let files = files_behind(path, &task.request, annotations);
    let mut hashes = Vec::with_capacity(files.len());
    for (place, file) in files.iter().enumerate() {
        let known = background.cache().known_hash(file);
        let hash = match known {
            Hash::Known(None) if place == 0 => {
                // Why it cannot be read, reading tells.
                return if task.only_kept {
                    tell(None, false)
                } else {
                    tell(Some(Arc::new(unreadable(&name, path))), false)
                };
            }
            Hash::Known(hash) => hash,
            Hash::Unread if task.only_kept => return tell(None, false),
            Hash::Unread => match read_hash(file) {
                Some(read) => {
                    background.cache().learn(file, &read);
                    Some(read.sha256)
                }
                None if place == 0 => return tell(Some(Arc::new(unreadable(&name, path))), false),
                None => None,
            },
        };
        hashes.push(hash);
    }
    let key = row_key(&hashes);
    let kept = background.cache().row(params, &key);
    if let Some(outcome) = kept {
        let outcome = if outcome.row().file == name {
            outcome
        } else {
            Arc::new((*outcome).clone().named(&name))
        };
        return tell(Some(outcome), true);
    }
    if task.only_kept {
        return tell(None, false);
    }
    // A fault in one cloud is not the end of the others.
    let worked = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
        Outcome::of_file(&name, path, &task.request, polite)
    }));
    let outcome = match worked {
        Ok(Ok((outcome, _))) => Arc::new(outcome),
        Ok(Err(_)) => return None,
        Err(_) => {
            let why = "the analysis broke off by a fault of the program".to_owned();
            return tell(Some(Arc::new(Outcome::failed(&name, why))), false);
        }
    };
    // What changed while it was read belongs under another key.
    let is_same = outcome
        .row()
        .sha256
        .as_ref()
        .is_none_or(|sha256| hashes[0].as_ref() == Some(sha256));
    if is_same {
        background.cache().keep(params, &key, &outcome);
    }
    tell(Some(outcome), false)
}

fn unreadable(name: &str, path: &Path) -> Outcome {
    let why = match std::fs::metadata(path) {
        Ok(metadata) if metadata.is_dir() => ReadErrorKind::Folder,
        Ok(metadata) if !metadata.is_file() => ReadErrorKind::NotRegular,
        Ok(_) => match std::fs::File::open(path) {
            Err(error) => error.into(),
            Ok(_) => ReadErrorKind::NotRegular,
        },
        Err(error) => error.into(),
    };
    Outcome::failed(name, why.to_string())
}

pub(super) fn name_of(path: &Path) -> String {
    let name = path.file_name().unwrap_or(path.as_os_str());
    name.to_string_lossy().into_owned()
}
