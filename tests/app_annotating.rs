//! True axes by hand, driven without a window: what clicks and keys do, what is saved, what is hidden.

mod driving;

use std::path::{Path, PathBuf};
use std::time::Duration;

use axiscope::annotate::{Annotation, Author, Confidence, Ends, Finding, Judgment, Method, Pivot, Role};
use axiscope::app::annotating::{Decision, Draft, EditView, Ghost, Handle, Saving, Turn};
use axiscope::app::{AnnotateCommand, App, Command, Sample, Session, Tool, TruthChoice};
use axiscope::method::AxisSource;
use axiscope::render::{Projection, Viewport};
use axiscope::view::{Coloring, Overlay, ViewPreset};
use driving::{act, app, asset, settle};
use glam::{DVec2, DVec3};

/// A folder with copies of the bundled pepper.
fn folder(clouds: usize) -> (tempfile::TempDir, Vec<PathBuf>) {
    let folder = tempfile::tempdir().expect("a folder");
    let bytes = std::fs::read(asset("pepper.ply")).expect("the sample");
    let paths: Vec<PathBuf> = (0..clouds)
        .map(|i| folder.path().join(format!("pepper{i}.ply")))
        .collect();
    for (i, path) in paths.iter().enumerate() {
        // Told apart by their hashes.
        let mut bytes = bytes.clone();
        let at = bytes
            .windows(4)
            .position(|w| w == b"ply\n" || w == b"ply\r")
            .expect("a header");
        let comment = format!("comment copy {i}\n");
        let line_end = at
            + bytes[at..]
                .iter()
                .skip(4)
                .position(|&b| b == b'\n')
                .expect("a line")
            + 5;
        bytes.splice(line_end..line_end, comment.bytes());
        std::fs::write(path, bytes).expect("it can be written");
        std::fs::copy(asset("pepper.truth.json"), path.with_extension("truth.json")).expect("copied");
    }
    (folder, paths)
}

fn annotate(app: &mut App, command: AnnotateCommand) {
    act(app, Command::Annotate(command));
}

/// The program on these clouds, in edit mode, as Ada.
fn editing(paths: &[PathBuf]) -> App {
    let mut app = app();
    app.set_view(Viewport::new(900.0, 700.0), 1.0, true);
    act(&mut app, Command::Open(paths.to_vec()));
    annotate(&mut app, AnnotateCommand::Edit(true));
    assert!(app.state().annotating.asks_name, "nobody has said a name yet");
    annotate(&mut app, AnnotateCommand::Name("Ada".into()));
    assert!(app.state().annotating.can_edit());
    app
}

/// A click in the large view.
fn click(app: &mut App, pixel: DVec2) -> DVec3 {
    let state = app.state();
    let landing = state
        .annotating
        .landing_at(pixel, &state.camera, state.viewport)
        .expect("it lands");
    annotate(app, AnnotateCommand::Place(landing));
    landing
}

const BASE_PX: DVec2 = DVec2::new(430.0, 180.0);
const BLOSSOM_PX: DVec2 = DVec2::new(470.0, 560.0);

fn set_by_clicks(app: &mut App) -> Ends {
    click(app, BASE_PX);
    click(app, BLOSSOM_PX);
    app.state().annotating.set_ends().expect("an axis")
}

fn ada() -> Author {
    Author::annotator("Ada").expect("a name")
}

fn on_disk(cloud: &Path, author: &Author) -> Option<Annotation> {
    let bytes = std::fs::read(author.axis_path(cloud, 1)).ok()?;
    Some(Annotation::from_json(&bytes).expect("an axis file"))
}

#[test]
fn two_clicks_make_an_axis_file() {
    let (_folder, paths) = folder(1);
    let mut app = editing(&paths);
    assert_eq!(app.state().annotating.next_end(), Some(Handle::PeduncleBase));
    assert_eq!(app.state().annotating.saving, Saving::Nothing);
    click(&mut app, BASE_PX);
    assert_eq!(app.state().annotating.next_end(), Some(Handle::BlossomEnd));
    assert!(on_disk(&paths[0], &ada()).is_none(), "half an axis is none");
    click(&mut app, BLOSSOM_PX);
    assert_eq!(app.state().annotating.next_end(), None);
    assert_eq!(app.state().annotating.saving, Saving::Saved);

    let annotation = on_disk(&paths[0], &ada()).expect("a file");
    assert_eq!(annotation.judgment.method, Method::ByHand);
    assert!(!annotation.judgment.blind);
    let ends = annotation.ends().expect("an axis");
    assert_eq!(Some(*ends), app.state().annotating.set_ends());
    let state = app.state();
    for (end, pixel) in [(ends.peduncle_base(), BASE_PX), (ends.blossom_end(), BLOSSOM_PX)] {
        let at = state.camera.project(end, state.viewport).expect("before the eye");
        assert!(at.distance(pixel) < 1e-6, "{at} instead of {pixel}");
    }
    // Inside the fruit: both ends are as deep as its middle, which no point of the surface is.
    let subject = state.annotating.subject.as_ref().expect("a cloud");
    let depth = state.camera.depth_of(subject.middle);
    assert!((state.camera.depth_of(ends.peduncle_base()) - depth).abs() < 1e-9);
    assert!((state.camera.depth_of(ends.blossom_end()) - depth).abs() < 1e-9);
    let truth = state
        .references
        .iter()
        .find(|r| r.source == AxisSource::Simulation);
    let apart = truth.expect("simulated").origin.distance(subject.middle);
    assert!(apart < 0.35 * subject.extent.size().length(), "{apart}");
}

#[test]
fn undo_and_redo_survive_a_new_program() {
    let (_folder, paths) = folder(1);
    let mut app = editing(&paths);
    let first = set_by_clicks(&mut app);
    for _ in 0..5 {
        annotate(&mut app, AnnotateCommand::Nudge(Turn::Picture, 1.0));
    }
    for _ in 0..2 {
        annotate(&mut app, AnnotateCommand::Undo);
    }
    let left = app.state().annotating.set_ends();
    drop(app);

    let mut app = editing(&paths);
    let reach = &app.state().annotating.reach;
    assert_eq!((reach.undo_steps(), reach.redo_steps()), (4, 2));
    let ends = app.state().annotating.set_ends();
    // Files keep as many digits as a number has.
    assert_eq!(ends, left);
    for _ in 0..3 {
        annotate(&mut app, AnnotateCommand::Undo);
    }
    assert_eq!(app.state().annotating.set_ends(), Some(first));
    annotate(&mut app, AnnotateCommand::Undo);
    assert!(app.state().annotating.judgment().is_none());
    assert!(on_disk(&paths[0], &ada()).is_none(), "what was undone is gone");
    for _ in 0..6 {
        annotate(&mut app, AnnotateCommand::Redo);
    }
    let angle = app
        .state()
        .annotating
        .set_ends()
        .expect("an axis")
        .angle_to_deg(&first);
    // Each turn is about a direction across the axis as it was.
    assert!((angle - 5.0).abs() < 1e-3, "{angle}");
}

#[test]
fn edits_are_written_before_the_program_ends() {
    let (_folder, paths) = folder(1);
    let mut app = editing(&paths);
    set_by_clicks(&mut app);
    // As fast as a held key, without a frame in between.
    for _ in 0..60 {
        app.apply(Command::Annotate(AnnotateCommand::Nudge(Turn::Lean, 0.1)));
    }
    assert_eq!(app.state().annotating.saving, Saving::Saving);
    let shown = app.state().annotating.set_ends();
    drop(app);
    assert_eq!(on_disk(&paths[0], &ada()).expect("a file").ends().copied(), shown);

    let mut app = editing(&paths);
    set_by_clicks(&mut app);
    app.apply(Command::Annotate(AnnotateCommand::Flip));
    app.finish();
    assert_eq!(app.state().annotating.saving, Saving::Saved);
}

#[test]
fn a_nudge_turns_by_as_much_as_it_says() {
    let (_folder, paths) = folder(1);
    let mut app = editing(&paths);
    let before = set_by_clicks(&mut app);
    for (turn, degrees) in [(Turn::Picture, 0.1), (Turn::Lean, 1.0), (Turn::Picture, -5.0)] {
        let before = app.state().annotating.set_ends().expect("an axis");
        annotate(&mut app, AnnotateCommand::Nudge(turn, degrees));
        let after = app.state().annotating.set_ends().expect("an axis");
        assert!((after.angle_to_deg(&before) - degrees.abs()).abs() < 1e-9);
        assert!(after.middle().distance(before.middle()) < 1e-9 * after.length());
    }
    annotate(&mut app, AnnotateCommand::SetEnds(before));
    // Clockwise as it is seen: the upper end goes to the right.
    let at = |app: &App, place| {
        app.state()
            .camera
            .project(place, app.state().viewport)
            .expect("seen")
    };
    annotate(&mut app, AnnotateCommand::Nudge(Turn::Picture, 5.0));
    let after = app.state().annotating.set_ends().expect("an axis");
    assert!(at(&app, after.peduncle_base()).x > at(&app, before.peduncle_base()).x + 5.0);
    annotate(&mut app, AnnotateCommand::SetEnds(before));
    annotate(&mut app, AnnotateCommand::Nudge(Turn::Lean, 5.0));
    let after = app.state().annotating.set_ends().expect("an axis");
    let depth = |place| app.state().camera.depth_of(place);
    assert!(
        depth(after.peduncle_base()) > depth(before.peduncle_base()),
        "away from the viewer"
    );
    // What is held stays.
    annotate(&mut app, AnnotateCommand::Hold(Pivot::BlossomEnd));
    annotate(&mut app, AnnotateCommand::Nudge(Turn::Lean, 5.0));
    let held = app.state().annotating.set_ends().expect("an axis");
    assert_eq!(held.blossom_end(), after.blossom_end());
}

#[test]
fn ends_are_dragged_in_the_plane_that_faces_the_camera() {
    let (_folder, paths) = folder(1);
    let mut app = editing(&paths);
    let before = set_by_clicks(&mut app);
    let state = app.state();
    let near = BASE_PX + DVec2::new(9.0, -8.0);
    assert_eq!(
        state.annotating.handle_at(near, &state.camera, state.viewport),
        Some(Handle::PeduncleBase)
    );
    let far = BASE_PX + DVec2::new(30.0, 0.0);
    assert_eq!(
        state.annotating.handle_at(far, &state.camera, state.viewport),
        None
    );
    annotate(
        &mut app,
        AnnotateCommand::Grab {
            handle: Handle::PeduncleBase,
            view: EditView::Main,
            at_px: near,
        },
    );
    for step in 1..=10 {
        let state = app.state();
        let grab = state.annotating.grabbed.expect("held");
        let cursor = near + f64::from(step) * DVec2::new(3.0, 1.0);
        let place = state
            .annotating
            .held_at(&grab, cursor, &state.camera, state.viewport);
        annotate(&mut app, AnnotateCommand::Drag(place));
    }
    assert_eq!(
        app.state().annotating.set_ends(),
        Some(before),
        "not before it is let go"
    );
    annotate(&mut app, AnnotateCommand::Drop);
    let after = app.state().annotating.set_ends().expect("an axis");
    assert_eq!(after.blossom_end(), before.blossom_end());
    let state = app.state();
    let at = state
        .camera
        .project(after.peduncle_base(), state.viewport)
        .expect("seen");
    assert!(at.distance(BASE_PX + DVec2::new(30.0, 10.0)) < 1e-6, "{at}");
    let depth = |place| state.camera.depth_of(place);
    assert!((depth(after.peduncle_base()) - depth(before.peduncle_base())).abs() < 1e-9);
    assert_eq!(state.annotating.reach.undo_steps(), 2, "one drag is one step");
    // Escape puts back what is held.
    annotate(
        &mut app,
        AnnotateCommand::Grab {
            handle: Handle::Middle,
            view: EditView::Side,
            at_px: near,
        },
    );
    annotate(&mut app, AnnotateCommand::Drag(after.middle() + DVec3::X));
    let moved = app.state().annotating.ends().expect("dragged");
    assert!((moved.direction() - after.direction()).length() < 1e-9);
    annotate(&mut app, AnnotateCommand::Escape);
    assert_eq!(app.state().annotating.ends(), Some(after));
}

#[test]
fn locked_views_show_the_axis_upright_and_end_on() {
    let (_folder, paths) = folder(1);
    let mut app = editing(&paths);
    let upright = app.state().annotating.locked.expect("locked views in edit mode");
    assert!(
        (upright[0].up_in_world() - DVec3::NEG_Y).length() < 1e-9,
        "no axis yet"
    );
    let ends = set_by_clicks(&mut app);
    let cameras = app.state().annotating.locked.expect("locked views");
    let viewport = Viewport::new(200.0, 200.0);
    for camera in &cameras {
        assert_eq!(camera.projection, Projection::Orthographic);
        for end in [ends.peduncle_base(), ends.blossom_end()] {
            let at = camera.project(end, viewport).expect("seen");
            assert!(
                (0.0..=200.0).contains(&at.x) && (0.0..=200.0).contains(&at.y),
                "{at}"
            );
        }
    }
    let at = |camera: usize, place| cameras[camera].project(place, viewport).expect("seen");
    for upright in [0, 1] {
        let (base, blossom) = (at(upright, ends.peduncle_base()), at(upright, ends.blossom_end()));
        assert!((base.x - blossom.x).abs() < 1e-6 && base.y < blossom.y);
    }
    assert!(at(2, ends.peduncle_base()).distance(at(2, ends.blossom_end())) < 1e-6);
    let across = cameras[0].forward_in_world().dot(cameras[1].forward_in_world());
    assert!(across.abs() < 1e-9);
    // While an end is dragged the views stay as they are.
    annotate(
        &mut app,
        AnnotateCommand::Grab {
            handle: Handle::BlossomEnd,
            view: EditView::Side,
            at_px: DVec2::ZERO,
        },
    );
    annotate(&mut app, AnnotateCommand::Drag(ends.blossom_end() + DVec3::X));
    assert_eq!(app.state().annotating.locked, Some(cameras));
    annotate(&mut app, AnnotateCommand::Drop);
    assert_ne!(app.state().annotating.locked, Some(cameras));
    let small = app.state().annotating.small_scene.as_ref().expect("a scene");
    assert!(small.points[0].positions.len() <= 20_000);
    annotate(&mut app, AnnotateCommand::Edit(false));
    assert!(app.state().annotating.locked.is_none() && app.state().annotating.small_scene.is_none());
}

#[test]
fn the_ghost_of_a_true_axis_lies_on_the_cloud() {
    let (_folder, paths) = folder(1);
    let mut app = editing(&paths);
    let before = set_by_clicks(&mut app);
    assert!(app.state().annotating.ghost_scene.is_none());
    annotate(&mut app, AnnotateCommand::Ghost(Ghost::Turned));
    let ghost_of = |app: &App| {
        let scene = app.state().annotating.ghost_scene.clone().expect("a ghost");
        assert_eq!(scene.points.len(), 2);
        (
            scene.points[0].positions.clone(),
            scene.points[1].positions.clone(),
            scene.origin_in_world,
        )
    };
    let (cloud, ghost, origin) = ghost_of(&app);
    let middle = before.middle() - origin;
    let direction = before.direction();
    for (p, q) in cloud.iter().zip(ghost.iter()).step_by(97) {
        let (p, q) = (p.as_dvec3() - middle, q.as_dvec3() - middle);
        // Turned by 180° about the axis: as far along it, and opposite across it.
        assert!((p.dot(direction) - q.dot(direction)).abs() < 1e-5);
        let across = |v: DVec3| v - v.dot(direction) * direction;
        assert!((across(p) + across(q)).length() < 1e-5);
    }
    // A small cloud's ghost follows while an end is dragged.
    let ghost_before = ghost_of(&app).1;
    annotate(
        &mut app,
        AnnotateCommand::Preview(before.shifted(DVec3::X).expect("an axis")),
    );
    assert_ne!(ghost_of(&app).1, ghost_before);
    annotate(&mut app, AnnotateCommand::Escape);
    assert_eq!(ghost_of(&app).1, ghost_before);
    annotate(&mut app, AnnotateCommand::Ghost(Ghost::Mirrored));
    let (cloud, ghost, _) = ghost_of(&app);
    let ray = app
        .state()
        .annotating
        .subject
        .as_ref()
        .expect("a cloud")
        .extent
        .center();
    let normal = direction.cross(ray).normalize();
    let (p, q) = (cloud[5].as_dvec3(), ghost[5].as_dvec3());
    assert!(((p + q) * 0.5 - middle).dot(normal).abs() < 1e-5);
    assert!((p - q).normalize_or_zero().dot(normal).abs() > 1.0 - 1e-6);
}

#[test]
fn starts_are_recorded_for_good_and_refused_in_blind_mode() {
    let (_folder, paths) = folder(1);
    let mut app = editing(&paths);
    annotate(&mut app, AnnotateCommand::Start(Method::FromComputed));
    let computed = app
        .state()
        .analysis()
        .and_then(|a| a.axis.clone())
        .expect("an axis");
    let ends = app.state().annotating.set_ends().expect("an axis");
    assert!(ends.direction().cross(computed.direction).length() < 1e-9);
    annotate(&mut app, AnnotateCommand::Nudge(Turn::Lean, 5.0));
    annotate(&mut app, AnnotateCommand::Confidence(Some(Confidence::HIGH)));
    annotate(&mut app, AnnotateCommand::Note("dented".into()));
    annotate(&mut app, AnnotateCommand::Flip);
    let annotation = on_disk(&paths[0], &ada()).expect("a file");
    assert_eq!(
        annotation.judgment.method,
        Method::FromComputed,
        "nudging does not change that"
    );
    assert_eq!(annotation.judgment.confidence, Some(Confidence::HIGH));
    assert_eq!(annotation.judgment.note, "dented");
    annotate(&mut app, AnnotateCommand::Start(Method::FromPeduncle));
    let steps = app.state().annotating.reach.undo_steps();
    annotate(&mut app, AnnotateCommand::Blind(true));
    annotate(&mut app, AnnotateCommand::Start(Method::FromComputed));
    assert_eq!(
        app.state().annotating.reach.undo_steps(),
        steps,
        "hidden in blind mode"
    );
    assert_eq!(
        on_disk(&paths[0], &ada()).expect("a file").judgment.method,
        Method::FromPeduncle
    );
    annotate(&mut app, AnnotateCommand::CannotTell);
    let annotation = on_disk(&paths[0], &ada()).expect("a file");
    assert_eq!(annotation.judgment.finding, Finding::CannotTell);
    assert_eq!(
        app.state().annotating.next_end(),
        None,
        "a click does not undo that by accident"
    );
    annotate(&mut app, AnnotateCommand::Anew);
    assert_eq!(app.state().annotating.next_end(), Some(Handle::PeduncleBase));
}

#[test]
fn blind_mode_hides_everything_computed() {
    let (_folder, paths) = folder(2);
    let mut app = app();
    app.set_view(Viewport::new(900.0, 700.0), 1.0, true);
    annotate(&mut app, AnnotateCommand::Blind(true));
    act(&mut app, Command::Open(paths.clone()));
    let look = app.state().look.clone().expect("drawn");
    assert!(look.axis.is_none() && look.reference.is_none() && look.detail.is_none());
    assert!(look.plane_index.is_none() && look.scene.polygons.is_empty() && look.scene.lines.is_empty());
    let style = app.state().shown_style();
    assert_eq!(style.coloring, Coloring::Rgb, "the side of the plane is hidden");
    for overlay in [
        Overlay::Axis,
        Overlay::Plane,
        Overlay::Reference,
        Overlay::Caption,
    ] {
        assert!(!style.overlays.has(overlay));
    }
    let camera = app.state().camera;
    for command in [
        Command::View(ViewPreset::Axis),
        Command::View(ViewPreset::Normal),
        Command::Step(1),
        Command::Annotate(AnnotateCommand::ShowAll(true)),
    ] {
        act(&mut app, command);
    }
    assert_eq!(app.state().camera, camera, "no view gives the axis away");
    assert!(!app.state().annotating.shows_all);

    annotate(&mut app, AnnotateCommand::Edit(true));
    annotate(&mut app, AnnotateCommand::Name("Ada".into()));
    set_by_clicks(&mut app);
    assert!(on_disk(&paths[0], &ada()).expect("a file").judgment.blind);
    // Whoever has once seen what is computed is not blind any more.
    annotate(&mut app, AnnotateCommand::Blind(false));
    assert!(app.state().look.as_ref().expect("drawn").axis.is_some());
    annotate(&mut app, AnnotateCommand::Blind(true));
    assert!(app.state().annotating.was_seen);
    annotate(&mut app, AnnotateCommand::Flip);
    assert!(!on_disk(&paths[0], &ada()).expect("a file").judgment.blind);
    // The next cloud was not seen.
    act(&mut app, Command::Go(1));
    assert!(!app.state().annotating.was_seen && app.state().annotating.can_edit());
    set_by_clicks(&mut app);
    assert!(on_disk(&paths[1], &ada()).expect("a file").judgment.blind);
}

#[cfg(unix)]
#[test]
fn what_cannot_be_written_is_told_at_once_and_kept() {
    let (folder, paths) = folder(2);
    // A journal that is a folder: nothing can be appended to it, whoever runs this.
    let journal = ada().journal_path(&paths[0], 1);
    let axis = ada().axis_path(&paths[0], 1).with_extension("json.probe");
    std::fs::create_dir_all(axis.join("x")).expect("a folder");
    let mut app = editing(&paths);
    let Saving::Failed(problem) = app.state().annotating.saving.clone() else {
        panic!("told before anything is set: {:?}", app.state().annotating.saving);
    };
    assert!(problem.contains("pepper0.Ada.axis.json"), "{problem}");
    std::fs::remove_dir_all(&axis).expect("removed");
    let tmp = folder.path().join("pepper0.Ada.axis.json.tmp");
    std::fs::create_dir_all(tmp.join("x")).expect("a folder");
    let ends = set_by_clicks(&mut app);
    assert!(matches!(app.state().annotating.saving, Saving::Failed(_)));
    assert_eq!(
        app.state().annotating.set_ends(),
        Some(ends),
        "it is shown all the same"
    );
    assert!(app.state().annotating.has_failed() && on_disk(&paths[0], &ada()).is_none());
    // Another cloud does not push it out.
    act(&mut app, Command::Go(1));
    assert_eq!(app.state().annotating.unsaved_elsewhere, [paths[0].clone()]);
    assert!(app.state().annotating.has_failed());
    set_by_clicks(&mut app);
    assert_eq!(app.state().annotating.saving, Saving::Saved);
    act(&mut app, Command::Go(-1));
    assert_eq!(app.state().annotating.set_ends(), Some(ends));
    std::fs::remove_dir_all(&tmp).expect("removed");
    annotate(&mut app, AnnotateCommand::TryAgain);
    assert_eq!(app.state().annotating.saving, Saving::Saved);
    assert_eq!(
        on_disk(&paths[0], &ada()).expect("a file").ends().copied(),
        Some(ends)
    );
    assert!(journal.exists() && !app.state().annotating.has_failed());
}

#[test]
fn a_cloud_that_another_program_annotates_waits() {
    let (_folder, paths) = folder(1);
    let mut first = editing(&paths);
    set_by_clicks(&mut first);
    let mut second = editing(&paths);
    assert!(
        matches!(&second.state().annotating.saving, Saving::Failed(why) if why.contains("another program"))
    );
    set_by_clicks(&mut second);
    annotate(&mut second, AnnotateCommand::Flip);
    let wanted = second.state().annotating.set_ends();
    assert!(second.state().annotating.has_failed() && wanted.is_some());
    drop(first);
    annotate(&mut second, AnnotateCommand::TryAgain);
    assert_eq!(second.state().annotating.saving, Saving::Saved);
    assert_eq!(second.state().annotating.set_ends(), wanted);
    assert_eq!(
        on_disk(&paths[0], &ada()).expect("a file").ends().copied(),
        wanted
    );
    assert_eq!(
        second.state().annotating.reach.undo_steps(),
        3,
        "the first one's edit is before them"
    );
}

#[test]
fn files_that_must_not_be_touched_are_told() {
    let (_folder, paths) = folder(1);
    let other = ada().axis_path(&paths[0], 1);
    std::fs::write(&other, "{\"half\": ").expect("written");
    let mut app = editing(&paths);
    assert!(
        app.state()
            .annotating
            .notices
            .iter()
            .any(|notice| notice.contains("is left as it is")),
        "{:?}",
        app.state().annotating.notices
    );
    set_by_clicks(&mut app);
    assert_eq!(std::fs::read_to_string(&other).expect("there"), "{\"half\": ");
    let beside = app.state().annotating.axis_file.clone().expect("a file");
    assert!(beside.ends_with("pepper0.Ada.2.axis.json") && beside.exists());
}

/// An axis of somebody else, written by the library.
fn set_as(author: &Author, cloud: &Path, ends: Ends) {
    let fruit = axiscope::io::Fruit::read(cloud, None, &axiscope::io::PeduncleChoice::Auto).expect("a cloud");
    let id = axiscope::annotate::CloudId {
        file: cloud.file_name().expect("a name").to_string_lossy().into(),
        sha256: fruit.file.sha256.clone(),
    };
    let files = Box::new(axiscope::io::DiskFiles::default());
    let (mut store, _) =
        axiscope::annotate::Store::open(files, cloud, id, fruit.unit, author.clone()).expect("open");
    store
        .edit(Judgment::by_hand(ends), "2026-03-01T12:00:00Z")
        .expect("written");
}

#[test]
fn annotators_are_compared_and_decided_between() {
    let (_folder, paths) = folder(3);
    let mut app = editing(&paths);
    let ends = set_by_clicks(&mut app);
    drop(app);
    let turned = |degrees| ends.turned(DVec3::Z, degrees, Pivot::Middle).expect("an axis");
    for (name, degrees) in [("Ben", 4.0), ("Cleo", 40.0)] {
        set_as(
            &Author::annotator(name).expect("a name"),
            &paths[0],
            turned(degrees),
        );
    }
    let mut app = editing(&paths);
    let agreement = app.state().annotating.agreement.clone().expect("compared");
    assert_eq!(agreement.pairs.len(), 3);
    assert_eq!(agreement.far_off, ["Cleo"]);
    // Each is a reference under a name of its own.
    let cleo = AxisSource::Annotator("Cleo".into());
    assert!(app.state().references.iter().any(|axis| axis.source == cleo));
    annotate(&mut app, AnnotateCommand::CompareWith(cleo.clone()));
    assert_eq!(app.state().reference().expect("one").source, cleo);
    assert_eq!(
        app.state()
            .look
            .as_ref()
            .and_then(|l| l.reference.clone())
            .expect("drawn")
            .source,
        cleo
    );
    act(&mut app, Command::Compare(TruthChoice::Peduncle));
    assert_eq!(app.state().reference().expect("one").source, AxisSource::Peduncle);

    annotate(&mut app, AnnotateCommand::Decide(Decision::Of("Ben".into())));
    assert_eq!(app.state().annotating.role, Role::Adjudicator);
    assert_eq!(app.state().annotating.set_ends(), Some(turned(4.0)));
    annotate(&mut app, AnnotateCommand::Decide(Decision::Mean));
    let adjudicator = Author::adjudicator("Ada").expect("a name");
    let annotation = on_disk(&paths[0], &adjudicator).expect("a file");
    assert_eq!(annotation.role, Role::Adjudicator);
    let mean = agreement.mean.expect("a mean").direction;
    assert!((annotation.ends().expect("an axis").direction() - mean).length() < 1e-9);
    let adjudicated = |axis: &axiscope::method::AxisEstimate| axis.source == AxisSource::Adjudicated;
    assert!(
        app.state().references.iter().any(adjudicated),
        "it is a reference at once"
    );
    assert_eq!(app.state().annotating.reach.undo_steps(), 2);
    // Leaving edit mode ends the role.
    annotate(&mut app, AnnotateCommand::Edit(false));
    assert_eq!(app.state().annotating.role, Role::Annotator);

    annotate(&mut app, AnnotateCommand::CompareSet);
    let set = app.state().annotating.set.clone().expect("compared");
    assert_eq!(set.agreement.clouds.len(), 3);
    assert_eq!(set.agreement.annotators.len(), 3);
    assert_eq!(set.agreement.clouds[0].largest_deg, agreement.largest_deg);
}

#[test]
fn the_loop_goes_from_cloud_to_cloud() {
    let (_folder, paths) = folder(4);
    let mut app = editing(&paths);
    assert_eq!(app.state().annotating.progress(), Some((0, 4)));
    set_by_clicks(&mut app);
    assert_eq!(app.state().annotating.progress(), Some((1, 4)));
    act(&mut app, Command::Go(1));
    assert!(app.state().annotating.can_edit(), "edit mode stays");
    assert!(app.state().annotating.judgment().is_none() && app.state().annotating.draft == Draft::None);
    click(&mut app, BASE_PX);
    annotate(&mut app, AnnotateCommand::NextWithout);
    assert_eq!(app.state().current, Some(2));
    assert_eq!(
        app.state().annotating.draft,
        Draft::None,
        "half an axis does not follow"
    );
    set_by_clicks(&mut app);
    annotate(&mut app, AnnotateCommand::NextWithout);
    assert_eq!(app.state().current, Some(3));
    set_by_clicks(&mut app);
    annotate(&mut app, AnnotateCommand::NextWithout);
    assert_eq!(app.state().current, Some(1), "the one that was left out");
    annotate(&mut app, AnnotateCommand::CannotTell);
    assert_eq!(app.state().annotating.progress(), Some((4, 4)));
    annotate(&mut app, AnnotateCommand::NextWithout);
    assert_eq!(app.state().current, Some(1));
    drop(app);
    let app = editing(&paths);
    assert_eq!(
        app.state().annotating.progress(),
        Some((4, 4)),
        "told from the files"
    );
}

#[test]
fn escape_leaves_one_thing_at_a_time() {
    let (_folder, paths) = folder(1);
    let mut app = editing(&paths);
    click(&mut app, BASE_PX);
    annotate(&mut app, AnnotateCommand::Escape);
    assert_eq!(app.state().annotating.draft, Draft::None);
    assert!(app.state().annotating.is_editing);
    annotate(&mut app, AnnotateCommand::Escape);
    assert!(!app.state().annotating.is_editing);
    // Outside of edit mode nothing sets anything.
    annotate(&mut app, AnnotateCommand::Place(DVec3::ONE));
    annotate(&mut app, AnnotateCommand::CannotTell);
    assert!(app.state().annotating.judgment().is_none());
    assert!(on_disk(&paths[0], &ada()).is_none());
}

#[test]
fn another_tool_ends_edit_mode() {
    let (_folder, paths) = folder(1);
    let mut app = editing(&paths);
    act(&mut app, Command::Use(Tool::MoveCenter));
    assert!(!app.state().annotating.is_editing && app.state().tool == Tool::MoveCenter);
    annotate(&mut app, AnnotateCommand::Edit(true));
    assert!(app.state().annotating.is_editing && app.state().tool == Tool::Navigate);
}

#[test]
fn a_sample_has_no_folder_for_an_axis() {
    let mut app = app();
    act(&mut app, Command::OpenSample(Sample::Pepper));
    annotate(&mut app, AnnotateCommand::Edit(true));
    assert!(!app.state().annotating.is_editing && !app.state().annotating.asks_name);
    assert!(
        app.state()
            .messages
            .iter()
            .any(|message| message.text.contains("sample"))
    );
}

#[test]
fn the_name_and_blindness_are_kept_in_the_session() {
    let (_folder, paths) = folder(1);
    let mut app = editing(&paths);
    annotate(&mut app, AnnotateCommand::Blind(true));
    annotate(&mut app, AnnotateCommand::Step(2));
    let session = Session::of(app.state());
    let again = App::new(session, &(std::sync::Arc::new(|| {}) as _)).expect("threads start");
    let annotating = &again.state().annotating;
    assert_eq!(annotating.name, "Ada");
    assert!(annotating.is_blind && !annotating.is_editing);
    assert_eq!(annotating.step_deg(), 5.0);
}

#[test]
fn a_name_that_cannot_be_one_begins_nothing() {
    let (_folder, paths) = folder(1);
    let mut app = app();
    act(&mut app, Command::Open(paths));
    annotate(&mut app, AnnotateCommand::Edit(true));
    annotate(&mut app, AnnotateCommand::Name("12".into()));
    assert!(!app.state().annotating.is_editing && app.state().annotating.asks_name);
    annotate(&mut app, AnnotateCommand::WithoutName);
    assert!(!app.state().annotating.asks_name);
    settle(&mut app);
    app.update(Duration::ZERO);
}

#[test]
fn a_cloud_that_cannot_be_analyzed_can_be_annotated() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("few.ply");
    let head = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
    std::fs::write(&path, format!("{head}0 0 50\n0 4 51\n")).expect("written");
    let mut app = editing(std::slice::from_ref(&path));
    assert!(app.state().walked.is_none() && app.state().look.is_some());
    set_by_clicks(&mut app);
    assert!(on_disk(&path, &ada()).is_some());
    annotate(&mut app, AnnotateCommand::Start(Method::FromComputed));
    assert!(
        app.state()
            .messages
            .iter()
            .any(|message| message.text.contains("not analyzed"))
    );
}

#[test]
fn clicks_land_as_deep_as_the_fruit_s_axis_truly_lies() {
    let (_folder, paths) = folder(1);
    let mut app = app();
    act(&mut app, Command::Open(paths));
    let state = app.state();
    let subject = state.annotating.subject.as_ref().expect("a cloud");
    let truth = state
        .references
        .iter()
        .find(|r| r.source == AxisSource::Simulation);
    let truth = truth.expect("simulated");
    let ray = (subject.extent.center() - subject.viewpoint).normalize();
    let off = (subject.middle - truth.origin).dot(ray).abs();
    // In centimeters; the fruit is some 8 wide.
    assert!(off < 1.5, "{off}");
}
