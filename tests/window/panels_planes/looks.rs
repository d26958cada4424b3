//! How the panels look.

use super::*;

/// Pictures of a test, which are told about together.
#[derive(Default)]
struct Pictures(SnapshotResults);

impl Pictures {
    fn take(&mut self, app: App, panel: Panel, size: Vec2, theme: Theme, ppp: f32, name: &str) {
        let mut harness = harness(app, panel, size, theme, ppp);
        harness.snapshot(name);
        self.0.extend_harness(&mut harness);
    }
}

/// A plane that is neither the best nor the runner-up is looked at.
fn looked_at(sample: Sample, u: usize) -> App {
    let mut app = app_with(sample);
    set(&mut app, |request| request.params.u = u);
    settle(&mut app);
    let analysis = app.state().analysis().expect("an analysis").clone();
    let third = analysis.planes.grid.candidate(analysis.ranking.order()[2]);
    app.apply(at(third.g, third.h));
    settle(&mut app);
    app
}

#[test]
fn the_score_map_looks_as_before() {
    let mut pictures = Pictures::default();
    let large = vec2(420.0, 440.0);
    let panel = score_map::show;
    pictures.take(
        looked_at(Sample::Pepper, 6),
        panel,
        large,
        Theme::Dark,
        1.0,
        "score_map_dark",
    );
    pictures.take(
        looked_at(Sample::Pepper, 12),
        panel,
        large,
        Theme::Light,
        2.0,
        "score_map_light_2x",
    );
    pictures.take(
        looked_at(Sample::Pepper, 60),
        panel,
        vec2(600.0, 600.0),
        Theme::Dark,
        1.0,
        "score_map_fine",
    );
    pictures.take(
        looked_at(Sample::Pepper, 5),
        panel,
        vec2(216.0, 216.0),
        Theme::Light,
        1.0,
        "score_map_small",
    );
    let mut none = app_with(Sample::Pepper);
    set(&mut none, |request| request.params.min_partner_fraction = 1.0);
    settle(&mut none);
    pictures.take(none, panel, large, Theme::Dark, 1.0, "score_map_no_plane");
    pictures.take(
        driving::app(),
        panel,
        vec2(300.0, 200.0),
        Theme::Dark,
        1.0,
        "planes_nothing_open",
    );
}

#[test]
fn older_results_look_as_before() {
    let mut app = looked_at(Sample::Pepper, 6);
    set(&mut app, |request| request.params.u = 40);
    app.update(Duration::ZERO);
    assert!(app.state().is_stale, "this machine is too fast for the test");
    let size = vec2(420.0, 440.0);
    Pictures::default().take(app, score_map::show, size, Theme::Light, 1.0, "score_map_stale");
}

#[test]
fn a_hovered_cell_looks_as_before() {
    let mut harness = driven(looked_at(Sample::Pepper, 6), score_map::show);
    harness.hover_at(cell(map_of(&harness), 6, 2, 2));
    obey(&mut harness);
    for _ in 0..30 {
        harness.step();
    }
    harness.snapshot("score_map_hovered");
}

#[test]
fn the_hemisphere_looks_as_before() {
    let mut pictures = Pictures::default();
    let size = vec2(420.0, 440.0);
    let panel = hemisphere::show;
    pictures.take(
        looked_at(Sample::Pepper, 6),
        panel,
        size,
        Theme::Dark,
        1.0,
        "hemisphere_dark",
    );
    pictures.take(
        looked_at(Sample::MissedPepper, 20),
        panel,
        size,
        Theme::Light,
        2.0,
        "hemisphere_light_2x",
    );
    pictures.take(
        looked_at(Sample::Pepper, 12),
        panel,
        vec2(216.0, 216.0),
        Theme::Light,
        1.0,
        "hemisphere_small",
    );
    let mut harness = harness(looked_at(Sample::Pepper, 12), panel, size, Theme::Dark, 1.0);
    harness.get_by_label_contains("Hemisphere").focus();
    harness.run();
    for key in [Key::ArrowRight, Key::ArrowRight, Key::ArrowDown, Key::ArrowDown] {
        harness.key_press(key);
        harness.run();
    }
    harness.snapshot("hemisphere_turned");
    pictures.0.extend_harness(&mut harness);
}

#[test]
fn the_ranking_looks_as_before() {
    let mut pictures = Pictures::default();
    let panel = ranking::show;
    let size = vec2(560.0, 320.0);
    pictures.take(
        looked_at(Sample::Pepper, 6),
        panel,
        size,
        Theme::Dark,
        1.0,
        "ranking_dark",
    );
    pictures.take(
        looked_at(Sample::MissedPepper, 6),
        panel,
        size,
        Theme::Light,
        2.0,
        "ranking_light_2x",
    );
    let mut without = app_with(Sample::Pepper);
    let order = without
        .state()
        .analysis()
        .expect("an analysis")
        .ranking
        .order()
        .len();
    assert!(order < 36);
    let scores = without
        .state()
        .analysis()
        .expect("an analysis")
        .ranking
        .scores_cm()
        .to_vec();
    let last = scores.iter().rposition(Option::is_none).expect("one without");
    without.apply(at(last / 6 + 1, last % 6 + 1));
    settle(&mut without);
    pictures.take(
        without,
        panel,
        vec2(330.0, 240.0),
        Theme::Dark,
        1.0,
        "ranking_narrow",
    );
}

#[test]
fn the_bar_looks_as_before() {
    let mut pictures = Pictures::default();
    let panel = plane_bar::show;
    pictures.take(
        looked_at(Sample::Pepper, 6),
        panel,
        vec2(900.0, 76.0),
        Theme::Dark,
        1.0,
        "scrub_dark",
    );
    pictures.take(
        looked_at(Sample::MissedPepper, 6),
        panel,
        vec2(900.0, 76.0),
        Theme::Light,
        2.0,
        "scrub_light_2x",
    );
    pictures.take(
        looked_at(Sample::Pepper, 12),
        panel,
        vec2(380.0, 130.0),
        Theme::Light,
        1.0,
        "scrub_narrow",
    );
    let mut printed = app_with(Sample::Pepper);
    printed.apply(Command::UsePreset(Preset::AsPrinted));
    settle(&mut printed);
    printed.apply(Command::Play(true));
    pictures.take(
        printed,
        panel,
        vec2(900.0, 76.0),
        Theme::Dark,
        1.0,
        "scrub_playing",
    );
}
