//! The program behind the window: what commands do to the state, without a window.

use std::path::PathBuf;
use std::time::Duration;

use crate::helpers::driving::{act, app, asset, settle, with_sample, write_cloud};
use axiscope::app::command_line;
use axiscope::app::{App, Command, PlaneChoice, Sample, Session, SessionError, Source, Tool, quoted};
use axiscope::fruit::Request;
use axiscope::method::{Aggregation, CenterMethod, Params, Preset, RandomSearch, analyze};
use axiscope::render::Viewport;
use axiscope::view::{Coloring, Overlay, Theme, ViewPreset};
use glam::{DVec2, DVec3};

fn request(app: &App) -> Request {
    app.state().settings.request.clone()
}

fn set(app: &mut App, change: impl FnOnce(&mut Request)) {
    let mut request = request(app);
    change(&mut request);
    act(
        app,
        Command::Set {
            request: Box::new(request),
            gesture: None,
        },
    );
}

#[test]
fn the_sample_comes_analyzed_as_the_library_does() {
    let app = with_sample();
    let walked = app.state().walked.as_ref().expect("analyzed");
    let direct = analyze(walked.fruit.cloud(), &walked.analysis.params, &()).expect("a pepper");
    assert_eq!(walked.analysis.planes, direct.planes);
    assert_eq!(walked.analysis.center, direct.center);
    let look = app.state().look.as_ref().expect("drawn");
    assert_eq!(look.plane_index, direct.ranking.best().ok());
    assert_eq!(look.scene.points[0].positions.len(), walked.fruit.cloud().len());
    assert!(!app.state().is_stale && !app.state().is_look_pending);
    // Its truth and its labels, which give two references, come with it.
    assert_eq!(app.state().references.len(), 3);
}

#[test]
fn scoring_takes_effect_in_the_frame_that_asks_for_it() {
    let mut app = with_sample();
    let planes = app.state().analysis().expect("analyzed").planes.clone();
    let mut wanted = request(&app);
    wanted.params.tau_cm_per_rad = 0.0;
    wanted.params.aggregation = Aggregation::Sum;
    wanted.params.min_partner_fraction = 0.5;
    app.apply(Command::Set {
        request: Box::new(wanted),
        gesture: None,
    });
    app.update(Duration::ZERO);
    let analysis = app.state().analysis().expect("analyzed");
    assert!(
        std::sync::Arc::ptr_eq(&planes, &analysis.planes),
        "nothing is computed again"
    );
    assert_eq!(analysis.params.tau_cm_per_rad, 0.0);
    let best = analysis.ranking.best().expect("one has half of the points");
    let sum = analysis.planes.terms[best].distance_sum_cm;
    assert_eq!(analysis.ranking.scores_cm()[best], Some(sum));
    assert!(!app.state().is_stale);
}

#[test]
fn the_error_is_taken_apart_with_the_true_center_in_the_frame_that_asks_for_it() {
    let mut app = with_sample();
    let check = |app: &App| {
        let walked = app.state().walked.as_ref().expect("analyzed");
        let truth = walked.fruit.truth.as_ref().expect("a sample has its truth");
        let params = walked.analysis.params.with_center(truth.center);
        let direct = analyze(walked.fruit.cloud(), &params, &()).expect("a pepper");
        assert_eq!(walked.at_true_center.as_deref(), Some(&direct));
        let parts = app.state().error_breakdown().expect("there is a reference");
        let choice = parts.choice_part_deg.expect("an axis");
        let sum = parts.lean_part_deg + parts.grid_part_deg + choice;
        assert!((sum - parts.error_deg.expect("an axis")).abs() < 1e-9);
        assert!(parts.true_center.is_some());
        parts
    };
    let before = check(&app);
    let mut wanted = request(&app);
    wanted.params.tau_cm_per_rad = 0.0;
    wanted.params.aggregation = Aggregation::Sum;
    app.apply(Command::Set {
        request: Box::new(wanted),
        gesture: None,
    });
    app.update(Duration::ZERO);
    assert!(!app.state().is_stale);
    let after = check(&app);
    assert_eq!(
        before.lean_part_deg, after.lean_part_deg,
        "scores do not change it"
    );
    set(&mut app, |request| request.params.u = 9);
    check(&app);
}

#[test]
fn a_finer_grid_keeps_the_direction_that_is_looked_at() {
    let mut app = with_sample();
    act(&mut app, Command::LookAt(PlaneChoice::At { g: 2, h: 5 }));
    let normal = |app: &App| {
        let analysis = app.state().analysis().expect("analyzed");
        let index = app.state().chosen_plane_index().expect("a plane");
        analysis.planes.grid.candidate(index).normal
    };
    let before = normal(&app);
    set(&mut app, |r| r.params.u = 15);
    assert_eq!(app.state().analysis().expect("analyzed").planes.grid.u(), 15);
    let angle = axiscope::geometry::angle_between_lines_rad(before, normal(&app)).to_degrees();
    assert!(angle < 9.0, "{angle}° away");
    // The best plane stays the best plane, whichever it is.
    act(&mut app, Command::LookAt(PlaneChoice::Best));
    set(&mut app, |r| r.params.u = 6);
    assert_eq!(app.state().settings.plane, PlaneChoice::Best);
}

#[test]
fn a_grid_that_was_there_before_comes_back_at_once() {
    let mut app = with_sample();
    set(&mut app, |r| r.params.u = 9);
    let mut wanted = request(&app);
    wanted.params.u = 6;
    app.apply(Command::Set {
        request: Box::new(wanted),
        gesture: None,
    });
    app.update(Duration::ZERO);
    assert_eq!(app.state().analysis().expect("analyzed").planes.grid.u(), 6);
    assert!(!app.state().is_stale);
}

#[test]
fn one_drag_is_one_step_back() {
    let mut app = with_sample();
    let first = request(&app);
    for tau in [0.5, 0.4, 0.3] {
        let mut wanted = request(&app);
        wanted.params.tau_cm_per_rad = tau;
        app.apply(Command::Set {
            request: Box::new(wanted),
            gesture: Some("tau"),
        });
    }
    app.apply(Command::EndGesture);
    set(&mut app, |r| r.params.u = 8);
    let last = request(&app);
    act(&mut app, Command::Undo);
    assert_eq!(
        (request(&app).params.u, request(&app).params.tau_cm_per_rad),
        (6, 0.3)
    );
    act(&mut app, Command::Undo);
    assert_eq!(request(&app), first);
    assert!(!app.state().can_undo && app.state().can_redo);
    act(&mut app, Command::Undo);
    act(&mut app, Command::Redo);
    act(&mut app, Command::Redo);
    assert_eq!(request(&app), last);
    assert!(!app.state().can_redo);
    // Something new leaves nothing to redo.
    act(&mut app, Command::Undo);
    set(&mut app, |r| r.params.u = 7);
    assert!(!app.state().can_redo);
}

#[test]
fn the_newest_request_wins() {
    let mut app = with_sample();
    for u in [30, 40, 50, 7] {
        let mut wanted = request(&app);
        wanted.params.u = u;
        app.apply(Command::Set {
            request: Box::new(wanted),
            gesture: None,
        });
        app.update(Duration::ZERO);
    }
    settle(&mut app);
    assert_eq!(app.state().analysis().expect("analyzed").planes.grid.u(), 7);
}

#[test]
fn old_results_stay_until_new_ones_come_and_work_can_be_called_off() {
    let mut app = with_sample();
    let mut wanted = request(&app);
    wanted.params.u = 200;
    app.apply(Command::Set {
        request: Box::new(wanted),
        gesture: None,
    });
    app.update(Duration::ZERO);
    assert!(app.state().is_stale && app.state().progress.is_some());
    assert_eq!(app.state().analysis().expect("the old one").planes.grid.u(), 6);
    act(&mut app, Command::Cancel);
    assert!(app.state().was_cancelled && app.state().is_stale);
    assert_eq!(app.state().analysis().expect("the old one").planes.grid.u(), 6);
    act(&mut app, Command::Undo);
    assert!(!app.state().was_cancelled && !app.state().is_stale);
}

#[test]
fn presets_change_the_reading_and_nothing_else() {
    let mut app = with_sample();
    set(&mut app, |r| {
        r.params.u = 7;
        r.params.tau_cm_per_rad = 0.2;
    });
    act(&mut app, Command::UsePreset(Preset::AsPrinted));
    let params = request(&app).params;
    assert_eq!(params.preset(), Some(Preset::AsPrinted));
    assert_eq!((params.u, params.tau_cm_per_rad), (7, 0.2));
    assert_eq!(
        app.state().analysis().expect("analyzed").params.aggregation,
        Aggregation::Sum
    );
}

#[test]
fn planes_are_stepped_through_in_either_order() {
    let mut app = with_sample();
    act(&mut app, Command::LookAt(PlaneChoice::At { g: 1, h: 1 }));
    act(&mut app, Command::Step(-1));
    assert_eq!(app.state().settings.plane, PlaneChoice::At { g: 6, h: 6 });
    act(&mut app, Command::Step(1));
    assert_eq!(app.state().settings.plane, PlaneChoice::At { g: 1, h: 1 });
    act(&mut app, Command::LookAt(PlaneChoice::Best));
    let order = app.state().analysis().expect("analyzed").ranking.order().to_vec();
    act(&mut app, Command::StepRank(2));
    assert_eq!(app.state().chosen_plane_index(), Some(order[2]));
    act(&mut app, Command::StepRank(-5));
    assert_eq!(app.state().chosen_plane_index(), Some(order[0]));
    act(&mut app, Command::StepRank(10_000));
    assert_eq!(app.state().chosen_plane_index(), order.last().copied());
    // However many were scrubbed through: one step back.
    act(&mut app, Command::Undo);
    assert_eq!(app.state().settings.plane, PlaneChoice::Best);
}

#[test]
fn playing_goes_on_and_stops() {
    let mut app = with_sample();
    act(&mut app, Command::LookAt(PlaneChoice::At { g: 1, h: 1 }));
    app.apply(Command::Play(true));
    for _ in 0..10 {
        app.update(Duration::from_millis(100));
        settle_looks(&mut app);
    }
    let PlaneChoice::At { g, h } = app.state().settings.plane else {
        panic!("a plane");
    };
    let passed = (g - 1) * 6 + h - 1;
    assert!((4..=7).contains(&passed), "{passed} planes in a second");
    app.apply(Command::Play(false));
    app.update(Duration::from_millis(900));
    assert_eq!(app.state().settings.plane, PlaneChoice::At { g, h });
}

fn settle_looks(app: &mut App) {
    while app.is_busy() {
        app.update(Duration::ZERO);
    }
}

#[test]
fn a_preview_shows_a_plane_and_leaves_the_choice() {
    let mut app = with_sample();
    let best = app.state().plane_index();
    act(&mut app, Command::Preview(Some(20)));
    assert_eq!(app.state().look.as_ref().expect("drawn").plane_index, Some(20));
    assert_eq!(app.state().chosen_plane_index(), best);
    act(&mut app, Command::Preview(None));
    assert_eq!(app.state().look.as_ref().expect("drawn").plane_index, best);
    assert!(!app.state().can_undo);
}

#[test]
fn a_click_picks_the_point_that_is_drawn_there() {
    let mut app = with_sample();
    app.set_view(Viewport::new(800.0, 600.0), 1.0, true);
    act(&mut app, Command::View(ViewPreset::Camera));
    let shown = app.state().shown().expect("points").clone();
    let (camera, viewport) = (app.state().camera, app.state().viewport);
    // The point nearest to the camera hides whatever is behind it.
    let front = (0..shown.len()).min_by(|&a, &b| {
        let depth = |i: usize| camera.depth_of(shown.positions[i]);
        depth(a).total_cmp(&depth(b))
    });
    let front = front.expect("points");
    let pixel = camera
        .project(shown.positions[front], viewport)
        .expect("before the camera");
    act(&mut app, Command::PickAt(pixel));
    let picked = app.state().picked.expect("a point");
    let at = camera.project(shown.positions[picked], viewport).expect("seen");
    assert!(at.distance(pixel) < 6.0);
    assert!(camera.depth_of(shown.positions[picked]) <= camera.depth_of(shown.positions[front]));
    let twice = axiscope::view::pick_point(
        &shown,
        &camera,
        Viewport::new(1600.0, 1200.0),
        2.0 * pixel,
        9.0,
        12.0,
    );
    let once = axiscope::view::pick_point(&shown, &camera, viewport, pixel, 4.5, 6.0);
    assert_eq!(once, twice, "whatever the pixels per point");
    act(&mut app, Command::PickAt(DVec2::new(2.0, 2.0)));
    assert_eq!(app.state().picked, None, "nothing is in the corner");
}

#[test]
fn a_dragged_center_is_a_center_by_hand() {
    let mut app = with_sample();
    act(&mut app, Command::Use(Tool::MoveCenter));
    for x in [0.1, 0.2, 0.3] {
        act(&mut app, Command::MoveCenter(DVec3::new(x, 0.0, 40.0)));
    }
    let analysis = app.state().analysis().expect("analyzed");
    assert_eq!(analysis.center, DVec3::new(0.3, 0.0, 40.0));
    assert_eq!(request(&app).params.preset(), None);
    app.apply(Command::EndGesture);
    act(&mut app, Command::Undo);
    assert!(matches!(
        request(&app).params.center,
        CenterMethod::Equidistant(_)
    ));
}

#[test]
fn the_brush_grays_what_is_outside() {
    let mut app = with_sample();
    let gray = |app: &App| {
        let look = app.state().look.as_ref().expect("drawn");
        let colors = &look.scene.points[0].colors;
        colors.iter().filter(|c| **c == axiscope::view::NEUTRAL).count()
    };
    assert_eq!(gray(&app), 0);
    let contributions = app.state().look.as_ref().and_then(|l| l.contributions.clone());
    let contributions = contributions.expect("partners");
    act(&mut app, Command::Brush(Some(0.0..=contributions.mean_cm)));
    let outside = gray(&app);
    let points = app.state().shown().expect("points").len();
    assert!(outside > points / 10 && outside < points, "{outside} of {points}");
    act(&mut app, Command::Brush(None));
    assert_eq!(gray(&app), 0);
}

#[test]
fn contributions_count_every_point_with_a_partner() {
    let app = with_sample();
    let look = app.state().look.as_ref().expect("drawn");
    let contributions = look.contributions.as_ref().expect("partners");
    let analysis = look.analysis.as_ref().expect("analyzed");
    let best = look.plane_index.expect("a plane");
    let term = &analysis.planes.terms[best];
    assert_eq!(contributions.counts.iter().sum::<usize>(), term.partners);
    let score = analysis.ranking.scores_cm()[best].expect("the best has a score");
    assert!((contributions.mean_cm - score).abs() < 1e-9);
}

#[test]
fn a_bad_file_is_a_sentence_and_the_next_one_opens() {
    let folder = tempfile::tempdir().expect("a folder");
    let (bad, good) = (folder.path().join("a.ply"), folder.path().join("b.ply"));
    std::fs::write(&bad, "this is no cloud").expect("written");
    std::fs::copy(asset("pepper.ply"), &good).expect("copied");
    let mut app = with_sample();
    act(&mut app, Command::Open(vec![folder.path().to_owned()]));
    assert_eq!(app.state().entries.len(), 2, "the sample has made room");
    assert!(app.state().entries[0].problem.is_some());
    let message = &app.state().messages[0];
    assert!(
        message.is_error && message.text.contains("a.ply"),
        "{}",
        message.text
    );
    assert!(app.state().look.is_none() && app.state().walked.is_none());
    act(&mut app, Command::Go(1));
    assert_eq!(app.state().source(), Some(&Source::File(good)));
    assert!(app.state().walked.is_some() && app.state().look.is_some());
    let id = message_id(&app);
    act(&mut app, Command::Dismiss(id));
    assert!(app.state().messages.is_empty());
}

fn message_id(app: &App) -> u64 {
    app.state().messages[0].id
}

#[test]
fn a_cloud_that_cannot_be_analyzed_is_shown_all_the_same() {
    let folder = tempfile::tempdir().expect("a folder");
    let line = folder.path().join("line.ply");
    let header = "ply\nformat ascii 1.0\nelement vertex 50\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
    let points: Vec<String> = (0..50).map(|i| format!("{i} 0 300")).collect();
    let text = format!("{header}{}\n", points.join("\n"));
    std::fs::write(&line, text).expect("written");
    let mut app = app();
    act(&mut app, Command::Open(vec![line]));
    let (shown, why) = app.state().unanalyzed.as_ref().expect("it was read");
    assert_eq!(shown.len(), 50);
    let why = why.as_ref().expect("there is a reason");
    // A file's name keeps its letters.
    assert!(
        why.starts_with("line.ply: ") && why.contains("on a line"),
        "{why}"
    );
    assert_eq!(
        app.state().look.as_ref().expect("drawn").scene.points[0]
            .positions
            .len(),
        50
    );
}

#[test]
fn the_next_cloud_is_seen_from_where_the_last_one_was() {
    let mut app = with_sample();
    act(&mut app, Command::View(ViewPreset::Side));
    let before = app.state().camera;
    let extent = app.state().shown().expect("points").extent;
    act(&mut app, Command::OpenSample(Sample::MissedPepper));
    let after = app.state().camera;
    assert_eq!(before.world_from_view, after.world_from_view);
    let moved = app.state().shown().expect("points").extent.center() - extent.center();
    assert!((after.eye_in_world - before.eye_in_world - moved).length() < 1e-9);
    assert!(moved.length() > 0.0);
}

#[test]
fn a_large_cloud_is_shown_before_it_is_analyzed() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("large.ply");
    let mut bytes = b"ply\nformat binary_little_endian 1.0\nelement vertex 120000\nproperty float x\nproperty float y\nproperty float z\nend_header\n".to_vec();
    for i in 0..120_000_u32 {
        // Half a sphere in front of the camera, in centimeters.
        let (a, z) = (f64::from(i) * 2.399_963, f64::from(i) / 120_000.0);
        let r = (1.0 - z * z).sqrt();
        for value in [4.0 * r * a.cos(), 4.0 * r * a.sin(), 40.0 - 4.0 * z] {
            bytes.extend((value as f32).to_le_bytes());
        }
    }
    std::fs::write(&path, bytes).expect("written");
    let mut app = with_sample();
    app.apply(Command::Open(vec![path]));
    let mut was_bare = false;
    while app
        .state()
        .walked
        .as_ref()
        .is_none_or(|w| w.fruit.cloud().len() != 120_000)
    {
        app.update(Duration::from_millis(5));
        let bare = app
            .state()
            .unanalyzed
            .as_ref()
            .is_some_and(|(_, why)| why.is_none());
        let look = app.state().look.as_ref();
        was_bare |= bare && look.is_some_and(|l| l.shown.len() == 120_000 && l.analysis.is_none());
    }
    assert!(was_bare, "its points came before the result");
    settle(&mut app);
    assert!(app.state().unanalyzed.is_none());
    assert_eq!(app.state().look.as_ref().expect("drawn").shown.len(), 120_000);
}

#[test]
fn closing_goes_to_the_neighbor_and_at_last_to_nothing() {
    let mut app = app();
    act(
        &mut app,
        Command::Open(vec![asset("pepper.ply"), asset("ellipsoid.ply")]),
    );
    act(&mut app, Command::Close);
    assert_eq!(app.state().source(), Some(&Source::File(asset("ellipsoid.ply"))));
    act(&mut app, Command::Close);
    assert!(app.state().entries.is_empty() && app.state().look.is_none() && app.state().walked.is_none());
    act(&mut app, Command::Go(1));
    act(&mut app, Command::Step(1));
    act(&mut app, Command::Frame);
    assert!(app.state().look.is_none());
}

#[test]
fn details_of_planes_are_kept_within_bounds() {
    let mut app = with_sample();
    for _ in 0..40 {
        act(&mut app, Command::Step(1));
    }
    let kept = app.kept_details();
    assert!(kept.len() > 1 && kept.len() <= 36);
    let bytes: usize = kept
        .iter()
        .map(|d| d.points.len() * size_of::<axiscope::method::PointDetail>())
        .sum();
    assert!(bytes <= 128 << 20);
}

#[test]
fn colorings_that_the_file_lacks_say_so_and_draw_something() {
    let mut app = app();
    act(&mut app, Command::OpenSample(Sample::Ellipsoid));
    let mut style = app.state().style.clone();
    style.coloring = Coloring::Label;
    act(&mut app, Command::Style(Box::new(style)));
    let look = app.state().look.as_ref().expect("drawn");
    let has_labels = app
        .state()
        .walked
        .as_ref()
        .is_some_and(|w| w.fruit.cloud().labels().is_some());
    assert_eq!(look.fallback.is_some(), !has_labels);
    assert!(!look.scene.points[0].colors.is_empty());
}

#[test]
fn a_session_survives_a_restart() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("deep/session.json");
    let mut app = app();
    act(
        &mut app,
        Command::Open(vec![asset("pepper.ply"), asset("ellipsoid.ply")]),
    );
    act(&mut app, Command::Go(1));
    set(&mut app, |r| r.params.u = 9);
    act(&mut app, Command::LookAt(PlaneChoice::At { g: 4, h: 2 }));
    let mut style = app.state().style.clone();
    style.theme = Theme::Light;
    style.overlays.set(Overlay::Ghost, true);
    act(&mut app, Command::Style(Box::new(style.clone())));
    Session::of(app.state()).write(&path).expect("it can be written");
    let session = Session::read(&path).expect("it can be read");
    assert_eq!(session.settings, app.state().settings);
    assert_eq!(session.open, [asset("pepper.ply"), asset("ellipsoid.ply")]);
    assert_eq!(session.current, Some(1));
    let again = App::new(session, &(std::sync::Arc::new(|| {}) as _)).expect("threads");
    assert_eq!(again.state().style, style);
    assert_eq!(again.state().recent.len(), 2);
}

#[test]
fn a_session_that_makes_no_sense_is_kept_aside() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("session.json");
    assert_eq!(Session::read(&path).expect("none is the first"), Session::first());
    std::fs::write(&path, "{ half").expect("written");
    let error = Session::read(&path).expect_err("no JSON");
    assert!(matches!(error, SessionError::Unreadable { .. }));
    assert!(!path.exists() && folder.path().join("session.unreadable.json").exists());
    // Of another version, or with numbers out of range: begun anew, and kept for whoever can read it.
    std::fs::write(&path, "{\"version\": 99}").expect("written");
    assert_eq!(Session::read(&path).expect("readable"), Session::first());
    let kept = std::fs::read_to_string(folder.path().join("session.version-99.json"));
    assert_eq!(kept.expect("moved aside"), "{\"version\": 99}");
    assert!(!path.exists());
    let mut wild = Session::first();
    wild.settings.request.params.u = 100_000;
    wild.write(&path).expect("written");
    assert_eq!(Session::read(&path).expect("readable"), Session::first());
    // So many random points that no memory holds them would end a worker.
    let mut wild = Session::first();
    let search = RandomSearch {
        count: usize::MAX,
        ..RandomSearch::default()
    };
    wild.settings.request.params.center = CenterMethod::Equidistant(search);
    wild.write(&path).expect("written");
    assert_eq!(Session::read(&path).expect("readable"), Session::first());
}

#[test]
fn the_copied_command_line_gives_the_same_result() {
    let mut app = app();
    act(&mut app, Command::Open(vec![asset("pepper.ply")]));
    set(&mut app, |r| {
        let mut params = Params::new(Preset::AsPrinted, r.params.unit);
        params.u = 7;
        params.tau_cm_per_rad = 0.25;
        params.center = CenterMethod::Sphere;
        params.min_partner_fraction = 0.2;
        params.viewpoint = DVec3::new(0.5, -1.0, -2.0);
        params.filters.voxel_cm = Some(0.3);
        r.params = params;
        r.without_peduncle = true;
    });
    let analysis = app.state().analysis().expect("analyzed").clone();
    let mut command = assert_cmd::Command::cargo_bin("axiscope").expect("built");
    command
        .arg("analyze")
        .arg(asset("pepper.ply"))
        .args(["--format", "json"]);
    command.args(request(&app).options());
    let output = command.assert().success().get_output().stdout.clone();
    let report: serde_json::Value = serde_json::from_slice(&output).expect("JSON");
    let best = analysis.best.expect("a plane");
    assert_eq!(report["best"]["g"], best.candidate.g);
    assert_eq!(report["best"]["score"], best.score_cm);
    assert_eq!(report["params"]["u"], 7);
    let words = command_line(app.state(), "a picture.png", [800, 600]);
    assert_eq!(words[0], "render");
    assert!(quoted(&words).contains("'a picture.png'"));
}

#[test]
fn paths_that_are_not_there_are_told() {
    let mut app = app();
    act(&mut app, Command::Open(vec![PathBuf::from("/no/such/cloud.ply")]));
    let text = &app.state().messages[0].text;
    assert!(
        text.contains("/no/such/cloud.ply") && text.contains("no such file"),
        "{text}"
    );
    let empty = tempfile::tempdir().expect("a folder");
    act(&mut app, Command::Open(vec![empty.path().to_owned()]));
    assert!(
        app.state()
            .messages
            .iter()
            .any(|m| m.text.contains("no PLY files"))
    );
}

/// A cloud on its way to the disk: an ellipsoid that is to be seen around a place.
fn write_ellipsoid(path: &std::path::Path, points: usize, center_cm: DVec3) {
    let settings = axiscope::simulate::EllipsoidSettings {
        center_cm,
        points,
        ..Default::default()
    };
    write_cloud(&settings.simulate().expect("an ellipsoid").cloud, path);
}

#[test]
fn a_result_that_comes_after_its_cloud_was_left_is_not_shown_in_another_ones_place() {
    let folder = tempfile::tempdir().expect("a folder");
    let places = [(0.0, 600), (40.0, 12_000), (-40.0, 600)];
    let files: Vec<PathBuf> = (places.iter().enumerate())
        .map(|(i, &(x, points))| {
            let path = folder.path().join(format!("{i}.ply"));
            write_ellipsoid(&path, points, DVec3::new(x, 0.0, 60.0));
            path
        })
        .collect();
    let (woken, wakes) = std::sync::mpsc::channel();
    let repaint = std::sync::Arc::new(move || {
        let _ = woken.send(());
    });
    let mut app = App::new(Session::first(), &(repaint as _)).expect("threads can be started");
    act(&mut app, Command::Open(files));
    act(&mut app, Command::Show(0));
    let pivot_of_first = app.state().camera.pivot_in_world;

    // The second cloud's analysis ends while nobody looks, and is found there when the third was chosen.
    app.apply(Command::Show(1));
    app.update(Duration::ZERO);
    while wakes.recv_timeout(Duration::from_secs(2)).is_ok() {}
    app.apply(Command::Show(2));
    app.update(Duration::ZERO);
    let shown = app
        .state()
        .walked
        .as_ref()
        .map(|walked| walked.fruit.cloud().len());
    assert_ne!(shown, Some(12_000), "the cloud that was left");
    settle(&mut app);
    let moved = app.state().camera.pivot_in_world - pivot_of_first;
    assert!((moved.x + 40.0).abs() < 2.0, "the camera moved by {moved}");
}

#[test]
fn a_whole_scan_is_shown_and_can_be_looked_at_from_where_the_eye_is() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("whole.ply");
    let settings = axiscope::simulate::EllipsoidSettings {
        center_cm: DVec3::new(0.0, 0.0, 60.0),
        ..Default::default()
    };
    let simulated = settings.simulate().expect("an ellipsoid");
    // Both halves about the origin, where the viewpoint is.
    let mut points: Vec<DVec3> = simulated
        .cloud
        .positions()
        .iter()
        .map(|p| *p - DVec3::Z * 60.0)
        .collect();
    points.extend(points.clone().iter().map(|p| -*p));
    write_cloud(&axiscope::geometry::Cloud::new(points), &path);
    let mut app = app();
    act(&mut app, Command::Open(vec![path]));
    assert!(app.state().is_viewpoint_inside && app.state().analysis().is_none());
    assert!(app.state().look.is_some(), "it is shown");
    act(&mut app, Command::LookFromHere);
    assert!(!app.state().is_viewpoint_inside);
    let analysis = app.state().analysis().expect("analyzed");
    assert_eq!(analysis.params.viewpoint, app.state().camera.eye_in_world);
    act(&mut app, Command::Undo);
    assert!(app.state().is_viewpoint_inside);

    // Or a depth camera takes the place of the eye, and what it sees is another cloud.
    act(&mut app, Command::ScanFromHere);
    let (whole, seen) = (
        app.state().entries[0].source.clone(),
        app.state().source().cloned(),
    );
    assert_eq!(app.state().entries.len(), 2);
    assert_ne!(Some(whole), seen);
    let walked = app.state().walked.clone().expect("analyzed");
    let count = walked.fruit.cloud().len();
    assert!((1_000..5_000).contains(&count), "{count} of 6000 points are seen");
    assert!(
        walked.fruit.cloud().positions().iter().all(|p| p.z > 0.0),
        "before the camera"
    );
    let saved = folder.path().join("seen.ply");
    act(&mut app, Command::SaveCloud(saved.clone()));
    let read = axiscope::fruit::read_cloud(&saved).expect("written");
    assert_eq!(read.ply.cloud.len(), count);
}
