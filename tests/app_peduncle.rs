//! Picking the peduncle without a window: strokes, growing, undo, companions, and what is told of them.

mod driving;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use axiscope::app::peduncle::Question;
use axiscope::app::{App, Command, PeduncleCommand, Session, Tool, command_line};
use axiscope::evaluate::{Request, TruthChoice, peduncle_disagreement_deg};
use axiscope::geometry::{Cloud, PointSet};
use axiscope::io::ply::{WriteOptions, write};
use axiscope::io::{PeduncleChoice, PickedPoints, read_cloud};
use axiscope::method::AxisSource;
use axiscope::reference::{HueRange, Peduncle, PeduncleSource, axis_error_rad};
use axiscope::render::Viewport;
use axiscope::view::{Coloring, PEDUNCLE_MARK, ViewPreset};
use driving::{act, app, asset, settle, with_sample};
use glam::DVec2;
use tempfile::TempDir;

fn ask(app: &mut App, command: PeduncleCommand) {
    act(app, Command::Peduncle(command));
}

/// Drags a tool along a path in the view, from button down to button up.
fn drag(app: &mut App, removes: bool, path_px: &[DVec2]) {
    for &at_px in path_px {
        app.apply(Command::Peduncle(PeduncleCommand::Draw { at_px, removes }));
        app.update(std::time::Duration::from_millis(16));
    }
    ask(app, PeduncleCommand::EndStroke);
}

/// A copy of the bundled pepper without labels, colors and normals, in a folder of its own.
fn bare_pepper(folder: &TempDir) -> PathBuf {
    let cloud = read_cloud(asset("pepper.ply")).expect("the sample").ply.cloud;
    write_cloud(
        &Cloud::new(cloud.positions().to_vec()),
        &folder.path().join("bare.ply"),
    )
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

fn open(path: &Path) -> App {
    let mut app = app();
    app.set_view(Viewport::new(800.0, 600.0), 1.0, true);
    act(&mut app, Command::Open(vec![path.to_owned()]));
    act(&mut app, Command::View(ViewPreset::Camera));
    app
}

/// A line around the places at which these points show, with room.
fn around(app: &App, points: &PointSet) -> Vec<DVec2> {
    let cloud = app
        .state()
        .walked
        .as_ref()
        .expect("analyzed")
        .fruit
        .cloud()
        .clone();
    let (camera, viewport) = (app.state().camera, app.state().viewport);
    let pixels: Vec<DVec2> = points
        .iter()
        .filter_map(|i| camera.project(cloud.positions()[i], viewport))
        .collect();
    let low = pixels.iter().copied().fold(DVec2::INFINITY, DVec2::min) - 2.0;
    let high = pixels.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max) + 2.0;
    vec![low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)]
}

/// The points that the bundled pepper's labels call its peduncle.
fn labeled() -> PointSet {
    let cloud = read_cloud(asset("pepper.ply")).expect("the sample").ply.cloud;
    let peduncle = Peduncle::by_label(&cloud).expect("labeled");
    peduncle.in_cloud.into_iter().collect()
}

fn picked(app: &App) -> PointSet {
    app.state()
        .picked_peduncle()
        .map(|p| (**p).clone())
        .expect("picked")
}

fn choice(app: &App) -> PeduncleChoice {
    app.state().settings.request.peduncle.clone()
}

/// These points of the current cloud are its peduncle.
fn pick(app: &mut App, points: &PointSet) {
    let sha256 = app
        .state()
        .walked
        .as_ref()
        .expect("analyzed")
        .fruit
        .file
        .sha256
        .clone();
    let picked = PickedPoints::default().with(&sha256, Arc::new(points.clone()));
    ask(app, PeduncleCommand::Choose(PeduncleChoice::Points(picked)));
}

/// How many points are drawn in the highlight's color.
fn highlighted(app: &App) -> usize {
    let scene = app.state().drawn_scene().expect("drawn");
    let colors = scene.points[0].colors.iter();
    colors.filter(|c| **c == PEDUNCLE_MARK).count()
}

#[test]
fn a_lasso_around_the_peduncle_of_a_bare_cloud_gives_its_references() {
    let folder = TempDir::new().expect("a folder");
    let mut app = open(&bare_pepper(&folder));
    assert!(app.state().references.is_empty(), "nothing tells its peduncle");
    act(&mut app, Command::Use(Tool::Lasso));
    assert_eq!(highlighted(&app), 0);
    let path = around(&app, &labeled());
    drag(&mut app, false, &path);
    let found = app
        .state()
        .walked
        .as_ref()
        .expect("analyzed")
        .fruit
        .peduncle
        .clone();
    let found = found.expect("picked");
    assert_eq!(found.source, PeduncleSource::Picked);
    assert_eq!(found.in_cloud, picked(&app).iter().collect::<Vec<_>>());
    assert!(
        labeled().iter().all(|i| picked(&app).contains(i)),
        "all that was gone around"
    );
    assert_eq!(highlighted(&app), found.points);
    let sources: Vec<_> = app.state().references.iter().map(|r| r.source.clone()).collect();
    assert_eq!(sources, [AxisSource::Peduncle, AxisSource::PeduncleDirection]);
    assert!(app.state().peduncle.strokes.is_empty() && !app.state().is_stale);
}

#[test]
fn a_stroke_shows_before_the_button_is_let_go_and_is_one_step_of_undo() {
    let folder = TempDir::new().expect("a folder");
    let mut app = open(&bare_pepper(&folder));
    act(&mut app, Command::Use(Tool::Brush));
    ask(&mut app, PeduncleCommand::BrushRadius(30.0));
    let path = around(&app, &labeled());
    for &at_px in &path {
        act(
            &mut app,
            Command::Peduncle(PeduncleCommand::Draw {
                at_px,
                removes: false,
            }),
        );
    }
    assert!(highlighted(&app) > 10, "{}", highlighted(&app));
    assert_eq!(choice(&app), PeduncleChoice::Auto, "nothing is analyzed yet");
    assert!(!app.state().can_undo);
    ask(&mut app, PeduncleCommand::EndStroke);
    let first = picked(&app);
    let second = around(&app, &first);
    drag(&mut app, true, &second[..2]);
    assert!(picked(&app).len() < first.len());
    act(&mut app, Command::Undo);
    assert_eq!(picked(&app), first);
    act(&mut app, Command::Undo);
    assert_eq!(choice(&app), PeduncleChoice::Auto);
    assert!(!app.state().can_undo);
    act(&mut app, Command::Redo);
    assert_eq!(picked(&app), first);
}

#[test]
fn a_stroke_that_is_dropped_or_changes_nothing_is_no_step() {
    let mut app = with_sample();
    app.set_view(Viewport::new(800.0, 600.0), 1.0, true);
    act(&mut app, Command::Use(Tool::Lasso));
    let before = app.state().settings.clone();
    drag(
        &mut app,
        false,
        &[DVec2::new(3.0, 3.0), DVec2::new(9.0, 3.0), DVec2::new(5.0, 9.0)],
    );
    assert_eq!(app.state().settings, before, "nothing is in the corner");
    for at in [(100.0, 100.0), (700.0, 100.0), (400.0, 500.0)] {
        let at_px = DVec2::from(at);
        act(
            &mut app,
            Command::Peduncle(PeduncleCommand::Draw {
                at_px,
                removes: false,
            }),
        );
    }
    let count = labeled().len();
    assert!(highlighted(&app) > count);
    ask(&mut app, PeduncleCommand::DropStroke);
    assert_eq!(highlighted(&app), count, "the labels' peduncle is back");
    assert_eq!(app.state().settings, before);
    assert!(!app.state().can_undo);
}

#[test]
fn picking_begins_with_the_peduncle_that_there_is() {
    let mut app = with_sample();
    app.set_view(Viewport::new(800.0, 600.0), 1.0, true);
    act(&mut app, Command::View(ViewPreset::Camera));
    act(&mut app, Command::Use(Tool::Lasso));
    assert_eq!(highlighted(&app), labeled().len());
    // Nothing of the fruit is near its peduncle here: half of it grows into the other half.
    let half: PointSet = labeled().iter().step_by(2).collect();
    pick(&mut app, &half);
    ask(&mut app, PeduncleCommand::Grow);
    let grown = picked(&app);
    assert!(half.iter().all(|i| grown.contains(i)) && grown.len() > half.len());
    assert!(grown.iter().all(|i| labeled().contains(i)));
    pick(&mut app, &half);
    ask(&mut app, PeduncleCommand::Shrink);
    assert!(picked(&app).iter().all(|i| half.contains(i)) && picked(&app).len() < half.len());
    // Pressed quickly, each press counts.
    let few: PointSet = labeled().iter().take(1).collect();
    let mut sizes = Vec::new();
    for presses in [1, 3] {
        pick(&mut app, &few);
        for _ in 0..presses {
            app.apply(Command::Peduncle(PeduncleCommand::Grow));
        }
        settle(&mut app);
        sizes.push(picked(&app).len());
    }
    assert!(1 < sizes[0] && sizes[0] < sizes[1], "{sizes:?}");
    while app.state().can_undo {
        act(&mut app, Command::Undo);
    }
    assert_eq!(choice(&app), PeduncleChoice::Auto);
    let count = app.state().shown().expect("points").len();
    ask(&mut app, PeduncleCommand::Invert);
    assert_eq!(picked(&app).len(), count - labeled().len());
    ask(&mut app, PeduncleCommand::Clear);
    assert!(
        picked(&app).is_empty()
            && app
                .state()
                .walked
                .as_ref()
                .expect("analyzed")
                .fruit
                .peduncle
                .is_none()
    );
}

#[test]
fn what_is_picked_belongs_to_its_cloud_alone() {
    let folder = TempDir::new().expect("a folder");
    let bare = bare_pepper(&folder);
    let mut app = open(&bare);
    act(&mut app, Command::Use(Tool::Lasso));
    let path = around(&app, &labeled());
    drag(&mut app, false, &path);
    let first = picked(&app);
    act(&mut app, Command::Open(vec![asset("pepper.ply")]));
    assert_eq!(app.state().picked_peduncle(), None);
    let fruit = &app.state().walked.as_ref().expect("analyzed").fruit;
    assert_eq!(
        fruit.peduncle.as_ref().map(|p| p.source),
        Some(PeduncleSource::Label)
    );
    ask(&mut app, PeduncleCommand::Invert);
    assert!(picked(&app).len() > labeled().len());
    act(&mut app, Command::Go(-1));
    assert_eq!(picked(&app), first, "the first one's is still there");
    // And after a restart.
    let text = serde_json::to_string(&Session::of(app.state())).expect("plain data");
    let back: Session = serde_json::from_str(&text).expect("its own text");
    assert_eq!(back.settings, app.state().settings);
    assert!(
        text.len() < 20_000,
        "{} bytes: runs of points stay short",
        text.len()
    );
}

#[test]
fn the_label_coloring_shows_what_was_picked() {
    let folder = TempDir::new().expect("a folder");
    let mut app = open(&bare_pepper(&folder));
    let mut style = app.state().style.clone();
    style.coloring = Coloring::Label;
    act(&mut app, Command::Style(Box::new(style)));
    assert!(
        app.state().look.as_ref().expect("drawn").fallback.is_some(),
        "no labels"
    );
    act(&mut app, Command::Use(Tool::Lasso));
    let path = around(&app, &labeled());
    drag(&mut app, false, &path);
    let look = app.state().look.clone().expect("drawn");
    assert!(look.fallback.is_none());
    let swatch = look
        .legend
        .swatches
        .iter()
        .find(|s| s.label == "peduncle")
        .expect("it is told");
    assert_eq!(swatch.count.map(|c| c.0), Some(picked(&app).len()));
}

#[test]
fn a_voxel_grid_highlights_what_stands_for_picked_points() {
    let mut app = with_sample();
    let mut request = app.state().settings.request.clone();
    request.params.filters.voxel_cm = Some(0.3);
    set(&mut app, request);
    act(&mut app, Command::Use(Tool::Lasso));
    let shown = app.state().shown().expect("points").clone();
    let in_file = shown.in_file.as_ref().expect("they stand for others");
    let expected = in_file.iter().filter(|&&i| labeled().contains(i)).count();
    assert!(expected > 3);
    assert_eq!(highlighted(&app), expected);
}

fn set(app: &mut App, request: Request) {
    let request = Box::new(request);
    act(
        app,
        Command::Set {
            request,
            gesture: None,
        },
    );
}

#[test]
fn a_saved_companion_gives_the_same_references_in_the_window_and_on_the_command_line() {
    let folder = TempDir::new().expect("a folder");
    let bare = bare_pepper(&folder);
    let mut app = open(&bare);
    act(&mut app, Command::Use(Tool::Lasso));
    let path = around(&app, &labeled());
    drag(&mut app, false, &path);
    let has_peduncle =
        |app: &App| command_line(app.state(), "a.png", [9, 9]).contains(&"--peduncle".to_owned());
    assert!(app.state().has_unsaved_peduncle() && !has_peduncle(&app));
    ask(&mut app, PeduncleCommand::Save);
    let companion = folder.path().join("bare_peduncle.ply");
    assert_eq!(app.state().saved_peduncle(), Some(&*companion));
    let words = command_line(app.state(), "a.png", [9, 9]);
    let at = words.iter().position(|w| w == "--peduncle").expect("it is named");
    assert_eq!(words[at + 1], companion.display().to_string());
    assert!(!folder.path().join("bare_peduncle.ply.tmp").exists());
    let by_hand = app.state().references.clone();

    let ran = assert_cmd::Command::new(env!("CARGO_BIN_EXE_axiscope"))
        .args(["analyze", "--format", "json"])
        .arg(&bare)
        .assert()
        .success();
    let report: serde_json::Value = serde_json::from_slice(&ran.get_output().stdout).expect("JSON");
    let references = report["references"].as_array().expect("a list");
    assert_eq!(references.len(), 2);
    for (reference, axis) in references.iter().zip(&by_hand) {
        assert_eq!(reference["kind"], *axis.source.name());
        for (i, part) in axis.direction.to_array().into_iter().enumerate() {
            assert!((reference["direction"][i].as_f64().expect("a number") - part).abs() < 1e-9);
        }
    }
    let apart = peduncle_disagreement_deg(&by_hand).expect("both");
    assert!((report["peduncle_disagreement_deg"].as_f64().expect("a number") - apart).abs() < 1e-6);

    // What changes is not saved any more, and what comes back is.
    ask(&mut app, PeduncleCommand::Invert);
    assert!(app.state().has_unsaved_peduncle() && !has_peduncle(&app));
    act(&mut app, Command::Undo);
    assert_eq!(app.state().saved_peduncle(), Some(&*companion));
}

#[test]
fn nothing_is_replaced_without_being_asked_and_nothing_is_lost_where_it_cannot_be_saved() {
    let folder = TempDir::new().expect("a folder");
    let bare = bare_pepper(&folder);
    let companion = folder.path().join("bare_peduncle.ply");
    let mut app = open(&bare);
    ask(&mut app, PeduncleCommand::Save);
    assert!(
        app.state()
            .messages
            .iter()
            .any(|m| m.text.contains("nothing to save"))
    );
    act(&mut app, Command::Use(Tool::Lasso));
    let path = around(&app, &labeled());
    drag(&mut app, false, &path);
    std::fs::write(&companion, "somebody's work").expect("written");
    ask(&mut app, PeduncleCommand::Save);
    assert_eq!(
        app.state().peduncle.question,
        Some(Question::Replace(companion.clone()))
    );
    assert_eq!(
        std::fs::read_to_string(&companion).expect("there"),
        "somebody's work"
    );
    ask(&mut app, PeduncleCommand::Dismiss);
    assert_eq!(app.state().peduncle.question, None);
    let nowhere = folder.path().join("no/such/folder/x.ply");
    let before = picked(&app);
    ask(&mut app, PeduncleCommand::SaveAs(nowhere.clone()));
    let message = app.state().messages.last().expect("it is told").clone();
    assert!(
        message.is_error && message.text.contains(&nowhere.display().to_string()),
        "{}",
        message.text
    );
    assert!(app.state().has_unsaved_peduncle());
    assert_eq!(picked(&app), before);
    // A folder of that name is in the way.
    std::fs::remove_file(&companion).expect("removed");
    std::fs::create_dir(&companion).expect("made");
    ask(&mut app, PeduncleCommand::SaveAs(companion.clone()));
    assert!(app.state().messages.last().expect("told").is_error && app.state().has_unsaved_peduncle());
    assert!(
        !folder.path().join("bare_peduncle.ply.tmp").exists(),
        "no half is left behind"
    );
    std::fs::remove_dir(&companion).expect("removed");
    ask(&mut app, PeduncleCommand::SaveAs(companion.clone()));
    assert_eq!(app.state().saved_peduncle(), Some(&*companion));
}

#[test]
fn a_sample_s_peduncle_is_saved_elsewhere() {
    let folder = TempDir::new().expect("a folder");
    let mut app = with_sample();
    ask(&mut app, PeduncleCommand::Save);
    assert!(app.state().messages.iter().any(|m| m.text.contains("sample")));
    let path = folder.path().join("mine.ply");
    ask(&mut app, PeduncleCommand::SaveAs(path.clone()));
    assert_eq!(
        read_cloud(&path).expect("a cloud").ply.cloud.len(),
        labeled().len()
    );
}

#[test]
fn a_range_of_hues_is_previewed_and_an_empty_one_is_told() {
    let mut app = with_sample();
    let mut request = app.state().settings.request.clone();
    let cloud = app
        .state()
        .walked
        .as_ref()
        .expect("analyzed")
        .fruit
        .cloud()
        .clone();
    let range = HueRange {
        from_deg: 70.0,
        to_deg: 160.0,
    };
    request.peduncle = PeduncleChoice::Hue(range);
    set(&mut app, request.clone());
    let hues = app.state().peduncle.hues.clone().expect("counted");
    assert_eq!(hues.counts.iter().sum::<usize>() + hues.gray, cloud.len());
    assert_eq!(highlighted(&app), 0, "nobody asked for it");
    ask(&mut app, PeduncleCommand::Preview(true));
    let expected = Peduncle::by_hue(&cloud, range).expect("some are green").points;
    assert_eq!(highlighted(&app), expected);
    assert_eq!(
        app.state().peduncle.marked.as_ref().expect("marked").points,
        expected
    );
    request.peduncle = PeduncleChoice::Hue(HueRange {
        from_deg: 280.0,
        to_deg: 281.0,
    });
    set(&mut app, request);
    assert_eq!(highlighted(&app), 0);
    let walked = app.state().walked.as_ref().expect("the cloud is still there");
    let problem = walked.fruit.peduncle_problem.as_ref().expect("it is told");
    assert!(problem.contains("280"), "{problem}");
    assert!(app.state().look.is_some() && app.state().entries[0].problem.is_none());
    ask(&mut app, PeduncleCommand::Preview(false));
    assert!(app.state().peduncle.marked.is_none());
}

#[test]
fn a_folder_without_peduncles_tells_what_it_lacks_and_what_does_not_fit() {
    let folder = TempDir::new().expect("a folder");
    let cloud = read_cloud(asset("pepper.ply")).expect("the sample").ply.cloud;
    let full = write_cloud(
        &Cloud::new(cloud.positions().to_vec()),
        &folder.path().join("a.ply"),
    );
    let removed = folder.path().join("removed");
    std::fs::create_dir(&removed).expect("made");
    let body: Vec<usize> = (0..cloud.len()).filter(|&i| !labeled().contains(i)).collect();
    write_cloud(&cloud.select(&body), &removed.join("a.ply"));
    let mut app = open(&full);
    ask(
        &mut app,
        PeduncleCommand::Choose(PeduncleChoice::Removed(removed.clone())),
    );
    let fruit = app.state().walked.as_ref().expect("analyzed").fruit.clone();
    let found = fruit.peduncle.as_ref().expect("found");
    assert_eq!(
        (found.source, found.points),
        (PeduncleSource::Removal, labeled().len())
    );
    // Another fruit under the same name.
    std::fs::copy(asset("ellipsoid.ply"), removed.join("a.ply")).expect("copied");
    act(&mut app, Command::Reload);
    let fruit = app.state().walked.as_ref().expect("still analyzed").fruit.clone();
    assert!(fruit.peduncle.is_none());
    let problem = fruit.peduncle_problem.as_ref().expect("told");
    assert!(problem.contains("not the same cloud"), "{problem}");
    ask(
        &mut app,
        PeduncleCommand::Choose(PeduncleChoice::File("no/such.ply".into())),
    );
    let fruit = app.state().walked.as_ref().expect("still analyzed").fruit.clone();
    assert!(
        fruit
            .peduncle_problem
            .as_ref()
            .expect("told")
            .contains("no/such.ply")
    );
}

#[test]
fn a_dropped_companion_is_offered() {
    let folder = TempDir::new().expect("a folder");
    let mut app = open(&bare_pepper(&folder));
    let dropped = folder.path().join("other_peduncle.ply");
    let cloud = read_cloud(asset("pepper.ply")).expect("the sample").ply.cloud;
    write_cloud(&cloud.select(&labeled().iter().collect::<Vec<_>>()), &dropped);
    ask(&mut app, PeduncleCommand::Offer(dropped.clone()));
    assert_eq!(
        app.state().peduncle.question,
        Some(Question::Offer(dropped.clone()))
    );
    assert_eq!(app.state().entries.len(), 1);
    ask(&mut app, PeduncleCommand::Choose(PeduncleChoice::File(dropped)));
    assert_eq!(app.state().peduncle.question, None);
    let fruit = &app.state().walked.as_ref().expect("analyzed").fruit;
    assert_eq!(fruit.peduncle.as_ref().map(|p| p.points), Some(labeled().len()));
}

#[test]
fn with_and_without_the_peduncle_stand_side_by_side() {
    let mut app = with_sample();
    ask(&mut app, PeduncleCommand::Compare(true));
    let beside = app.state().peduncle.beside.clone().expect("computed");
    for (without_peduncle, errors) in [(false, beside.with), (true, beside.without)] {
        let mut request = app.state().settings.request.clone();
        request.without_peduncle = without_peduncle;
        set(&mut app, request);
        let state = app.state();
        let axis = state.analysis().and_then(|a| a.axis.clone()).expect("an axis");
        let expected: Vec<_> = state
            .references
            .iter()
            .map(|r| (r.source.clone(), axis_error_rad(&axis, r).to_degrees()))
            .collect();
        assert_eq!(expected.len(), 3);
        assert_eq!(errors, Ok(expected));
        assert!(state.peduncle.beside.is_some(), "it is of either");
    }
    let mut request = app.state().settings.request.clone();
    request.params.u = 9;
    set(&mut app, request);
    assert!(app.state().peduncle.beside.is_some(), "computed again by itself");
    ask(&mut app, PeduncleCommand::Compare(false));
    assert!(app.state().peduncle.beside.is_none());
}

#[test]
fn errors_are_measured_against_the_peduncle_s_own_direction_where_that_is_asked_for() {
    let mut app = with_sample();
    act(&mut app, Command::Compare(TruthChoice::PeduncleDirection));
    let source = |app: &App| app.state().reference().map(|r| r.source.clone());
    assert_eq!(source(&app), Some(AxisSource::PeduncleDirection));
    let look = app.state().look.as_ref().expect("drawn");
    assert_eq!(look.reference.as_ref().map(|r| r.source.clone()), source(&app));
    let words = command_line(app.state(), "a.png", [9, 9]);
    assert!(
        words
            .windows(2)
            .any(|w| w == ["--reference", "peduncle-direction"])
    );
}
