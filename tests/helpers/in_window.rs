//! The whole window, driven by tests as a person does.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use axiscope::app::{Command, Session, State};
use axiscope::ui::{Start, Window};
use egui::{Key, Modifiers, Vec2};
use egui_kittest::{Harness, SnapshotOptions};

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

/// Compares with the committed picture in a folder: a few pixels may differ a little, as between drivers.
pub fn compare(harness: &mut Windowed, folder: &str, name: &str) {
    let options = SnapshotOptions::new()
        .output_path(folder)
        .threshold(2.0)
        .max_failed_pixels(10);
    harness.snapshot_options(name, &options);
}
