//! The panel of the parameters.

use std::path::PathBuf;

use axiscope::app::{Command, Sample, Tool};
use axiscope::fruit::PeduncleChoice;
use axiscope::method::{Aggregation, CenterMethod, NormalSource, Preset, TAU_CM_PER_RAD};
use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use egui_kittest::{Harness, SnapshotResults};

use super::{Bench, Panel, bench, click, dark, harness, last_set, options};

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
    let mut harness = harness(bench, [260.0, 1240.0], 2.0, egui::Theme::Dark);
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
fn strays_are_left_out_by_a_switch_that_undo_turns_back() {
    let mut harness = dark(bench(Panel::Parameters, Some(Sample::Pepper)), [300.0, 900.0]);
    click(&mut harness, "Filters");
    let keeps = |harness: &Harness<'_, Bench>| {
        let state = harness.state().app.state();
        state.settings.request.params.filters.keep_strays
    };
    assert!(!keeps(&harness), "they are left out by default");
    click(&mut harness, "Leave out strays");
    assert!(keeps(&harness) && last_set(harness.state()).0.params.filters.keep_strays);
    harness.state_mut().apply(Command::Undo);
    assert!(!keeps(&harness));
    harness.state_mut().apply(Command::Redo);
    assert!(keeps(&harness));
    harness.run();
    click(&mut harness, "Reset Filters");
    assert!(!keeps(&harness));
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
