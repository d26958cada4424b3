//! The peduncle is picked in the window as a person does it: keys, drags, buttons, dropped files.

#[path = "../driving/mod.rs"]
mod driving;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use axiscope::app::peduncle::Question;
use axiscope::app::{Command, PeduncleCommand, Session, State, Tool};
use axiscope::geometry::{Cloud, PointSet};
use axiscope::io::ply::{WriteOptions, write};
use axiscope::io::{PeduncleChoice, read_cloud};
use axiscope::reference::{HueRange, Peduncle, PeduncleSource};
use axiscope::ui::{Start, Window};
use axiscope::view::{Overlay, ViewPreset};
use driving::asset;
use egui::{Key, Modifiers, PointerButton, Pos2, Vec2};
use egui_kittest::kittest::Queryable;
use egui_kittest::{Harness, SnapshotOptions};
use tempfile::TempDir;

type Bench = Harness<'static, Window>;

fn window(size: [f32; 2], paths: Vec<PathBuf>) -> Bench {
    let start = Start {
        session: Session::first(),
        session_path: None,
        paths,
        problem: None,
    };
    let mut harness = Harness::builder()
        .with_size(Vec2::from(size))
        .with_max_steps(64)
        .with_accessibility_check(true)
        .wgpu()
        .build_eframe(move |context| Window::new(context, start).expect("threads can be started"));
    settle(&mut harness);
    harness
}

fn settle(harness: &mut Bench) {
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

fn state(harness: &Bench) -> &State {
    harness.state().app().state()
}

fn apply(harness: &mut Bench, command: Command) {
    harness.state_mut().app_mut().apply(command);
    settle(harness);
}

fn press(harness: &mut Bench, modifiers: Modifiers, key: Key) {
    harness.key_press_modifiers(modifiers, key);
    settle(harness);
}

fn click(harness: &mut Bench, label: &str) {
    harness.get_by_label(label).click();
    settle(harness);
}

fn snapshot(harness: &mut Bench, name: &str) {
    let options = SnapshotOptions::new()
        .output_path("screenshots/peduncle")
        .threshold(2.0)
        .max_failed_pixels(10);
    harness.snapshot_options(name, &options);
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

fn write_cloud(cloud: &Cloud, path: &Path) -> PathBuf {
    let mut bytes = Vec::new();
    let options = WriteOptions {
        unit: Some(axiscope::geometry::Unit::Centimeter),
        ..WriteOptions::default()
    };
    write(&mut bytes, cloud, &options).expect("written");
    std::fs::write(path, bytes).expect("written");
    path.to_owned()
}

fn labeled() -> PointSet {
    let cloud = read_cloud(asset("pepper.ply")).expect("the sample").ply.cloud;
    let peduncle = Peduncle::by_label(&cloud).expect("labeled");
    peduncle.in_cloud.into_iter().collect()
}

/// A closed line around the places at which the peduncle shows in the window.
fn around_the_peduncle(harness: &Bench) -> Vec<Pos2> {
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
    harness: &mut Bench,
    button: PointerButton,
    modifiers: Modifiers,
    path: &[Pos2],
    before_letting_go: impl FnOnce(&mut Bench),
) {
    let event = |harness: &mut Bench, event: egui::Event| {
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

fn draw(harness: &mut Bench, modifiers: Modifiers, path: &[Pos2]) {
    drag(harness, PointerButton::Primary, modifiers, path, |_| {});
}

fn picked(harness: &Bench) -> usize {
    state(harness).picked_peduncle().map_or(0, |points| points.len())
}

#[test]
fn a_lasso_is_drawn_around_the_peduncle() {
    let folder = TempDir::new().expect("a folder");
    let mut harness = window([1360.0, 860.0], vec![pepper(&folder, false)]);
    apply(&mut harness, Command::View(ViewPreset::Front));
    press(&mut harness, Modifiers::NONE, Key::K);
    assert_eq!(state(&harness).tool, Tool::Lasso);
    let camera = state(&harness).camera;
    let path = around_the_peduncle(&harness);
    drag(
        &mut harness,
        PointerButton::Primary,
        Modifiers::NONE,
        &path,
        |harness| {
            settle(harness);
            assert_eq!(picked(harness), 0, "nothing counts before the button is let go");
            let marked = state(harness).peduncle.marked.as_ref().expect("it shows");
            assert!(10 * marked.points > 9 * labeled().len(), "{}", marked.points);
            snapshot(harness, "lasso");
        },
    );
    assert!(10 * picked(&harness) > 9 * labeled().len());
    assert_eq!(state(&harness).camera, camera, "an edit never moves the camera");
    assert_eq!(state(&harness).references.len(), 2);
    harness.remove_cursor();
    settle(&mut harness);
    snapshot(&mut harness, "picked");

    // The other buttons move the camera and pick nothing.
    let count = picked(&harness);
    let view = harness.get_by_label_contains("3-D view of").rect();
    for button in [PointerButton::Secondary, PointerButton::Middle] {
        let before = state(&harness).camera;
        let line = [view.center(), view.center() + Vec2::new(40.0, 10.0)];
        drag(&mut harness, button, Modifiers::NONE, &line, |_| {});
        assert_ne!(state(&harness).camera, before, "{button:?}");
        assert_eq!(picked(&harness), count);
    }
    // What is under the line is taken away with Shift.
    apply(&mut harness, Command::Camera(Box::new(camera)));
    let path = around_the_peduncle(&harness);
    draw(&mut harness, Modifiers::SHIFT, &path);
    assert!(picked(&harness) < count / 10, "{} of {count}", picked(&harness));
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(picked(&harness), count);
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert_eq!(state(&harness).tool, Tool::Navigate);
    assert!(state(&harness).peduncle.marked.is_none());
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert!(state(&harness).references.is_empty());
}

#[test]
fn a_brush_paints_what_is_under_it() {
    let folder = TempDir::new().expect("a folder");
    let mut harness = window([1100.0, 760.0], vec![pepper(&folder, true)]);
    apply(&mut harness, Command::View(ViewPreset::Front));
    press(&mut harness, Modifiers::NONE, Key::B);
    let radius = state(&harness).peduncle.brush_radius_px;
    let size = state(&harness).style.point_size;
    press(&mut harness, Modifiers::NONE, Key::CloseBracket);
    assert!(state(&harness).peduncle.brush_radius_px > radius);
    assert_eq!(
        state(&harness).style.point_size,
        size,
        "the key is the brush's for now"
    );
    press(&mut harness, Modifiers::NONE, Key::OpenBracket);
    let path = around_the_peduncle(&harness);
    let line = [path[1], path[4].lerp(path[3], 0.5)];
    drag(
        &mut harness,
        PointerButton::Primary,
        Modifiers::NONE,
        &line,
        |harness| {
            settle(harness);
            snapshot(harness, "brush");
        },
    );
    assert!(picked(&harness) > labeled().len() / 2, "{}", picked(&harness));
    // A single click is a dab.
    let view = harness.get_by_label_contains("3-D view of").rect();
    let before = picked(&harness);
    draw(&mut harness, Modifiers::NONE, &[view.center()]);
    assert!(picked(&harness) > before);
    // Ctrl and the wheel size the brush, the wheel alone zooms.
    let camera = state(&harness).camera;
    let before = state(&harness).peduncle.brush_radius_px;
    harness.hover_at(view.center());
    let ctrl = Modifiers::COMMAND | Modifiers::CTRL;
    harness.event(egui::Event::ModifiersChanged(ctrl));
    harness.event(egui::Event::Zoom(1.3));
    harness.step();
    harness.event(egui::Event::ModifiersChanged(Modifiers::NONE));
    settle(&mut harness);
    assert!(state(&harness).peduncle.brush_radius_px > before);
    assert_eq!(state(&harness).camera, camera);
    press(&mut harness, Modifiers::NONE, Key::B);
    assert_eq!(state(&harness).tool, Tool::Navigate);
}

#[test]
fn escape_drops_the_stroke_under_way_first() {
    let folder = TempDir::new().expect("a folder");
    let mut harness = window([1000.0, 700.0], vec![pepper(&folder, false)]);
    apply(&mut harness, Command::View(ViewPreset::Front));
    press(&mut harness, Modifiers::NONE, Key::K);
    let path = around_the_peduncle(&harness);
    drag(
        &mut harness,
        PointerButton::Primary,
        Modifiers::NONE,
        &path,
        |harness| press(harness, Modifiers::NONE, Key::Escape),
    );
    assert_eq!(picked(&harness), 0);
    assert_eq!(state(&harness).tool, Tool::Lasso, "the tool stays in hand");
}

#[test]
fn what_is_picked_is_saved_with_a_key_and_never_over_another_file() {
    let folder = TempDir::new().expect("a folder");
    let cloud = pepper(&folder, false);
    let mut harness = window([1200.0, 800.0], vec![cloud]);
    apply(&mut harness, Command::View(ViewPreset::Front));
    press(&mut harness, Modifiers::NONE, Key::K);
    let path = around_the_peduncle(&harness);
    draw(&mut harness, Modifiers::NONE, &path);
    harness.get_by_label("not saved in a file yet");
    press(&mut harness, Modifiers::COMMAND | Modifiers::SHIFT, Key::C);
    let said = |harness: &Bench, text: &str| state(harness).messages.iter().any(|m| m.text.contains(text));
    assert!(
        said(&harness, "Save it first"),
        "the command line does not know it"
    );
    press(&mut harness, Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    let companion = folder.path().join("fruit_peduncle.ply");
    assert_eq!(
        read_cloud(&companion).expect("saved").ply.cloud.len(),
        picked(&harness)
    );
    harness.get_by_label_contains("saved as fruit_peduncle.ply");
    // Once more is no question, but another peduncle is.
    press(&mut harness, Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    assert_eq!(state(&harness).peduncle.question, None);
    apply(&mut harness, Command::Peduncle(PeduncleCommand::Invert));
    press(&mut harness, Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    assert_eq!(
        state(&harness).peduncle.question,
        Some(Question::Replace(companion))
    );
    click(&mut harness, "Keep it");
    assert_eq!(state(&harness).peduncle.question, None);
}

/// A file as the desktop drops it.
#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        Err("files are opened by their paths".into())
    }
}

#[test]
fn a_dropped_companion_is_offered_as_the_peduncle() {
    let folder = TempDir::new().expect("a folder");
    let mut harness = window([1100.0, 720.0], vec![pepper(&folder, true)]);
    let cloud = read_cloud(asset("pepper.ply")).expect("the sample").ply.cloud;
    let indices: Vec<usize> = labeled().iter().collect();
    let dropped = write_cloud(&cloud.select(&indices), &folder.path().join("x_peduncle.ply"));
    harness.input_mut().dropped_files = vec![Arc::new(Dropped(dropped.clone()))];
    settle(&mut harness);
    assert_eq!(state(&harness).entries.len(), 1, "it is no cloud of the list");
    snapshot(&mut harness, "offered");
    click(&mut harness, "Use as its peduncle");
    let fruit = &state(&harness).walked.as_ref().expect("analyzed").fruit;
    let found = fruit.peduncle.as_ref().expect("found");
    assert_eq!(
        (found.source, found.points),
        (PeduncleSource::Companion, labeled().len())
    );
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(state(&harness).settings.request.peduncle, PeduncleChoice::Auto);
}

#[test]
fn a_companion_that_is_dropped_with_its_cloud_is_its_peduncle() {
    let folder = TempDir::new().expect("a folder");
    let cloud = pepper(&folder, true);
    let full = read_cloud(asset("pepper.ply")).expect("the sample").ply.cloud;
    let indices: Vec<usize> = labeled().iter().collect();
    let companion = write_cloud(&full.select(&indices), &folder.path().join("fruit_peduncle.ply"));
    let mut harness = window([1000.0, 700.0], Vec::new());
    let files = [companion, cloud];
    harness.input_mut().dropped_files = files.map(|path| Arc::new(Dropped(path)) as _).to_vec();
    settle(&mut harness);
    assert_eq!(state(&harness).entries.len(), 1, "one cloud");
    let fruit = &state(&harness).walked.as_ref().expect("analyzed").fruit;
    let found = fruit.peduncle.as_ref().expect("found");
    assert_eq!(
        (found.source, found.points),
        (PeduncleSource::Companion, labeled().len())
    );
}

/// The parameters' panel with the peduncle's section open and everything above it closed.
fn open_section(harness: &mut Bench) {
    click(harness, "Peduncle");
    let section = harness.get_by_label("Peduncle");
    section.scroll_to_me();
    settle(harness);
}

#[test]
fn the_panel_says_what_to_do_where_there_is_no_peduncle() {
    let folder = TempDir::new().expect("a folder");
    let mut harness = window([1360.0, 1100.0], vec![pepper(&folder, false)]);
    open_section(&mut harness);
    harness.get_by_label_contains("This cloud has no peduncle yet");
    harness.get_by_label("Pick with the lasso").click();
    settle(&mut harness);
    assert_eq!(state(&harness).tool, Tool::Lasso);
    snapshot(&mut harness, "none_yet");
}

#[test]
fn hues_are_chosen_on_their_histogram_and_shown_in_the_view() {
    let folder = TempDir::new().expect("a folder");
    let mut harness = window([1360.0, 1100.0], vec![pepper(&folder, true)]);
    let range = HueRange {
        from_deg: 60.0,
        to_deg: 160.0,
    };
    apply(
        &mut harness,
        Command::Peduncle(PeduncleCommand::Choose(PeduncleChoice::Hue(range))),
    );
    open_section(&mut harness);
    let bar = harness.get_by_label_contains("Hues of the cloud").rect();
    let at = |deg: f32| Pos2::new(bar.left() + bar.width() * deg / 360.0, bar.center().y);
    drag(
        &mut harness,
        PointerButton::Primary,
        Modifiers::NONE,
        &[at(60.0), at(90.0)],
        |harness| {
            settle(harness);
            assert!(state(harness).peduncle.is_previewed);
            assert!(state(harness).peduncle.marked.as_ref().expect("it shows").points > 0);
            snapshot(harness, "hues");
        },
    );
    let PeduncleChoice::Hue(range) = state(&harness).settings.request.peduncle else {
        panic!("a range of hues");
    };
    assert!(
        (range.from_deg - 90.0).abs() <= 1.0 && range.to_deg == 160.0,
        "{range:?}"
    );
    harness.remove_cursor();
    settle(&mut harness);
    assert!(
        state(&harness).peduncle.marked.is_none(),
        "the highlight goes with the cursor"
    );
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(
        state(&harness).settings.request.peduncle,
        PeduncleChoice::Hue(HueRange {
            from_deg: 60.0,
            to_deg: 160.0
        }),
        "one drag, one step"
    );
}

#[test]
fn both_references_and_both_experiments_stand_in_the_panel() {
    let mut harness = window([1360.0, 1100.0], Vec::new());
    open_section(&mut harness);
    click(&mut harness, "Compare with and without");
    assert!(state(&harness).peduncle.beside.is_some());
    let mut style = state(&harness).style.clone();
    style.overlays.set(Overlay::References, true);
    apply(&mut harness, Command::Style(Box::new(style)));
    harness.get_by_label_contains("° apart");
    harness.remove_cursor();
    settle(&mut harness);
    snapshot(&mut harness, "references");
}

#[test]
fn what_does_not_fit_is_told_in_the_panel() {
    let mut harness = window([1360.0, 1100.0], Vec::new());
    apply(
        &mut harness,
        Command::Peduncle(PeduncleCommand::Choose(PeduncleChoice::Removed(
            "clouds/without".into(),
        ))),
    );
    open_section(&mut harness);
    assert!(state(&harness).analysis().is_some(), "the cloud stays");
    harness.get_by_label("Folder of the clouds without their peduncles");
    harness.remove_cursor();
    settle(&mut harness);
    snapshot(&mut harness, "removed_missing");
}

#[test]
fn the_tools_fit_a_narrow_window_in_the_light() {
    let folder = TempDir::new().expect("a folder");
    let mut harness = window([820.0, 620.0], vec![pepper(&folder, true)]);
    press(&mut harness, Modifiers::NONE, Key::T);
    apply(&mut harness, Command::View(ViewPreset::Front));
    press(&mut harness, Modifiers::NONE, Key::K);
    let path = around_the_peduncle(&harness);
    draw(&mut harness, Modifiers::NONE, &path);
    assert!(picked(&harness) > 0);
    harness.remove_cursor();
    settle(&mut harness);
    snapshot(&mut harness, "narrow_light");
}
