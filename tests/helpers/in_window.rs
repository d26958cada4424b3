//! The whole window, driven by tests as a person does.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use axiscope::app::{Command, Session, State};
use axiscope::ui::{Start, Window};
use egui::{Key, Modifiers, Pos2, Rect, Vec2};
use egui_kittest::kittest::Queryable;
use egui_kittest::{Harness, SnapshotOptions, image_snapshot_options};
use image::imageops;

/// A window that tests drive.
pub type Windowed = Harness<'static, Window>;

/// A window of that size in logical pixels that keeps nothing; on a sample where there are no paths.
pub fn window_of(session: Session, paths: Vec<PathBuf>, size: [f32; 2], pixels_per_point: f32) -> Windowed {
    let start = Start {
        session,
        session_path: None,
        paths,
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
pub fn settle(harness: &mut Windowed) {
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

/// What the window shows.
pub fn state(harness: &Windowed) -> &State {
    harness.state().app().state()
}

/// Does something and waits for what comes of it.
pub fn apply(harness: &mut Windowed, command: Command) {
    harness.state_mut().app_mut().apply(command);
    settle(harness);
}

/// Presses a key and waits for what comes of it.
pub fn press(harness: &mut Windowed, modifiers: Modifiers, key: Key) {
    harness.key_press_modifiers(modifiers, key);
    settle(harness);
}

/// Compares with the committed picture in a folder.
pub fn compare(harness: &mut Windowed, folder: &str, name: &str) {
    harness.snapshot_options(name, &snapshot_options(folder));
}

/// Compares the 3-D view alone with the committed picture in a folder, as [`compare`] does: what stands around it is in
/// other pictures.
pub fn compare_view(harness: &mut Windowed, folder: &str, name: &str) {
    let view = harness.get_by_label_contains("3-D view of").rect();
    compare_part(harness, view, folder, name);
}

/// Compares what lies left of the 3-D view with the committed picture in a folder: the parameters, and the lists behind them.
pub fn compare_left(harness: &mut Windowed, folder: &str, name: &str) {
    let view = harness.get_by_label_contains("3-D view of").rect();
    let left = Rect::from_min_max(Pos2::ZERO, Pos2::new(view.min.x, view.max.y));
    compare_part(harness, left, folder, name);
}

/// Compares a part of the window, in physical pixels.
fn compare_part(harness: &mut Windowed, part: Rect, folder: &str, name: &str) {
    let pixels = |length: f32| length.round() as u32;
    let whole = harness.render().expect("the driver draws");
    let (left, top) = (pixels(part.min.x), pixels(part.min.y));
    let cropped = imageops::crop_imm(&whole, left, top, pixels(part.width()), pixels(part.height()));
    image_snapshot_options(&cropped.to_image(), name, &snapshot_options(folder));
}

/// A few pixels may differ a little, as between drivers.
fn snapshot_options(folder: &str) -> SnapshotOptions {
    SnapshotOptions::new()
        .output_path(folder)
        .threshold(2.0)
        .max_failed_pixels(10)
}
