//! The panels on candidate planes: what they ask for when they are used, and how they look.

use std::sync::Arc;
use std::time::{Duration, Instant};

use axiscope::app::{App, Command, PlaneChoice, Sample, Session, State};
use axiscope::method::Preset;
use axiscope::ui::{hemisphere, ranking, score_map, scrub};
use egui::{Key, Rect, Theme, Ui, Vec2, pos2, vec2};
use egui_kittest::kittest::Queryable;
use egui_kittest::{Harness, SnapshotOptions, SnapshotResults};

type Panel = fn(&mut Ui, &State, &mut Vec<Command>);

/// The program, and what its panels have asked for.
struct Bench {
    app: App,
    commands: Vec<Command>,
}

fn new_app() -> App {
    let repaint = Arc::new(|| {});
    App::new(Session::first(), &(repaint as _)).expect("threads start")
}

fn settle(app: &mut App) {
    let begun = Instant::now();
    loop {
        app.update(Duration::from_millis(16));
        if !app.is_busy() {
            return;
        }
        assert!(
            begun.elapsed() < Duration::from_secs(120),
            "the analysis does not end"
        );
        std::thread::sleep(Duration::from_millis(2));
    }
}

fn app_with(sample: Sample) -> App {
    let mut app = new_app();
    app.apply(Command::OpenSample(sample));
    settle(&mut app);
    assert!(app.state().analysis().is_some());
    app
}

fn set(app: &mut App, change: impl FnOnce(&mut axiscope::evaluate::Request)) {
    let mut request = app.state().settings.request.clone();
    change(&mut request);
    app.apply(Command::Set {
        request: Box::new(request),
        gesture: None,
    });
}

fn harness(app: App, panel: Panel, size: Vec2, theme: Theme, ppp: f32) -> Harness<'static, Bench> {
    let bench = Bench {
        app,
        commands: Vec::new(),
    };
    let mut harness = Harness::builder()
        .with_size(size)
        .with_pixels_per_point(ppp)
        .with_theme(theme)
        .with_step_dt(0.05)
        .with_options(
            SnapshotOptions::new()
                .threshold(1.0)
                .max_failed_pixels(10)
                .output_path("screenshots/panels"),
        )
        .wgpu()
        .build_ui_state(
            move |ui, bench: &mut Bench| {
                let fill = ui.visuals().panel_fill;
                egui::Frame::NONE.fill(fill).inner_margin(8.0).show(ui, |ui| {
                    ui.take_available_space();
                    panel(ui, bench.app.state(), &mut bench.commands);
                });
            },
            bench,
        );
    harness.run();
    harness
}

fn driven(app: App, panel: Panel) -> Harness<'static, Bench> {
    harness(app, panel, vec2(420.0, 440.0), Theme::Dark, 1.0)
}

/// What was asked for since the last time.
fn asked(harness: &mut Harness<'_, Bench>) -> Vec<Command> {
    harness.run();
    std::mem::take(&mut harness.state_mut().commands)
}

/// Does what was asked for, as the window would.
fn obey(harness: &mut Harness<'_, Bench>) -> Vec<Command> {
    let commands = asked(harness);
    for command in commands.clone() {
        harness.state_mut().app.apply(command);
    }
    settle(&mut harness.state_mut().app);
    harness.run();
    commands
}

fn at(g: usize, h: usize) -> Command {
    Command::LookAt(PlaneChoice::At { g, h })
}

fn index_of(state: &State, g: usize, h: usize) -> usize {
    let grid = state.analysis().expect("an analysis").planes.grid;
    grid.index_of(g, h).expect("in the grid")
}

/// The middle of a cell of the score map.
fn cell(map: Rect, u: usize, g: usize, h: usize) -> egui::Pos2 {
    let step = |i: usize| (i as f32 - 0.5) / u as f32;
    pos2(
        egui::lerp(map.x_range(), step(g)),
        egui::lerp(map.y_range(), step(h)),
    )
}

fn click_at(harness: &Harness<'_, Bench>, place: egui::Pos2) {
    harness.hover_at(place);
    for pressed in [true, false] {
        harness.event(egui::Event::PointerButton {
            pos: place,
            button: egui::PointerButton::Primary,
            pressed,
            modifiers: egui::Modifiers::NONE,
        });
    }
}

fn map_of(harness: &Harness<'_, Bench>) -> Rect {
    harness.get_by_label_contains("Score map").rect()
}

// What is asked for.

#[test]
fn a_cell_is_previewed_while_hovered_and_looked_at_when_clicked() {
    let mut harness = driven(app_with(Sample::Pepper), score_map::show);
    let map = map_of(&harness);
    let place = cell(map, 6, 2, 5);
    harness.hover_at(place);
    let index = index_of(harness.state().app.state(), 2, 5);
    assert_eq!(asked(&mut harness), [Command::Preview(Some(index))]);
    // Within the cell there is nothing new to say.
    harness.hover_at(place + vec2(3.0, 2.0));
    assert_eq!(asked(&mut harness), []);
    click_at(&harness, place);
    assert_eq!(asked(&mut harness), [at(2, 5)]);
    harness.hover_at(pos2(2.0, 2.0));
    assert_eq!(asked(&mut harness), [Command::Preview(None)]);
    harness.hover_at(pos2(3.0, 3.0));
    assert_eq!(asked(&mut harness), []);
}

#[test]
fn every_cell_of_the_map_is_the_plane_it_says() {
    for u in [5, 13] {
        let mut app = app_with(Sample::Pepper);
        set(&mut app, |request| request.params.u = u);
        settle(&mut app);
        let mut harness = driven(app, score_map::show);
        let map = map_of(&harness);
        for (g, h) in [(1, 1), (u, 1), (1, u), (u, u), (2, 4)] {
            click_at(&harness, cell(map, u, g, h));
            assert_eq!(asked(&mut harness).last(), Some(&at(g, h)), "u {u}");
        }
    }
}

#[test]
fn a_cell_without_a_score_can_be_looked_at() {
    let app = app_with(Sample::Pepper);
    let analysis = app.state().analysis().expect("an analysis").clone();
    let scores = analysis.ranking.scores_cm();
    let index = scores.iter().position(Option::is_none).expect("a plane without");
    let plane = analysis.planes.grid.candidate(index);
    let mut harness = driven(app, score_map::show);
    click_at(&harness, cell(map_of(&harness), 6, plane.g, plane.h));
    assert_eq!(
        asked(&mut harness),
        [Command::Preview(Some(index)), at(plane.g, plane.h)]
    );
}

#[test]
fn arrow_keys_walk_the_map_and_stop_at_its_border() {
    let mut app = app_with(Sample::Pepper);
    app.apply(at(5, 2));
    let mut harness = driven(app, score_map::show);
    harness.get_by_label_contains("Score map").focus();
    harness.run();
    harness.key_press(Key::ArrowDown);
    assert_eq!(obey(&mut harness), [at(5, 3)]);
    harness.key_press(Key::ArrowRight);
    assert_eq!(obey(&mut harness), [at(6, 3)]);
    harness.key_press(Key::ArrowRight);
    assert_eq!(obey(&mut harness), [at(6, 3)]);
    harness.key_press(Key::ArrowUp);
    assert_eq!(obey(&mut harness), [at(6, 2)]);
    harness.key_press(Key::ArrowLeft);
    assert_eq!(obey(&mut harness), [at(5, 2)]);
}

#[test]
fn the_map_says_what_it_is_to_those_who_do_not_see_it() {
    let mut app = app_with(Sample::Pepper);
    let best = app.state().analysis().expect("an analysis").best.clone();
    let best = best.expect("a plane").candidate;
    app.apply(at(1, 2));
    let harness = driven(app, score_map::show);
    let label = format!(
        "Score map, 36 planes, best g {} h {}, looking at g 1 h 2",
        best.g, best.h
    );
    harness.get_by_label(&label);
}

#[test]
fn the_best_plane_lies_in_the_hemisphere_where_its_normal_points() {
    let app = app_with(Sample::Pepper);
    let analysis = app.state().analysis().expect("an analysis").clone();
    let best = analysis.best.clone().expect("a plane").candidate;
    let mut harness = driven(app, hemisphere::show);
    let disc = harness.get_by_label_contains("Hemisphere").rect();
    let radius = 0.5 * disc.width().min(disc.height()) - 18.0;
    // By hand: seen along the ray from the fruit center to the camera, which has −y upward.
    let toward = (analysis.params.viewpoint - analysis.center).normalize();
    let right = glam::DVec3::NEG_Y.cross(toward).normalize();
    let up = toward.cross(right);
    let normal = best.normal * best.normal.dot(toward).signum();
    let offset = vec2(normal.dot(right) as f32, -normal.dot(up) as f32);
    click_at(&harness, disc.center() + radius * offset);
    let index = index_of(harness.state().app.state(), best.g, best.h);
    assert_eq!(
        asked(&mut harness),
        [Command::Preview(Some(index)), at(best.g, best.h)]
    );
}

#[test]
fn dragging_turns_the_hemisphere_and_a_double_click_turns_it_back() {
    let app = app_with(Sample::Pepper);
    let best = app.state().analysis().expect("an analysis").best.clone();
    let best = best.expect("a plane").candidate;
    let mut harness = driven(app, hemisphere::show);
    let disc = harness.get_by_label_contains("Hemisphere").rect();
    let find = |harness: &mut Harness<'_, Bench>| -> Option<egui::Pos2> {
        let index = index_of(harness.state().app.state(), best.g, best.h);
        for y in 0..22 {
            for x in 0..22 {
                let place = disc.min + vec2(x as f32 + 0.5, y as f32 + 0.5) / 22.0 * disc.size();
                harness.hover_at(place);
                harness.step();
            }
            let commands = std::mem::take(&mut harness.state_mut().commands);
            if commands.contains(&Command::Preview(Some(index))) {
                return Some(pos2(0.0, y as f32));
            }
        }
        None
    };
    let before = find(&mut harness).expect("to be seen");
    let corner = disc.left_top() + vec2(4.0, 4.0);
    harness.hover_at(corner);
    harness.drag_at(corner);
    harness.hover_at(corner + vec2(0.0, 20.0));
    harness.step();
    harness.hover_at(corner + vec2(0.0, 90.0));
    harness.step();
    harness.drop_at(corner + vec2(0.0, 90.0));
    harness.step();
    harness.step();
    let turned = find(&mut harness).expect("to be seen");
    assert_ne!(before, turned);
    click_at(&harness, corner);
    click_at(&harness, corner);
    harness.run();
    assert_eq!(find(&mut harness), Some(before));
}

#[test]
fn rows_are_in_the_order_of_the_scores_and_can_be_sorted() {
    let app = app_with(Sample::Pepper);
    let analysis = app.state().analysis().expect("an analysis").clone();
    let first = analysis.planes.grid.candidate(analysis.ranking.order()[0]);
    let second = analysis.planes.grid.candidate(analysis.ranking.order()[1]);
    let mut harness = harness(app, ranking::show, vec2(640.0, 300.0), Theme::Dark, 1.0);
    let top = |harness: &Harness<'_, Bench>, g: usize, h: usize| {
        let label = format!("Plane g {g} h {h},");
        harness.get_by_label_contains(&label).rect().top()
    };
    assert!(top(&harness, first.g, first.h) < top(&harness, second.g, second.h));
    harness
        .get_by_label_contains(&format!("Plane g {} h {},", second.g, second.h))
        .click();
    let asked_for = asked(&mut harness);
    assert_eq!(asked_for.last(), Some(&at(second.g, second.h)));

    // Twice: from the worst on.
    harness.get_by_label("Sort by score (cm)").click();
    harness.run();
    harness.get_by_label("Sort by score (cm)").click();
    harness.run();
    let worst = *analysis.ranking.order().last().expect("a plane");
    let worst = analysis.planes.grid.candidate(worst);
    let header = harness.get_by_label("Sort by score (cm)").rect();
    assert!(top(&harness, worst.g, worst.h) < header.bottom() + 3.0);
}

#[test]
fn a_plane_chosen_elsewhere_comes_into_view_and_a_scroll_by_hand_stays() {
    let mut app = app_with(Sample::Pepper);
    set(&mut app, |request| request.params.u = 12);
    settle(&mut app);
    let analysis = app.state().analysis().expect("an analysis").clone();
    let far = analysis.planes.grid.candidate(analysis.ranking.order()[60]);
    let mut harness = harness(app, ranking::show, vec2(640.0, 300.0), Theme::Dark, 1.0);
    let label = format!("Plane g {} h {},", far.g, far.h);
    assert!(harness.query_by_label_contains(&label).is_none());
    // Rows out of sight are not laid out.
    assert!(harness.query_all_by_label_contains("Plane g").count() < 30);
    harness.state_mut().app.apply(at(far.g, far.h));
    harness.run();
    let row = harness.get_by_label_contains(&label).rect();
    assert!(row.top() > 60.0 && row.bottom() < 292.0, "{row:?}");

    harness.hover_at(pos2(300.0, 200.0));
    harness.event(egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Point,
        source: egui::MouseWheelSource::Unknown,
        delta: vec2(0.0, 3000.0),
        phase: egui::TouchPhase::Move,
        modifiers: egui::Modifiers::NONE,
    });
    for _ in 0..20 {
        harness.step();
    }
    assert!(harness.query_by_label_contains(&label).is_none());
}

#[test]
fn the_bar_steps_plays_and_takes_typed_planes() {
    let mut app = app_with(Sample::Pepper);
    app.apply(at(3, 2));
    let mut harness = harness(app, scrub::show, vec2(900.0, 90.0), Theme::Dark, 1.0);
    let mut press = |label: &str| {
        harness.get_by_label(label).click();
        harness.run();
        harness.remove_cursor();
        asked(&mut harness)
    };
    assert_eq!(press("Next plane"), [Command::Step(1)]);
    assert_eq!(press("Previous plane"), [Command::Step(-1)]);
    assert_eq!(press("Play"), [Command::Play(true)]);
    assert_eq!(press("Best"), [Command::LookAt(PlaneChoice::Best)]);
    assert_eq!(press("by rank"), []);
    assert_eq!(press("Next plane"), [Command::StepRank(1)]);
    assert_eq!(press("by rank"), []);

    harness.get_by_label("Plane").set_value_accesskit(36.0);
    assert_eq!(asked(&mut harness), [at(6, 6)]);
}

#[test]
fn a_plane_is_typed_by_its_number_or_by_its_steps() {
    let mut app = app_with(Sample::Pepper);
    app.apply(at(3, 2));
    let mut harness = harness(app, scrub::show, vec2(900.0, 90.0), Theme::Dark, 1.0);
    for (typed, wanted) in [("9", at(2, 3)), ("g 4, h 1", at(4, 1)), ("5,5", at(5, 5))] {
        harness.get_by_label("Plane by its number").click();
        harness.run();
        harness.key_press_modifiers(egui::Modifiers::COMMAND, Key::A);
        harness.event(egui::Event::Text(typed.into()));
        harness.run();
        harness.key_press(Key::Enter);
        assert_eq!(asked(&mut harness).last(), Some(&wanted), "{typed}");
    }
}

#[test]
fn panels_say_why_there_is_nothing_to_show() {
    let panels: [Panel; 4] = [score_map::show, hemisphere::show, ranking::show, scrub::show];
    for panel in panels {
        let harness = driven(new_app(), panel);
        harness.get_by_label_contains("No cloud is open");

        let mut app = new_app();
        app.apply(Command::OpenSample(Sample::Pepper));
        let harness = driven(app, panel);
        harness.get_by_label("pepper.ply is being analyzed.");

        let mut app = new_app();
        app.apply(Command::OpenSample(Sample::Pepper));
        app.update(Duration::ZERO);
        app.apply(Command::Cancel);
        if app.state().was_cancelled {
            let mut harness = driven(app, panel);
            harness.get_by_label("Analyze").click();
            assert_eq!(asked(&mut harness), [Command::Resume]);
        }

        let mut app = app_with(Sample::Pepper);
        set(&mut app, |request| request.params.min_partner_fraction = 1.0);
        settle(&mut app);
        let harness = driven(app, panel);
        harness.get_by_label_contains("No candidate plane has a partner for 100 % of the points");
    }
}

#[test]
fn results_of_older_settings_are_called_so() {
    let panels: [Panel; 4] = [score_map::show, hemisphere::show, ranking::show, scrub::show];
    for panel in panels {
        let mut app = app_with(Sample::Pepper);
        assert!(driven_says_nothing_old(&driven(app, panel)));
        app = app_with(Sample::Pepper);
        set(&mut app, |request| request.params.u = 40);
        app.update(Duration::ZERO);
        assert!(app.state().is_stale, "this machine is too fast for the test");
        let harness = driven(app, panel);
        harness.get_by_label_contains("Of the settings before");
    }
}

fn driven_says_nothing_old(harness: &Harness<'_, Bench>) -> bool {
    harness
        .query_by_label_contains("Of the settings before")
        .is_none()
}

// How it looks.

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
        new_app(),
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
    let panel = scrub::show;
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
