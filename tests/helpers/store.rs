//! An annotator's store on a disk in memory, and what is said there.

use std::path::{Path, PathBuf};

use axiscope::annotate::{Author, CloudId, Confidence, Ends, Judgment, Store};
use axiscope::geometry::Unit;
use glam::DVec3;

use super::disk::Disk;

pub const NOW: &str = "2026-03-01T12:00:00Z";

pub fn id() -> CloudId {
    CloudId {
        file: "fruit.ply".into(),
        sha256: "ab".repeat(32),
    }
}

pub fn ada() -> Author {
    Author::annotator("Ada").unwrap()
}

pub fn cloud() -> &'static Path {
    Path::new("set/fruit.ply")
}

pub fn axis_path(copy: u32) -> PathBuf {
    ada().axis_path(cloud(), copy)
}

pub fn open(disk: &Disk) -> Store {
    let (store, writable) = Store::open(Box::new(disk.clone()), cloud(), id(), Unit::Meter, ada()).unwrap();
    writable.unwrap();
    store
}

/// An axis that is told from others by its length.
pub fn judgment(length: f64) -> Judgment {
    let ends = Ends::new(DVec3::new(0.1, -0.2, 0.5), DVec3::new(0.1, -0.2 + length, 0.5)).unwrap();
    Judgment {
        confidence: Confidence::new(0.7),
        note: "a \"note\"\nof two lines, with ü".into(),
        ..Judgment::by_hand(ends)
    }
}
