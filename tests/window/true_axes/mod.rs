//! Edit mode in the whole window, driven by the mouse and keys as a person does, and how it looks.

mod edits;
mod looks;

use crate::helpers::driving;
use crate::helpers::in_window;
use std::path::{Path, PathBuf};

use crate::helpers::in_window::{Windowed, apply, compare, compare_left, press, settle, state};
use axiscope::annotate::DiskFiles;
use axiscope::annotate::{Annotation, Author, CloudId, Ends, Judgment, Store};
use axiscope::app::true_axes::{EditView, Handle};
use axiscope::app::{Command, Session, TrueAxesState};
use axiscope::fruit::{Fruit, Request};
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Vec2, vec2};
use egui_kittest::kittest::Queryable;
use glam::DVec2;

/// A folder with so many copies of the bundled pepper.
fn folder(clouds: usize) -> (tempfile::TempDir, Vec<PathBuf>) {
    let folder = tempfile::tempdir().expect("a folder");
    let names = (0..clouds).map(|i| format!("pepper_{}.ply", i + 1));
    let paths: Vec<PathBuf> = names.map(|name| folder.path().join(name)).collect();
    for path in &paths {
        std::fs::copy(driving::asset("pepper.ply"), path).expect("copied");
    }
    (folder, paths)
}

fn ada() -> Author {
    Author::annotator("Ada").expect("a name")
}

/// A window on these clouds, whose annotator has said her name before.
fn window(paths: &[PathBuf], size: [f32; 2]) -> Windowed {
    let mut session = Session::first();
    session.true_axes.name = "Ada".into();
    window_of(session, paths, size)
}

fn window_of(session: Session, paths: &[PathBuf], size: [f32; 2]) -> Windowed {
    in_window::window_of(session, paths.to_vec(), size, 1.0)
}

const SIZE: [f32; 2] = [1360.0, 860.0];

fn annotating(harness: &Windowed) -> &TrueAxesState {
    &state(harness).true_axes
}

/// The large view on the screen.
fn view(harness: &Windowed) -> egui::Rect {
    harness.get_by_label_contains("3-D view of").rect()
}

fn locked(harness: &Windowed, view: EditView) -> egui::Rect {
    harness
        .get_by_label(&format!("Locked view: {}", view.title()))
        .rect()
}

fn move_to(harness: &mut Windowed, at: Pos2) {
    harness.event(Event::PointerMoved(at));
    harness.step();
}

fn button(harness: &mut Windowed, at: Pos2, button: PointerButton, pressed: bool) {
    harness.event(Event::PointerButton {
        pos: at,
        button,
        pressed,
        modifiers: Modifiers::NONE,
    });
    harness.step();
}

fn click(harness: &mut Windowed, at: Pos2) {
    move_to(harness, at);
    button(harness, at, PointerButton::Primary, true);
    button(harness, at, PointerButton::Primary, false);
    settle(harness);
}

fn drag(harness: &mut Windowed, which: PointerButton, from: Pos2, by: Vec2) {
    move_to(harness, from);
    button(harness, from, which, true);
    for step in 1..=8 {
        move_to(harness, from + by * (step as f32 / 8.0));
    }
    button(harness, from + by, which, false);
    settle(harness);
}

/// Where a handle shows in the large view.
fn handle_on_screen(harness: &Windowed, handle: Handle) -> Pos2 {
    let state = state(harness);
    let ends = state.true_axes.ends().expect("an axis");
    let at = state
        .camera
        .project(handle.place(&ends), state.viewport)
        .expect("seen");
    view(harness).min + vec2(at.x as f32, at.y as f32)
}

/// Both ends of the bundled pepper, as an eye sees them in the first view.
fn set_by_clicks(harness: &mut Windowed) -> Ends {
    let (base, blossom) = where_ends_are(harness);
    click(harness, base);
    click(harness, blossom);
    annotating(harness).set_ends().expect("an axis")
}

fn where_ends_are(harness: &Windowed) -> (Pos2, Pos2) {
    let view = view(harness);
    (
        view.lerp_inside(vec2(0.47, 0.33)),
        view.lerp_inside(vec2(0.50, 0.80)),
    )
}

fn on_disk(cloud: &Path) -> Option<Annotation> {
    let bytes = std::fs::read(ada().axis_path(cloud, 1)).ok()?;
    Some(Annotation::from_json(&bytes).expect("an axis file"))
}

/// An axis of somebody else, beside the cloud.
fn set_as(name: &str, cloud: &Path, ends: Ends) {
    let fruit = Fruit::read(cloud, &Request::default()).expect("a cloud");
    let id = CloudId {
        file: cloud.file_name().expect("a name").to_string_lossy().into(),
        sha256: fruit.file.sha256.clone(),
    };
    let author = Author::annotator(name).expect("a name");
    let files = Box::new(DiskFiles::default());
    let (mut store, _) = Store::open(files, cloud, id, fruit.unit, author).expect("open");
    store
        .edit(Judgment::by_hand(ends), "2026-03-01T12:00:00Z")
        .expect("written");
}

/// Compares with the committed picture: a few pixels may differ a little, as between drivers. The cursor
/// stays where it is.
/// The folder of the pictures.
const FOLDER: &str = "screenshots/annotating";

fn snapshot(harness: &mut Windowed, name: &str) {
    settle(harness);
    compare(harness, FOLDER, name);
}

fn pixel_in(rect: egui::Rect, at: Pos2) -> DVec2 {
    let from = at - rect.min;
    DVec2::new(from.x.into(), from.y.into())
}
