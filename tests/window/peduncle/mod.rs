//! The peduncle is picked in the window as a person does it: keys, drags, buttons, dropped files.

mod panel;
mod tools;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::helpers::driving::{asset, labeled, write_cloud};
use crate::helpers::in_window::{Windowed, apply, compare, compare_left, press, settle, state, window_of};
use axiscope::app::peduncle::Question;
use axiscope::app::{Command, PeduncleCommand, Session, Tool};
use axiscope::fruit::{PeduncleChoice, read_cloud};
use axiscope::geometry::Cloud;
use axiscope::peduncle::{HueRange, PeduncleSource};
use axiscope::view::{Overlay, ViewPreset};
use egui::{Key, Modifiers, PointerButton, Pos2, Vec2};
use egui_kittest::kittest::Queryable;
use tempfile::TempDir;

fn window(size: [f32; 2], paths: Vec<PathBuf>) -> Windowed {
    window_of(Session::first(), paths, size, 1.0)
}

fn click(harness: &mut Windowed, label: &str) {
    harness.get_by_label(label).click();
    settle(harness);
}

/// The folder of the pictures.
const FOLDER: &str = "screenshots/peduncle";

fn snapshot(harness: &mut Windowed, name: &str) {
    compare(harness, FOLDER, name);
}

/// A copy of the bundled pepper of which only positions, or positions and colors, are left.
fn pepper(folder: &TempDir, has_colors: bool) -> PathBuf {
    let cloud = read_cloud(asset("pepper.ply")).expect("the sample").ply.cloud;
    let mut copy = Cloud::new(cloud.positions().to_vec());
    if has_colors {
        let colors = cloud.colors().expect("it has some").to_vec();
        copy = copy.with_colors(colors).expect("one a point");
    }
    write_cloud(&copy, &folder.path().join("fruit.ply"))
}

/// A closed line around the places at which the peduncle shows in the window.
fn around_the_peduncle(harness: &Windowed) -> Vec<Pos2> {
    let rect = harness.get_by_label_contains("3-D view of").rect();
    let (camera, viewport) = (state(harness).camera, state(harness).viewport);
    let cloud = state(harness).walked.as_ref().expect("analyzed").fruit.cloud();
    let pixels: Vec<Pos2> = labeled()
        .iter()
        .filter_map(|i| camera.project(cloud.positions()[i], viewport))
        .map(|p| rect.min + Vec2::new(p.x as f32, p.y as f32))
        .collect();
    let bounds = egui::Rect::from_points(&pixels).expand(4.0);
    vec![
        bounds.left_top(),
        bounds.center_top() - Vec2::new(0.0, 12.0),
        bounds.right_top(),
        bounds.right_bottom(),
        bounds.left_bottom(),
    ]
}

/// Drags with a button along a path; `before_letting_go` sees the window while it is held.
fn drag(
    harness: &mut Windowed,
    button: PointerButton,
    modifiers: Modifiers,
    path: &[Pos2],
    before_letting_go: impl FnOnce(&mut Windowed),
) {
    let event = |harness: &mut Windowed, event: egui::Event| {
        harness.event(event);
        harness.step();
    };
    event(harness, egui::Event::ModifiersChanged(modifiers));
    event(harness, egui::Event::PointerMoved(path[0]));
    let pressed = |pos: Pos2, pressed: bool| egui::Event::PointerButton {
        pos,
        button,
        pressed,
        modifiers,
    };
    event(harness, pressed(path[0], true));
    for piece in path.windows(2) {
        for step in 1..=4_u8 {
            let at = piece[0].lerp(piece[1], f32::from(step) / 4.0);
            event(harness, egui::Event::PointerMoved(at));
        }
    }
    before_letting_go(harness);
    event(harness, pressed(path[path.len() - 1], false));
    harness.event(egui::Event::ModifiersChanged(Modifiers::NONE));
    settle(harness);
}

fn draw(harness: &mut Windowed, modifiers: Modifiers, path: &[Pos2]) {
    drag(harness, PointerButton::Primary, modifiers, path, |_| {});
}

fn picked(harness: &Windowed) -> usize {
    state(harness).picked_peduncle().map_or(0, |points| points.len())
}
