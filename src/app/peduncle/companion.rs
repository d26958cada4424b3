//! The companion: the peduncle's points as a file of their own beside the cloud, where the command line
//! finds them.

use std::path::PathBuf;
use std::sync::Arc;

use super::{Question, Saved};
use crate::annotate::DiskFiles;
use crate::annotate::Files as _;
use crate::app::App;
use crate::app::inspector::stages::Source;
use crate::fruit::{Fruit, companion_path};
use crate::geometry::PointSet;
use crate::ply::{Precision, WriteError, WriteOptions, write};

/// What came of writing a companion.
pub(in crate::app) enum Written {
    /// It is there.
    Done(Saved),
    /// It was there already, from an earlier session; nobody has asked.
    Known(Saved),
    /// There is none, or it holds something else; nobody has asked.
    Unknown,
    /// There was a file already, and nothing was written.
    Exists(PathBuf),
    /// It could not be written. A sentence.
    Failed(String),
}

impl App {
    /// Saves the peduncle; `to` beside the cloud where it is not given, and then without replacing
    /// anything.
    pub(super) fn save_companion(&mut self, to: Option<PathBuf>) {
        let (Some(walked), Some(points)) =
            (self.state.current_walked().cloned(), self.state.peduncle_points())
        else {
            self.say(
                false,
                "There is no analyzed cloud whose peduncle could be saved.".into(),
            );
            return;
        };
        if points.is_empty() {
            self.say(
                false,
                "No point of this cloud belongs to a peduncle yet: there is nothing to save.".into(),
            );
            return;
        }
        if to.is_none() && matches!(self.state.source(), Some(Source::Bundled(_))) {
            self.say(
                false,
                "A sample has no folder of its own: save its peduncle under a name of yours.".into(),
            );
            return;
        }
        let replaces = to.is_some();
        let path = to.unwrap_or_else(|| companion_path(&walked.fruit.file.path));
        self.peduncle
            .companions
            .submit(move |_| written(&walked.fruit, points, path, replaces));
    }

    /// What an earlier session picked may lie in the companion already.
    fn compare_companion(&mut self) {
        let (Some(walked), Some(points)) = (self.state.current_walked(), self.state.picked_peduncle()) else {
            return;
        };
        let sha256 = &walked.fruit.file.sha256;
        if self.peduncle.companions.is_busy() || self.peduncle.compared.contains(sha256) {
            return;
        }
        let (walked, points) = (walked.clone(), points.clone());
        self.peduncle.compared.insert(sha256.clone());
        self.peduncle.companions.submit(move |_| {
            let fruit = &walked.fruit;
            let path = companion_path(&fruit.file.path);
            let there = std::fs::read(&path);
            if !there.is_ok_and(|there| companion_bytes(fruit, &points).is_ok_and(|b| b == there)) {
                return Written::Unknown;
            }
            Written::Known(Saved {
                path,
                sha256: fruit.file.sha256.clone(),
                points,
            })
        });
    }

    fn know(&mut self, saved: Saved) {
        self.state.peduncle.saved.retain(|known| known.path != saved.path);
        self.state.peduncle.saved.push(saved);
    }

    pub(in crate::app) fn update_companions(&mut self) {
        self.compare_companion();
        let Some(result) = self.peduncle.companions.take() else {
            return;
        };
        match result {
            Ok(Written::Done(saved)) => {
                let text = format!(
                    "Saved {} points of the peduncle as {}.",
                    saved.points.len(),
                    saved.path.display()
                );
                self.know(saved);
                self.say(false, text);
            }
            Ok(Written::Known(saved)) => self.know(saved),
            Ok(Written::Unknown) => {}
            Ok(Written::Exists(path)) => self.state.peduncle.question = Some(Question::Replace(path)),
            Ok(Written::Failed(problem)) => self.say(true, problem),
            Err(crash) => self.say(true, format!("Saving the peduncle broke off by {crash}.")),
        }
    }
}

/// The companion's bytes.
fn companion_bytes(fruit: &Fruit, points: &PointSet) -> Result<Vec<u8>, WriteError> {
    let indices: Vec<usize> = points.iter().collect();
    let companion = fruit.cloud().select(&indices);
    let name = fruit.file.path.file_name().unwrap_or_default().to_string_lossy();
    let comments = [format!("the peduncle of {name}")];
    let options = WriteOptions {
        unit: Some(fruit.unit),
        comments: &comments,
        precision: Precision::needed_by(&companion),
        ..WriteOptions::default()
    };
    let mut bytes = Vec::new();
    write(&mut bytes, &companion, &options)?;
    Ok(bytes)
}

fn written(fruit: &Fruit, points: Arc<PointSet>, path: PathBuf, replaces: bool) -> Written {
    let made = companion_bytes(fruit, &points).map_err(|error| error.to_string());
    let done = if replaces || !path.exists() {
        made.and_then(|bytes| {
            let replaced = DiskFiles::default().replace(&path, &bytes);
            replaced.map_err(|error| error.to_string())
        })
    } else if made.is_ok_and(|bytes| std::fs::read(&path).is_ok_and(|there| there == bytes)) {
        // Saved before: there is nothing to replace.
        Ok(())
    } else {
        return Written::Exists(path);
    };
    match done {
        Ok(()) => Written::Done(Saved {
            path,
            sha256: fruit.file.sha256.clone(),
            points,
        }),
        Err(why) => Written::Failed(format!(
            "{}: the peduncle was not saved ({why}). What was picked is still here; save it elsewhere.",
            path.display()
        )),
    }
}
