//! The panels of one point, of the contributions, and of the open clouds.

use std::path::PathBuf;

use axiscope::app::{Command, Sample};
use axiscope::ui::WindowAct;
use egui_kittest::SnapshotResults;
use egui_kittest::kittest::Queryable as _;

use super::{Panel, bench, click, dark, harness, options, point_of};

#[test]
fn a_point_is_explained() {
    let mut results = SnapshotResults::new();
    for (theme, name, with_partner) in [
        (egui::Theme::Dark, "point_dark", true),
        (egui::Theme::Light, "point_light", true),
        (egui::Theme::Dark, "point_no_partner", false),
    ] {
        let mut bench = bench(Panel::WhyThisScore, Some(Sample::Pepper));
        let picked = point_of(&bench, with_partner);
        bench.apply(Command::Pick(Some(picked)));
        let mut harness = harness(bench, [300.0, 600.0], 1.0, theme);
        harness.snapshot_options(name, &options());
        results.extend_harness(&mut harness);
    }
}

#[test]
fn the_partner_is_gone_to_and_the_pick_cleared() {
    let mut bench = bench(Panel::WhyThisScore, Some(Sample::Pepper));
    // Then the shown points and the used ones are counted differently.
    let mut request = bench.app.state().settings.request.clone();
    request.without_peduncle = true;
    bench.apply(Command::Set {
        request: Box::new(request),
        gesture: None,
    });
    let picked = point_of(&bench, true);
    bench.apply(Command::Pick(Some(picked)));
    let (_, detail) = bench.app.state().point_detail(picked).expect("explained");
    let partner = detail.partner.expect("a partner").index;
    let mut harness = dark(bench, [300.0, 520.0]);
    click(&mut harness, "Turn about it");
    assert_eq!(harness.state().said.last(), Some(&Command::PivotOnPicked));
    click(&mut harness, "Go to partner");
    let state = harness.state().app.state();
    let now = state.picked.expect("picked");
    assert_eq!(state.shown().expect("points").in_surface.get(now), Some(partner));
    click(&mut harness, "Clear");
    assert_eq!(harness.state().app.state().picked, None);
    harness.remove_cursor();
    harness.run();
    assert!(harness.query_by_label("No point is picked.").is_some());
    harness.set_size(egui::vec2(300.0, 160.0));
    harness.run();
    harness.snapshot_options("point_empty", &options());
}

#[test]
fn contributions_are_brushed() {
    let mut bench = bench(Panel::Contributions, Some(Sample::Pepper));
    let picked = point_of(&bench, true);
    bench.apply(Command::Pick(Some(picked)));
    let mut harness = dark(bench, [420.0, 260.0]);
    harness.snapshot_options("contributions_dark", &options());
    let rect = harness.get_by_label_contains("Histogram").rect();
    let at = |part: f32| egui::pos2(egui::lerp(rect.x_range(), part), rect.center().y);
    harness.drag_at(at(0.5));
    harness.run();
    harness.hover_at(at(0.6));
    harness.run();
    let live = harness
        .state()
        .app
        .state()
        .brush_cm
        .clone()
        .expect("brushed while dragging");
    harness.hover_at(at(0.75));
    harness.run();
    let wider = harness
        .state()
        .app
        .state()
        .brush_cm
        .clone()
        .expect("brushed while dragging");
    assert!(
        live.start() == wider.start() && live.end() < wider.end(),
        "{live:?} {wider:?}"
    );
    harness.drop_at(at(0.75));
    harness.run();
    harness.state_mut().settle();
    harness.run();
    let state = harness.state().app.state();
    let tau = state.params().tau_cm_per_rad;
    let inside = |cm: &f64| wider.contains(cm);
    let scores = state
        .detail()
        .expect("detail")
        .points
        .iter()
        .filter_map(|p| p.partner);
    let count = scores.map(|p| p.score_cm(tau)).filter(inside).count();
    assert!(count > 0);
    assert!(
        harness
            .query_by_label_contains(&format!("{count} points,"))
            .is_some(),
        "{count}"
    );
    harness.remove_cursor();
    harness.run();
    harness.snapshot_options("contributions_brushed", &options());
    harness.key_press(egui::Key::Escape);
    harness.run();
    assert_eq!(harness.state().app.state().brush_cm, None);

    // To the very end: everything above is in it.
    harness.drag_at(at(0.9));
    harness.run();
    harness.hover_at(at(1.2));
    harness.run();
    harness.drop_at(at(1.2));
    harness.run();
    let brush = harness.state().app.state().brush_cm.clone().expect("brushed");
    assert_eq!(*brush.end(), f64::INFINITY);
    harness.get_by_label_contains("Histogram").click();
    harness.run();
    assert_eq!(harness.state().app.state().brush_cm, None, "a click clears");
}

#[test]
fn contributions_are_readable_in_the_light() {
    let bench = bench(Panel::Contributions, Some(Sample::MissedPepper));
    let mut harness = harness(bench, [280.0, 240.0], 2.0, egui::Theme::Light);
    harness.snapshot_options("contributions_light", &options());
}

#[test]
fn an_empty_list_says_what_to_do() {
    let mut harness = dark(bench(Panel::Clouds, None), [280.0, 240.0]);
    harness.snapshot_options("files_empty", &options());
    click(&mut harness, "Open…");
    assert_eq!(harness.state().answer, Some(WindowAct::OpenFiles));
    click(&mut harness, Sample::Ellipsoid.title());
    assert!(
        harness
            .state()
            .said
            .contains(&Command::OpenSample(Sample::Ellipsoid))
    );
    for panel in [Panel::Parameters, Panel::WhyThisScore, Panel::Contributions] {
        dark(bench(panel, None), [280.0, 700.0]);
    }
}

#[test]
fn a_long_list_is_filtered_and_walked_through() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut text =
        String::from("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n");
    text += "property float z\nend_header\n0 0 1\n1 0 1\n0 1 1\n";
    for i in 0..3000 {
        std::fs::write(folder.path().join(format!("fruit_{i:04}.ply")), &text).expect("written");
    }
    let mut bench = bench(Panel::Clouds, None);
    bench.apply(Command::Open(vec![folder.path().to_path_buf()]));
    bench.apply(Command::Go(1));
    let mut harness = dark(bench, [280.0, 480.0]);
    // Only what is in sight is laid out.
    let rows = harness.query_all_by_label_contains("fruit_").count();
    assert!((5..40).contains(&rows), "{rows}");
    let problem = harness.state().app.state().entries[1]
        .problem
        .clone()
        .expect("too few points");
    assert!(
        harness
            .query_by_label(&format!("fruit_0001.ply: {problem}"))
            .is_some()
    );
    click(&mut harness, "Next");
    assert_eq!(harness.state().app.state().current, Some(2));
    harness.state_mut().settle();
    harness.run();
    let masked = folder
        .path()
        .file_name()
        .expect("a name")
        .to_string_lossy()
        .into_owned();
    assert!(
        harness.query_by_label_contains(&masked).is_none(),
        "closed until it is opened"
    );
    harness.snapshot_options("files_list", &options());
    let field = harness.get_by_label("Filter by name");
    field.focus();
    harness.run();
    harness.get_by_label("Filter by name").type_text("_2345");
    harness.run();
    assert_eq!(harness.query_all_by_label_contains("fruit_").count(), 1);
    click(&mut harness, "fruit_2345.ply");
    assert_eq!(harness.state().said.last(), Some(&Command::Show(2345)));
}

#[test]
fn a_cloud_that_cannot_be_analyzed_says_why() {
    let folder = tempfile::tempdir().expect("a folder");
    let path: PathBuf = folder.path().join("three.ply");
    let text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                property float z\nend_header\n0 0 1\n1 0 1\n0 1 1\n";
    std::fs::write(&path, text).expect("written");
    for panel in [
        Panel::Clouds,
        Panel::Parameters,
        Panel::WhyThisScore,
        Panel::Contributions,
    ] {
        let mut bench = bench(panel, None);
        bench.apply(Command::Open(vec![path.clone()]));
        bench.apply(Command::Pick(Some(1)));
        let why = bench.app.state().entries[0].problem.clone();
        let why = why.expect("too few points");
        let harness = dark(bench, [300.0, 700.0]);
        match panel {
            Panel::Clouds => {
                let label = format!("three.ply: {why}");
                assert!(harness.query_by_label(&label).is_some());
            }
            Panel::WhyThisScore => assert!(harness.query_by_label("The cloud was not analyzed.").is_some()),
            Panel::Contributions => {
                assert!(harness.query_by_label("This cloud was not analyzed.").is_some());
            }
            Panel::Parameters => {}
        }
    }
}
