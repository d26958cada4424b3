//! The open clouds as a set in the window: table, charts, gallery and sweep, driven by labels and keys.

mod charts;
mod gallery;
mod sweep;
mod table;

use std::path::Path;

use crate::helpers::in_window::{Windowed, apply, compare, press, settle, window_of};
use crate::helpers::peppers::write_peppers;
use axiscope::app::many::ManyCommand;
use axiscope::app::{Command, Session};
use axiscope::evaluate::CloudTags;
use tempfile::TempDir;

/// A window on a folder of nine peppers and a file that is none, evaluated; two are tagged.
fn window_on_peppers() -> (TempDir, Windowed) {
    let dir = TempDir::new().expect("a folder");
    write_peppers(dir.path(), 9);
    std::fs::write(dir.path().join("broken.ply"), "ply\nformat ascii 1.0\n").expect("written");
    let mut harness = window_on(dir.path(), [1360.0, 860.0], 1.0);
    tag(&mut harness, 3, "leaf in front", "Seen from below");
    tag(&mut harness, 7, "stem hidden, leaf in front", "");
    apply(&mut harness, Command::Show(3));
    // It names the folder, which is another one each time.
    for message in harness.state().app().state().messages.clone() {
        apply(&mut harness, Command::Dismiss(message.id));
    }
    (dir, harness)
}

fn tag(harness: &mut Windowed, place: usize, tags: &str, note: &str) {
    let tagged = CloudTags {
        note: note.into(),
        ..CloudTags::default().with_tags(tags)
    };
    apply(harness, Command::Many(ManyCommand::Tag { place, tagged }));
}

fn window_on(folder: &Path, size: [f32; 2], pixels_per_point: f32) -> Windowed {
    window_of(Session::first(), vec![folder.to_owned()], size, pixels_per_point)
}

fn snapshot(harness: &mut Windowed, name: &str) {
    harness.remove_cursor();
    settle(harness);
    compare(harness, "screenshots/folder", name);
}

/// The name of the cloud that is shown.
fn current(harness: &Windowed) -> String {
    let source = harness.state().app().state().source();
    source.map(axiscope::app::Source::name).unwrap_or_default()
}
