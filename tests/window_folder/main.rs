//! The open clouds as a set in the window: table, charts, gallery and sweep, driven by labels and keys.

#[path = "../driving/mod.rs"]
mod driving;
#[path = "../peppers/mod.rs"]
mod peppers;

mod charts;
mod gallery;
mod sweep;
mod table;

use std::path::Path;
use std::time::{Duration, Instant};

use axiscope::app::folder::{FolderCommand, Tagged};
use axiscope::app::{Command, Session};
use axiscope::ui::{Start, Window};
use egui::{Key, Modifiers, Vec2};
use egui_kittest::{Harness, SnapshotOptions};
use peppers::write_peppers;
use tempfile::TempDir;

/// A window on a folder of nine peppers and a file that is none, evaluated; two are tagged.
fn window_on_peppers() -> (TempDir, Harness<'static, Window>) {
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

fn tag(harness: &mut Harness<'static, Window>, place: usize, tags: &str, note: &str) {
    let tagged = Tagged {
        note: note.into(),
        ..Tagged::default().with_tags(tags)
    };
    apply(harness, Command::Folder(FolderCommand::Tag { place, tagged }));
}

fn window_on(folder: &Path, size: [f32; 2], pixels_per_point: f32) -> Harness<'static, Window> {
    let start = Start {
        session: Session::first(),
        session_path: None,
        paths: vec![folder.to_owned()],
        problem: None,
    };
    let mut harness = Harness::builder()
        .with_size(Vec2::from(size))
        .with_pixels_per_point(pixels_per_point)
        .with_max_steps(64)
        // Every control has a name that a screen reader can say.
        .with_accessibility_check(true)
        .wgpu()
        .build_eframe(move |context| Window::new(context, start).expect("threads can be started"));
    settle(&mut harness);
    harness
}

/// Frames until nothing is under way.
fn settle(harness: &mut Harness<'static, Window>) {
    let began = Instant::now();
    let mut calm = 0;
    while calm < 4 {
        harness.step();
        calm = if harness.state().app().is_busy() {
            0
        } else {
            calm + 1
        };
        assert!(began.elapsed() < Duration::from_mins(1), "it never settles");
    }
}

fn apply(harness: &mut Harness<'static, Window>, command: Command) {
    harness.state_mut().app_mut().apply(command);
    settle(harness);
}

fn press(harness: &mut Harness<'static, Window>, modifiers: Modifiers, key: Key) {
    harness.key_press_modifiers(modifiers, key);
    settle(harness);
}

/// Compares with the committed picture: a few pixels may differ a little, as between drivers.
fn snapshot(harness: &mut Harness<'static, Window>, name: &str) {
    harness.remove_cursor();
    settle(harness);
    let options = SnapshotOptions::new()
        .output_path("screenshots/folder")
        .threshold(2.0)
        .max_failed_pixels(10);
    harness.snapshot_options(name, &options);
}

/// The name of the cloud that is shown.
fn current(harness: &Harness<'static, Window>) -> String {
    let source = harness.state().app().state().source();
    source.map(axiscope::app::Source::name).unwrap_or_default()
}
