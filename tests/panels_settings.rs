//! The panels of parameters, of one point, of the contributions, of files and of warnings: how they
//! look, and what they ask for.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use axiscope::app::{App, Command, Sample, Session, Tool};
use axiscope::io::PeduncleChoice;
use axiscope::method::{Aggregation, CenterMethod, NormalSource, Preset, TAU_CM_PER_RAD};
use axiscope::ui::{contributions, files, parameters, point, warnings};
use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use egui_kittest::{Harness, SnapshotOptions, SnapshotResults};

/// A program, what is drawn of it, and what that asked for.
struct Bench {
    app: App,
    panel: Panel,
    said: Vec<Command>,
    answer: Option<files::FilesAnswer>,
}

#[derive(Clone, Copy)]
enum Panel {
    Parameters,
    Point,
    Contributions,
    Files,
    Warnings,
}

impl Bench {
    fn settle(&mut self) {
        let begin = std::time::Instant::now();
        loop {
            self.app.update(Duration::from_millis(16));
            if !self.app.is_busy() {
                return;
            }
            assert!(begin.elapsed() < Duration::from_mins(2), "the workers do not end");
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    fn apply(&mut self, command: Command) {
        self.app.apply(command);
        self.settle();
    }
}

fn bench(panel: Panel, sample: Option<Sample>) -> Bench {
    let app = App::new(Session::first(), &(Arc::new(|| {}) as _)).expect("threads start");
    let mut bench = Bench {
        app,
        panel,
        said: Vec::new(),
        answer: None,
    };
    if let Some(sample) = sample {
        bench.apply(Command::OpenSample(sample));
    }
    bench
}

fn harness(
    bench: Bench,
    size: [f32; 2],
    pixels_per_point: f32,
    theme: egui::Theme,
) -> Harness<'static, Bench> {
    let mut harness = Harness::builder()
        .with_size(size)
        .with_pixels_per_point(pixels_per_point)
        .with_theme(theme)
        .wgpu()
        .build_ui_state(
            |ui, bench: &mut Bench| {
                let (state, mut said) = (bench.app.state(), Vec::new());
                match bench.panel {
                    Panel::Parameters => parameters::show(ui, state, &mut said),
                    Panel::Point => point::show(ui, state, &mut said),
                    Panel::Contributions => contributions::show(ui, state, &mut said),
                    Panel::Files => {
                        bench.answer = files::show(ui, state, &mut said).or(bench.answer);
                    }
                    Panel::Warnings => warnings::show(ui, state, &mut said),
                }
                // As the program does it: what was asked for is done after the frame.
                for command in said {
                    bench.said.push(command.clone());
                    bench.app.apply(command);
                }
            },
            bench,
        );
    harness.run();
    harness
}

fn dark(bench: Bench, size: [f32; 2]) -> Harness<'static, Bench> {
    harness(bench, size, 1.0, egui::Theme::Dark)
}

fn options() -> SnapshotOptions {
    SnapshotOptions::new()
        .threshold(1.0)
        .max_failed_pixels(10)
        .output_path("screenshots/panels")
}

fn click(harness: &mut Harness<'_, Bench>, label: &str) {
    harness.get_by_label(label).click();
    harness.run();
}

/// The last request that was asked for, and its gesture.
fn last_set(bench: &Bench) -> (axiscope::evaluate::Request, Option<&'static str>) {
    let sets = bench.said.iter().rev().find_map(|command| match command {
        Command::Set { request, gesture } => Some(((**request).clone(), *gesture)),
        _ => None,
    });
    sets.expect("something was set")
}

/// A shown point that has a partner (or has none).
fn point_of(bench: &Bench, with_partner: bool) -> usize {
    let state = bench.app.state();
    let count = state.shown().expect("points").len();
    (count / 3..count)
        .find(|&i| {
            state
                .point_detail(i)
                .is_some_and(|(_, detail)| detail.partner.is_some() == with_partner)
        })
        .expect("a point")
}

#[test]
fn parameters_look_as_they_should() {
    let mut results = SnapshotResults::new();
    for (theme, name) in [
        (egui::Theme::Dark, "parameters_dark"),
        (egui::Theme::Light, "parameters_light"),
    ] {
        let mut harness = harness(
            bench(Panel::Parameters, Some(Sample::Pepper)),
            [300.0, 540.0],
            1.0,
            theme,
        );
        harness.snapshot_options(name, &options());
        results.extend_harness(&mut harness);
    }
}

#[test]
fn every_section_opens_in_a_narrow_column() {
    let mut bench = bench(Panel::Parameters, Some(Sample::Pepper));
    let mut request = bench.app.state().settings.request.clone();
    request.params.u = 8;
    request.params.tau_cm_per_rad = 2.5;
    request.params.min_partner_fraction = 0.2;
    let center = bench.app.state().analysis().expect("analyzed").center;
    request.params.center = CenterMethod::Given(center);
    request.params.filters.voxel_cm = Some(0.3);
    bench.apply(Command::Set {
        request: Box::new(request),
        gesture: None,
    });
    let mut harness = harness(bench, [260.0, 960.0], 2.0, egui::Theme::Dark);
    for section in ["Unit, normals, viewpoint", "Filters", "Peduncle"] {
        click(&mut harness, section);
    }
    click(&mut harness, "Leave out outliers");
    click(&mut harness, "Where the peduncle is");
    click(&mut harness, "color (hue)");
    harness.state_mut().settle();
    harness.remove_cursor();
    harness.run();
    harness.snapshot_options("parameters_all", &options());
    let widest = 260.0 - 8.0;
    let too_wide: Vec<_> = harness
        .root()
        .children_recursive()
        .filter_map(|node| Some((node.accesskit_node().bounding_box()?.x1 / 2.0, node)))
        .filter(|(right, _)| *right > widest + 0.5)
        .map(|(right, node)| format!("{right}: {node:?}"))
        .collect();
    assert!(too_wide.is_empty(), "{too_wide:#?}");
}

#[test]
fn u_and_tau_are_set_by_their_sliders() {
    let mut harness = dark(bench(Panel::Parameters, Some(Sample::Pepper)), [300.0, 620.0]);
    harness
        .get_by_role_and_label(Role::Slider, "Grid steps u")
        .set_value_accesskit(12.0);
    harness.run();
    let (request, gesture) = last_set(harness.state());
    assert_eq!((request.params.u, gesture), (12, Some("u")));
    harness.state_mut().settle();
    let state = harness.state().app.state();
    assert_eq!(state.analysis().expect("analyzed").planes.grid.u(), 12);
    harness.run();
    assert!(harness.query_by_label_contains("144 candidate planes").is_some());

    harness
        .get_by_role_and_label(Role::Slider, "Angle weight τ in cm/rad")
        .set_value_accesskit(2.0);
    harness.run();
    let (request, gesture) = last_set(harness.state());
    assert!((request.params.tau_cm_per_rad - 2.0).abs() < 0.05, "{request:?}");
    assert_eq!(gesture, Some("tau"));
    click(&mut harness, "Reset Angle weight τ in cm/rad");
    assert_eq!(last_set(harness.state()).0.params.tau_cm_per_rad, TAU_CM_PER_RAD);
    click(&mut harness, "Reset Grid steps u");
    assert_eq!(last_set(harness.state()).0.params.u, 6);
}

#[test]
fn one_drag_is_one_step_of_undo() {
    let mut harness = dark(bench(Panel::Parameters, Some(Sample::Pepper)), [300.0, 620.0]);
    let rect = harness
        .get_by_role_and_label(Role::Slider, "Angle weight τ in cm/rad")
        .rect();
    let at = |part: f32| egui::pos2(egui::lerp(rect.x_range(), part), rect.center().y);
    harness.drag_at(at(0.3));
    harness.run();
    for part in [0.4, 0.5, 0.7] {
        harness.hover_at(at(part));
        harness.run();
    }
    harness.drop_at(at(0.7));
    harness.run();
    let bench = harness.state_mut();
    let sets = bench
        .said
        .iter()
        .filter(|c| matches!(c, Command::Set { .. }))
        .count();
    assert!(sets >= 3, "{:?}", bench.said);
    assert!(bench.said.contains(&Command::EndGesture));
    let dragged = bench.app.state().settings.request.params.tau_cm_per_rad;
    assert!((2.4..3.2).contains(&dragged), "{dragged}");
    bench.apply(Command::Undo);
    assert_eq!(
        bench.app.state().settings.request.params.tau_cm_per_rad,
        TAU_CM_PER_RAD
    );
    assert!(!bench.app.state().can_undo);
}

#[test]
fn typed_numbers_out_of_range_are_clamped() {
    let mut harness = dark(bench(Panel::Parameters, Some(Sample::Pepper)), [300.0, 620.0]);
    for (typed, expected) in [("999", 360), ("1", 5), ("17", 17)] {
        harness
            .get_by_role_and_label(Role::SpinButton, "Grid steps u")
            .click();
        harness.run();
        harness
            .get_by_role_and_label(Role::SpinButton, "Grid steps u")
            .type_text(typed);
        harness.key_press(egui::Key::Enter);
        harness.run();
        assert_eq!(harness.state().app.state().settings.request.params.u, expected);
    }
}

#[test]
fn no_way_of_setting_a_number_leaves_its_range() {
    let mut harness = dark(bench(Panel::Parameters, Some(Sample::Pepper)), [300.0, 900.0]);
    click(&mut harness, "Unit, normals, viewpoint");
    let name = "Neighbors k of a normal";
    let k = |harness: &Harness<'_, Bench>| harness.state().app.state().settings.request.params.k.get();
    harness
        .get_by_role_and_label(Role::SpinButton, name)
        .set_value_accesskit(1.0);
    harness.run();
    assert_eq!(k(&harness), 3);
    harness.get_by_role_and_label(Role::SpinButton, name).focus();
    harness.run();
    harness.key_press(egui::Key::ArrowDown);
    harness.run();
    assert_eq!(k(&harness), 3);
    harness.key_press(egui::Key::ArrowUp);
    harness.run();
    assert_eq!(k(&harness), 4, "a key is a step");
    let name = "Angle weight τ in cm/rad";
    harness
        .get_by_role_and_label(Role::SpinButton, name)
        .set_value_accesskit(-1.0);
    harness.run();
    assert_eq!(
        harness.state().app.state().settings.request.params.tau_cm_per_rad,
        0.0
    );
    harness.state_mut().settle();
    assert!(harness.state().app.state().analysis().is_some());
}

#[test]
fn a_preset_is_chosen_and_custom_is_said() {
    let mut harness = dark(bench(Panel::Parameters, Some(Sample::Pepper)), [300.0, 620.0]);
    assert!(harness.query_by_label_contains("Custom").is_none());
    click(&mut harness, "As printed");
    assert_eq!(
        harness.state().said.last(),
        Some(&Command::UsePreset(Preset::AsPrinted))
    );
    harness.state_mut().settle();
    click(&mut harness, "Aggregation");
    click(&mut harness, "mean");
    let (request, _) = last_set(harness.state());
    assert_eq!(request.params.aggregation, Aggregation::Mean);
    assert_eq!(
        request.params.min_partner_fraction, 0.3,
        "follows, since it was not set by hand"
    );
    assert!(harness.query_by_label_contains("Custom").is_some());
    click(&mut harness, "Reset Score of a plane");
    let params = harness.state().app.state().settings.request.params.clone();
    assert_eq!(params.preset(), Some(Preset::AsPrinted));
    click(&mut harness, "As intended");
    harness
        .get_by_role_and_label(Role::Slider, "Least share of partners in percent")
        .set_value_accesskit(45.0);
    harness.run();
    let set = last_set(harness.state()).0.params.min_partner_fraction;
    assert!((set - 0.45).abs() < 1e-12);
    harness
        .get_by_role_and_label(Role::Slider, "Least share of partners in percent")
        .set_value_accesskit(30.0);
    harness.run();
    let params = harness.state().app.state().settings.request.params.clone();
    assert_eq!(
        params.preset(),
        Some(Preset::AsIntended),
        "30 % is the preset's again"
    );
}

#[test]
fn the_center_is_given_from_where_it_is_and_moved_in_the_view() {
    let mut harness = dark(bench(Panel::Parameters, Some(Sample::Pepper)), [300.0, 620.0]);
    let found = harness.state().app.state().analysis().expect("analyzed").center;
    click(&mut harness, "Move in the view");
    assert_eq!(harness.state().app.state().tool, Tool::MoveCenter);
    click(&mut harness, "Move in the view");
    assert_eq!(harness.state().app.state().tool, Tool::Navigate);
    let mut seeded = harness.state().app.state().settings.request.clone();
    seeded.params.center = CenterMethod::Equidistant(axiscope::method::RandomSearch {
        seed: 7,
        ..Default::default()
    });
    harness.state_mut().app.apply(Command::Set {
        request: Box::new(seeded.clone()),
        gesture: None,
    });
    harness.run();
    click(&mut harness, "Method of the fruit center");
    click(&mut harness, "given by X, Y, Z");
    assert_eq!(
        last_set(harness.state()).0.params.center,
        CenterMethod::Given(found)
    );
    click(&mut harness, "Method of the fruit center");
    click(&mut harness, "equidistant");
    assert_eq!(
        last_set(harness.state()).0.params.center,
        seeded.params.center,
        "the seed is kept"
    );
}

#[test]
fn what_a_file_lacks_cannot_be_chosen() {
    let mut harness = dark(bench(Panel::Parameters, Some(Sample::Pepper)), [300.0, 700.0]);
    let has_normals = {
        let walked = harness.state().app.state().walked.as_ref().expect("analyzed");
        walked.fruit.cloud().normals().is_some()
    };
    assert!(!has_normals, "this test wants a file without normals");
    click(&mut harness, "Unit, normals, viewpoint");
    assert!(
        harness.query_by_label_contains("auto: estimate").is_some() || {
            let value = harness.get_by_label("Source of the normals").value();
            value.as_deref() == Some("auto: estimate")
        }
    );
    click(&mut harness, "Source of the normals");
    harness.get_by_label("file").hover();
    harness.run();
    harness.snapshot_options("parameters_hindered", &options());
    click(&mut harness, "file");
    assert!(harness.state().said.is_empty(), "{:?}", harness.state().said);
    click(&mut harness, "Source of the normals");
    click(&mut harness, "estimate");
    assert_eq!(last_set(harness.state()).0.normals, Some(NormalSource::Estimate));
}

#[test]
fn the_peduncle_s_file_is_typed() {
    let mut harness = dark(bench(Panel::Parameters, Some(Sample::Pepper)), [300.0, 900.0]);
    click(&mut harness, "Peduncle");
    click(&mut harness, "Where the peduncle is");
    click(&mut harness, "a file");
    assert!(
        harness.state().said.is_empty(),
        "nothing is read before it has a name"
    );
    harness.get_by_label("File of the peduncle").focus();
    harness.run();
    harness
        .get_by_label("File of the peduncle")
        .type_text("stalk.ply");
    harness.run();
    assert!(
        harness.state().said.is_empty(),
        "nothing is read while it is typed"
    );
    harness.key_press(egui::Key::Enter);
    harness.run();
    let file = PeduncleChoice::File(PathBuf::from("stalk.ply"));
    assert_eq!(last_set(harness.state()).0.peduncle, file);
    click(&mut harness, "Analyze without the peduncle");
    assert!(last_set(harness.state()).0.without_peduncle);
    click(&mut harness, "Reset Peduncle");
    let (request, _) = last_set(harness.state());
    assert_eq!(
        (request.peduncle, request.without_peduncle),
        (PeduncleChoice::Auto, false)
    );
}

#[test]
fn a_point_is_explained() {
    let mut results = SnapshotResults::new();
    for (theme, name, with_partner) in [
        (egui::Theme::Dark, "point_dark", true),
        (egui::Theme::Light, "point_light", true),
        (egui::Theme::Dark, "point_no_partner", false),
    ] {
        let mut bench = bench(Panel::Point, Some(Sample::Pepper));
        let picked = point_of(&bench, with_partner);
        bench.apply(Command::Pick(Some(picked)));
        let mut harness = harness(bench, [300.0, 600.0], 1.0, theme);
        harness.snapshot_options(name, &options());
        results.extend_harness(&mut harness);
    }
}

#[test]
fn the_partner_is_gone_to_and_the_pick_cleared() {
    let mut bench = bench(Panel::Point, Some(Sample::Pepper));
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
    assert_eq!(state.shown().expect("points").in_surface[now], Some(partner));
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
    let mut harness = dark(bench(Panel::Files, None), [280.0, 240.0]);
    harness.snapshot_options("files_empty", &options());
    click(&mut harness, "Open…");
    assert_eq!(harness.state().answer, Some(files::FilesAnswer::OpenDialog));
    click(&mut harness, Sample::Ellipsoid.title());
    assert!(
        harness
            .state()
            .said
            .contains(&Command::OpenSample(Sample::Ellipsoid))
    );
    for panel in [
        Panel::Parameters,
        Panel::Point,
        Panel::Contributions,
        Panel::Warnings,
    ] {
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
    let mut bench = bench(Panel::Files, None);
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
fn warnings_are_listed() {
    let mut bench = bench(Panel::Warnings, Some(Sample::MissedPepper));
    bench.apply(Command::UsePreset(Preset::AsPrinted));
    let warned = bench.app.state().warnings.clone();
    assert!(!warned.is_empty());
    let mut harness = dark(bench, [300.0, 200.0]);
    for warning in &warned {
        assert!(harness.query_by_label(warning).is_some(), "{warning}");
    }
    harness.snapshot_options("warnings", &options());
}

#[test]
fn a_cloud_that_cannot_be_analyzed_says_why() {
    let folder = tempfile::tempdir().expect("a folder");
    let path: PathBuf = folder.path().join("three.ply");
    let text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                property float z\nend_header\n0 0 1\n1 0 1\n0 1 1\n";
    std::fs::write(&path, text).expect("written");
    for panel in [
        Panel::Warnings,
        Panel::Parameters,
        Panel::Point,
        Panel::Contributions,
    ] {
        let mut bench = bench(panel, None);
        bench.apply(Command::Open(vec![path.clone()]));
        bench.apply(Command::Pick(Some(1)));
        let why = bench.app.state().unanalyzed.clone().expect("too few points").1;
        let harness = dark(bench, [300.0, 700.0]);
        match panel {
            Panel::Warnings => assert!(harness.query_by_label(&why).is_some()),
            Panel::Point => assert!(harness.query_by_label("The cloud was not analyzed.").is_some()),
            Panel::Contributions => {
                assert!(harness.query_by_label("This cloud was not analyzed.").is_some());
            }
            _ => {}
        }
    }
}
