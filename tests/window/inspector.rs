//! The whole window, drawn by the software driver and driven by labels and keys as a person does.

use crate::helpers::driving::{asset, write_cloud};
use crate::helpers::in_window;
use crate::helpers::in_window::{Windowed, apply, compare, compare_view, press, settle};
use axiscope::app::{Command, PlaneChoice, Sample, Session, Tool};
use axiscope::fruit::read_cloud;
use axiscope::geometry::Cloud;
use axiscope::glam::DVec3;
use axiscope::method::Preset;
use axiscope::ui::{Pane, Start, Window};
use axiscope::view::{Coloring, Overlay, Theme, ViewPreset};
use egui::{Key, Modifiers, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

/// A window of that size in logical pixels that keeps nothing, on a sample.
fn window_of(size: [f32; 2], pixels_per_point: f32, paths: Vec<std::path::PathBuf>) -> Windowed {
    in_window::window_of(Session::first(), paths, size, pixels_per_point)
}

fn window() -> Windowed {
    window_of([1360.0, 860.0], 1.0, Vec::new())
}

fn snapshot(harness: &mut Windowed, name: &str) {
    harness.remove_cursor();
    settle(harness);
    compare(harness, "screenshots/window", name);
}

fn view_snapshot(harness: &mut Windowed, name: &str) {
    harness.remove_cursor();
    settle(harness);
    compare_view(harness, "screenshots/window", name);
}

fn color(harness: &mut Windowed, coloring: Coloring) {
    let mut style = harness.state().app().state().style.clone();
    style.coloring = coloring;
    apply(harness, Command::Style(Box::new(style)));
}

#[test]
fn the_sample_is_shown_analyzed() {
    let mut harness = window();
    let state = harness.state().app().state();
    assert!(state.analysis().is_some() && state.look.is_some());
    harness.get_by_label_contains("3-D view of pepper.ply");
    snapshot(&mut harness, "sample");
}

#[test]
fn warnings_are_listed_behind_their_number() {
    let mut harness = window();
    apply(&mut harness, Command::OpenSample(Sample::MissedPepper));
    apply(&mut harness, Command::UsePreset(Preset::AsPrinted));
    let warned = harness.state().app().state().warnings.clone();
    let number = match warned.len() {
        1 => "1 warning".to_owned(),
        several => format!("{several} warnings"),
    };
    harness.get_by_label(&number).click();
    settle(&mut harness);
    for warning in &warned {
        assert!(harness.query_by_label(warning).is_some(), "{warning}");
    }
}

#[test]
fn strays_are_counted_in_the_bar_and_in_the_legend() {
    let folder = tempfile::tempdir().expect("a folder");
    let pepper = read_cloud(asset("pepper.ply")).expect("the sample").ply.cloud;
    let far = (0..3).map(|i| DVec3::new(500.0, 10.0 * f64::from(i), 50.0));
    let points = pepper.positions().iter().copied().chain(far).collect();
    let path = write_cloud(&Cloud::new(points), &folder.path().join("strays.ply"));
    let mut harness = window_of([1360.0, 860.0], 1.0, vec![path]);
    let legend = |harness: &Windowed| {
        let look = in_window::state(harness).look.clone().expect("drawn");
        look.legend.swatches.iter().any(|swatch| swatch.label == "stray")
    };
    color(&mut harness, Coloring::Side);
    harness.get_by_label_contains("points used without 3 strays, in cm");
    assert!(legend(&harness));
    let mut request = in_window::state(&harness).settings.request.clone();
    request.params.filters.keep_strays = true;
    let request = Box::new(request);
    let gesture = None;
    apply(&mut harness, Command::Set { request, gesture });
    harness.get_by_label_contains("points used with 3 strays, in cm");
    assert!(!legend(&harness));
    // The next session leaves them out or keeps them as this one did.
    let session = Session::of(in_window::state(&harness));
    let text = serde_json::to_string(&session).expect("JSON");
    let restored: Session = serde_json::from_str(&text).expect("a session");
    assert!(restored.settings.request.params.filters.keep_strays);
}

#[test]
fn each_coloring_has_its_legend() {
    let mut harness = window();
    for coloring in Coloring::ALL {
        color(&mut harness, coloring);
        view_snapshot(&mut harness, &format!("color_{}", coloring.name()));
    }
}

#[test]
fn number_keys_choose_colorings() {
    let mut harness = window();
    for (key, coloring) in [
        (Key::Num3, Coloring::Partner),
        (Key::Num6, Coloring::Score),
        (Key::Num1, Coloring::Rgb),
    ] {
        press(&mut harness, Modifiers::NONE, key);
        assert_eq!(harness.state().app().state().style.coloring, coloring);
    }
}

#[test]
fn arrows_walk_the_planes_and_home_comes_back() {
    let mut harness = window();
    let best = harness
        .state()
        .app()
        .state()
        .chosen_plane_index()
        .expect("a plane");
    press(&mut harness, Modifiers::NONE, Key::ArrowRight);
    let state = harness.state().app().state();
    assert_eq!(state.chosen_plane_index(), Some((best + 1) % 36));
    press(&mut harness, Modifiers::SHIFT, Key::ArrowRight);
    let state = harness.state().app().state();
    assert_eq!(state.chosen_plane_index(), Some((best + 7) % 36));
    assert_eq!(
        state.look.as_ref().expect("drawn").plane_index,
        state.chosen_plane_index()
    );
    press(&mut harness, Modifiers::NONE, Key::Home);
    assert_eq!(harness.state().app().state().settings.plane, PlaneChoice::Best);
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert!(matches!(
        harness.state().app().state().settings.plane,
        PlaneChoice::At { .. }
    ));
}

#[test]
fn the_worst_plane_looks_bad() {
    let mut harness = window();
    apply(&mut harness, Command::StepRank(10_000));
    color(&mut harness, Coloring::Score);
    view_snapshot(&mut harness, "worst_plane");
}

#[test]
fn as_printed_fails_beside_as_intended() {
    let mut harness = window();
    let error = |harness: &Windowed| {
        let state = harness.state().app().state();
        let axis = state.analysis().and_then(|a| a.axis.clone()).expect("an axis");
        axiscope::method::axis_error_rad(&axis, state.reference().expect("a peduncle")).to_degrees()
    };
    let intended = error(&harness);
    press(&mut harness, Modifiers::SHIFT, Key::I);
    let state = harness.state().app().state();
    assert_eq!(state.settings.request.params.preset(), Some(Preset::AsPrinted));
    assert!(
        error(&harness) > 2.0 * intended,
        "{} and {intended}",
        error(&harness)
    );
    snapshot(&mut harness, "as_printed");
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert!((error(&harness) - intended).abs() < 1e-9);
}

#[test]
fn u_and_tau_change_live() {
    let mut harness = window();
    let mut request = harness.state().app().state().settings.request.clone();
    request.params.u = 14;
    request.params.tau_cm_per_rad = 0.3;
    apply(
        &mut harness,
        Command::Set {
            request: Box::new(request),
            gesture: None,
        },
    );
    assert_eq!(
        harness
            .state()
            .app()
            .state()
            .analysis()
            .expect("analyzed")
            .planes
            .terms
            .len(),
        196
    );
    snapshot(&mut harness, "u14_tau03");
}

#[test]
fn a_picked_point_is_explained() {
    let mut harness = window();
    let state = harness.state().app().state();
    let shown = state.shown().expect("points").clone();
    let (camera, viewport) = (state.camera, state.viewport);
    // One with a partner, in the middle of the picture, that nothing hides.
    let middle = glam::DVec2::new(0.45 * viewport.width_px, 0.5 * viewport.height_px);
    let picked = axiscope::view::pick_point(&shown, &camera, viewport, middle, 4.0, 60.0).expect("a point");
    apply(&mut harness, Command::Pick(Some(picked)));
    snapshot(&mut harness, "picked_point");
    assert!(axiscope::app::inspector::why::why(harness.state().app().state(), picked).is_some());
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert_eq!(harness.state().app().state().picked, None);
}

#[test]
fn overlays_and_the_axes() {
    let mut harness = window();
    for key in [Key::N, Key::V, Key::G, Key::L] {
        press(&mut harness, Modifiers::NONE, key);
    }
    let overlays = &harness.state().app().state().style.overlays;
    for overlay in [
        Overlay::Normal,
        Overlay::Viewpoint,
        Overlay::Ghost,
        Overlay::Partners,
    ] {
        assert!(overlays.has(overlay), "{}", overlay.name());
    }
    press(&mut harness, Modifiers::ALT, Key::Num3);
    view_snapshot(&mut harness, "overlays");
}

#[test]
fn light_colors() {
    let mut harness = window();
    press(&mut harness, Modifiers::SHIFT, Key::T);
    assert_eq!(harness.state().app().state().style.theme, Theme::Light);
    snapshot(&mut harness, "light");
}

#[test]
fn a_narrow_window() {
    let mut harness = window_of([800.0, 560.0], 1.0, Vec::new());
    snapshot(&mut harness, "narrow");
}

#[test]
fn a_screen_of_many_pixels() {
    let mut harness = window_of([900.0, 600.0], 2.0, Vec::new());
    assert!((harness.state().app().state().pixels_per_point - 2.0).abs() < 1e-6);
    snapshot(&mut harness, "pixels_per_point_2");
}

#[test]
fn a_bad_file_is_a_message_and_the_window_goes_on() {
    let folder = tempfile::tempdir().expect("a folder");
    let bad = folder.path().join("bad.ply");
    std::fs::write(&bad, "ply\nformat ascii 1.0\nelement vertex 3\nend_header\n").expect("written");
    let mut harness = window_of([1100.0, 700.0], 1.0, vec![bad, asset("ellipsoid.ply")]);
    let state = harness.state().app().state();
    assert!(
        state
            .messages
            .iter()
            .any(|m| m.is_error && m.text.contains("bad.ply"))
    );
    harness.get_by_label("Dismiss").click();
    settle(&mut harness);
    assert!(harness.state().app().state().messages.is_empty());
    press(&mut harness, Modifiers::NONE, Key::PageDown);
    assert!(harness.state().app().state().walked.is_some());
    apply(
        &mut harness,
        Command::Say {
            is_error: true,
            text: "clouds/bad.ply: line 4: the file ends within the header.".into(),
        },
    );
    snapshot(&mut harness, "error");
}

#[test]
fn help_lists_the_keys_that_work() {
    let mut harness = window();
    press(&mut harness, Modifiers::NONE, Key::F1);
    harness.get_by_label("Keys");
    snapshot(&mut harness, "help");
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert!(harness.query_by_label("Keys").is_none());
}

#[test]
fn the_palette_finds_commands_by_name() {
    let mut harness = window();
    press(&mut harness, Modifiers::COMMAND, Key::P);
    harness.event(egui::Event::Text("mirrored".into()));
    settle(&mut harness);
    snapshot(&mut harness, "palette");
    press(&mut harness, Modifiers::NONE, Key::Enter);
    assert!(harness.state().app().state().style.overlays.has(Overlay::Ghost));
    assert!(harness.query_by_label("Find a command").is_none());
}

#[test]
fn keys_do_nothing_while_somebody_types() {
    let mut harness = window();
    press(&mut harness, Modifiers::COMMAND, Key::P);
    let before = harness.state().app().state().style.coloring;
    press(&mut harness, Modifiers::NONE, Key::Num6);
    assert_eq!(harness.state().app().state().style.coloring, before);
}

#[test]
fn dragging_turns_the_camera_and_moves_the_center_only_in_its_mode() {
    let mut harness = window();
    let view = harness.get_by_label_contains("3-D view of").rect();
    let before = harness.state().app().state().camera;
    let request = harness.state().app().state().settings.request.clone();
    drag(&mut harness, view.center(), Vec2::new(60.0, 20.0));
    let after = harness.state().app().state().camera;
    assert_ne!(before.world_from_view, after.world_from_view);
    assert_eq!(harness.state().app().state().settings.request, request);
    press(&mut harness, Modifiers::NONE, Key::C);
    assert_eq!(harness.state().app().state().tool, Tool::MoveCenter);
    drag(&mut harness, view.center(), Vec2::new(20.0, 0.0));
    let state = harness.state().app().state();
    assert_eq!(state.camera, after, "the camera stays");
    assert_ne!(state.settings.request, request);
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert_eq!(harness.state().app().state().tool, Tool::Navigate);
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(
        harness.state().app().state().settings.request,
        request,
        "one drag, one step"
    );
}

fn drag(harness: &mut Windowed, from: egui::Pos2, by: Vec2) {
    harness.hover_at(from);
    harness.step();
    harness.drag_at(from);
    harness.step();
    for i in 1..=4 {
        harness.hover_at(from + by * (i as f32 / 4.0));
        harness.step();
    }
    harness.drop_at(from + by);
    settle(harness);
}

#[test]
fn views_look_where_they_say() {
    let mut harness = window();
    press(&mut harness, Modifiers::ALT, Key::Num4);
    let top = harness.state().app().state().camera.forward_in_world();
    assert!(top.y > 0.999, "{top}");
    press(&mut harness, Modifiers::ALT, Key::Num3);
    let side = harness.state().app().state().camera.forward_in_world();
    assert!(side.x < -0.999, "{side}");
    apply(&mut harness, Command::View(ViewPreset::Normal));
    let state = harness.state().app().state();
    let normal = state
        .analysis()
        .expect("analyzed")
        .planes
        .grid
        .candidate(state.plane_index().expect("a plane"))
        .normal;
    assert!(state.camera.forward_in_world().dot(normal).abs() > 0.999);
}

#[test]
fn several_files_give_a_list_with_next_and_previous() {
    let mut harness = window_of(
        [1200.0, 760.0],
        1.0,
        vec![
            asset("pepper.ply"),
            asset("pepper_missed.ply"),
            asset("ellipsoid.ply"),
        ],
    );
    press(&mut harness, Modifiers::NONE, Key::PageDown);
    assert_eq!(harness.state().app().state().current, Some(1));
    harness.get_by_label("Clouds").click();
    settle(&mut harness);
    snapshot(&mut harness, "files");
}

#[test]
fn a_saved_view_is_drawn_again_by_the_command_line() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut harness = window_of([1100.0, 700.0], 1.0, vec![asset("pepper.ply")]);
    press(&mut harness, Modifiers::NONE, Key::Num4);
    press(&mut harness, Modifiers::NONE, Key::ArrowRight);
    press(&mut harness, Modifiers::COMMAND, Key::S);
    harness.get_by_label("4 × the view").click();
    settle(&mut harness);
    snapshot(&mut harness, "save_image");
    press(&mut harness, Modifiers::NONE, Key::Escape);
    let (saved, again) = (folder.path().join("view.png"), folder.path().join("again.png"));
    apply(
        &mut harness,
        Command::SaveImage {
            path: saved.clone(),
            size_px: [640, 480],
        },
    );
    let said = &harness.state().app().state().messages;
    assert!(
        said.iter().any(|m| !m.is_error && m.text.contains("view.png")),
        "{said:?}"
    );
    assert_cmd::Command::new(env!("CARGO_BIN_EXE_axiscope"))
        .args(["render", "--from"])
        .arg(&saved)
        .arg("-o")
        .arg(&again)
        .assert()
        .success();
    assert_eq!(
        std::fs::read(saved).expect("written"),
        std::fs::read(again).expect("written"),
        "to the byte"
    );
}

#[test]
fn no_two_actions_share_a_key_and_every_one_is_in_the_help() {
    let harness = window();
    let state = harness.state().app().state();
    let all = axiscope::ui::actions(state);
    let mut keys: Vec<_> = all.iter().flat_map(|a| a.keys.iter()).collect();
    let count = keys.len();
    keys.sort_by_key(|key| format!("{key:?}"));
    keys.dedup();
    assert_eq!(keys.len(), count, "a key does two things");
    for action in all.iter().filter(|a| !a.keys.is_empty()) {
        let text = action.keys_text(&harness.ctx);
        assert!(!text.contains("Bracket") && !text.contains("Question"), "{text}");
    }
}

/// A file as the desktop drops it.
#[derive(Debug)]
struct Dropped(std::path::PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &std::path::Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        Err("files are opened by their paths".into())
    }
}

#[test]
fn dropped_files_are_opened() {
    let mut harness = window();
    let dropped = [asset("ellipsoid.ply"), asset("pepper_missed.ply")];
    harness.input_mut().dropped_files = dropped
        .iter()
        .map(|path| std::sync::Arc::new(Dropped(path.clone())) as _)
        .collect();
    settle(&mut harness);
    let state = harness.state().app().state();
    assert_eq!(state.entries.len(), 2, "the sample has made room");
    assert_eq!(
        state.source().map(axiscope::app::Source::path),
        Some(&*dropped[0])
    );
    assert!(state.walked.is_some());
    assert_eq!(state.recent.len(), 2);
}

#[test]
fn a_window_comes_back_as_it_was_left() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("session.json");
    let open = |session, paths| {
        let start = Start {
            session,
            session_path: Some(path.clone()),
            paths,
            problem: None,
        };
        let mut harness = Harness::builder()
            .with_size(Vec2::new(1200.0, 800.0))
            .wgpu()
            .build_eframe(move |context| Window::new(context, start).expect("threads can be started"));
        settle(&mut harness);
        harness
    };
    let files = vec![asset("pepper.ply"), asset("pepper_missed.ply")];
    let mut first = open(Session::first(), files);
    press(&mut first, Modifiers::NONE, Key::PageDown);
    press(&mut first, Modifiers::SHIFT, Key::I);
    press(&mut first, Modifiers::NONE, Key::ArrowRight);
    press(&mut first, Modifiers::SHIFT, Key::T);
    eframe::App::on_exit(first.state_mut());
    let left = first.state().app().state().clone();

    let second = open(Session::read(&path).expect("it was kept"), Vec::new());
    let state = second.state().app().state();
    assert_eq!(state.settings, left.settings);
    assert_eq!(state.style, left.style);
    assert_eq!((state.entries.len(), state.current), (2, Some(1)));
    assert_eq!(state.chosen_plane_index(), left.chosen_plane_index());
}

#[test]
fn every_sample_opens() {
    let mut harness = window();
    for sample in Sample::ALL {
        apply(&mut harness, Command::OpenSample(sample));
        assert!(
            harness.state().app().state().walked.is_some(),
            "{}",
            sample.title()
        );
    }
}

#[test]
fn every_panel_comes_to_the_front() {
    let mut harness = window();
    for pane in [Pane::Hemisphere, Pane::Contributions, Pane::Clouds] {
        harness.get_by_label(pane.title()).click();
        settle(&mut harness);
    }
    snapshot(&mut harness, "panels");
}
