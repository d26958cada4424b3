//! The companion: the peduncle's points as a file of their own beside the cloud, where the command line
//! finds them.

use std::path::PathBuf;
use std::sync::Arc;

use super::{Question, Saved};
use crate::annotate::Files as _;
use crate::app::App;
use crate::app::stages::Source;
use crate::geometry::PointSet;
use crate::io::ply::{Precision, WriteOptions, write};
use crate::io::{DiskFiles, Fruit, companion_path};

/// What came of writing a companion.
pub(in crate::app) enum Written {
    /// It is there.
    Done {
        path: PathBuf,
        sha256: String,
        points: Arc<PointSet>,
    },
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

    pub(in crate::app) fn update_companions(&mut self) {
        let Some((_, result)) = self.peduncle.companions.take() else {
            return;
        };
        match result {
            Ok(Written::Done { path, sha256, points }) => {
                let text = format!(
                    "Saved {} points of the peduncle as {}.",
                    points.len(),
                    path.display()
                );
                self.state.peduncle.saved.retain(|saved| saved.path != path);
                self.state.peduncle.saved.push(Saved { path, sha256, points });
                self.say(false, text);
            }
            Ok(Written::Exists(path)) => self.state.peduncle.question = Some(Question::Replace(path)),
            Ok(Written::Failed(problem)) => self.say(true, problem),
            Err(crash) => self.say(true, format!("Saving the peduncle broke off by {crash}.")),
        }
    }
}

fn written(fruit: &Fruit, points: Arc<PointSet>, path: PathBuf, replaces: bool) -> Written {
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
    let made = write(&mut bytes, &companion, &options).map_err(|error| error.to_string());
    if !replaces && path.exists() {
        // Saved by an earlier session: there is nothing to replace.
        return if made.is_ok() && std::fs::read(&path).is_ok_and(|there| there == bytes) {
            Written::Done {
                path,
                sha256: fruit.file.sha256.clone(),
                points,
            }
        } else {
            Written::Exists(path)
        };
    }
    let done = made.and_then(|()| {
        DiskFiles::default()
            .replace(&path, &bytes)
            .map_err(|e| e.to_string())
    });
    match done {
        Ok(()) => Written::Done {
            path,
            sha256: fruit.file.sha256.clone(),
            points,
        },
        Err(why) => Written::Failed(format!(
            "{}: the peduncle was not saved ({why}). What was picked is still here; save it elsewhere.",
            path.display()
        )),
    }
}
