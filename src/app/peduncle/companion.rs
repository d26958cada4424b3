//! The companion: the peduncle's points as a file of their own beside the cloud, where the command line
//! finds them.

use std::path::PathBuf;
use std::sync::Arc;

use super::state::Saved;
use crate::annotate::DiskFiles;
use crate::annotate::Files as _;
use crate::fruit::{Fruit, companion_path};
use crate::geometry::PointSet;
use crate::ply::{Precision, WriteError, WriteOptions, write};

/// The outcome of writing or comparing a companion.
pub(in crate::app) enum Outcome {
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

/// Compares the companion that lies beside a cloud with the points that an earlier session picked.
pub(super) fn compared(fruit: &Fruit, points: Arc<PointSet>) -> Outcome {
    let path = companion_path(&fruit.file.path);
    let there = std::fs::read(&path);
    if !there.is_ok_and(|there| companion_bytes(fruit, &points).is_ok_and(|b| b == there)) {
        return Outcome::Unknown;
    }
    Outcome::Known(saved(path, fruit, points))
}

fn saved(path: PathBuf, fruit: &Fruit, points: Arc<PointSet>) -> Saved {
    Saved {
        path,
        sha256: fruit.file.sha256.clone(),
        points,
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

/// Writes the companion to `path`. What is there already stays, unless it may be replaced.
pub(super) fn written(fruit: &Fruit, points: Arc<PointSet>, path: PathBuf, replaces: bool) -> Outcome {
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
        return Outcome::Exists(path);
    };
    match done {
        Ok(()) => Outcome::Done(saved(path, fruit, points)),
        Err(why) => Outcome::Failed(format!(
            "{}: the peduncle was not saved ({why}). What was picked is still here; save it elsewhere.",
            path.display()
        )),
    }
}
