//! What the panels ask for when they are used, and what they say.

use super::*;

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
    let best = app.state().analysis().expect("an analysis").best;
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
    let best = analysis.best.expect("a plane").candidate;
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
    let best = app.state().analysis().expect("an analysis").best;
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
fn the_ranking_takes_the_error_apart_and_leads_to_the_nearest_candidate() {
    let app = app_with(Sample::MissedPepper);
    let parts = app.state().error_breakdown().expect("it has a truth");
    let mut harness = harness(app, ranking::show, vec2(640.0, 300.0), Theme::Dark, 1.0);
    let [error, choice] = [parts.error_deg, parts.choice_part_deg].map(|part| part.expect("an axis"));
    let (lean, grid) = (parts.lean_part_deg, parts.grid_part_deg);
    let against = "the simulated axis";
    let text = format!(
        "Error {error:.1}° against {against} = {lean:.1}° lean + {grid:.1}° grid + {choice:.1}° choice"
    );
    harness.get_by_label(&text).hover();
    // A tooltip waits.
    harness.run_steps(20);
    let given = parts.true_center.as_ref().expect("the truth tells it");
    harness.get_by_label_contains(&format!("{:.1} cm from the computed one", given.distance_cm));
    harness.get_by_label(&text).click();
    let nearest = &parts.nearest_candidate;
    let wanted = at(nearest.g as usize, nearest.h as usize);
    assert_eq!(asked(&mut harness).last(), Some(&wanted));
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
    let mut harness = harness(app, plane_bar::show, vec2(900.0, 90.0), Theme::Dark, 1.0);
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
    let mut harness = harness(app, plane_bar::show, vec2(900.0, 90.0), Theme::Dark, 1.0);
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
    let panels: [Panel; 4] = [score_map::show, hemisphere::show, ranking::show, plane_bar::show];
    for panel in panels {
        let harness = driven(driving::app(), panel);
        harness.get_by_label_contains("No cloud is open");

        let mut app = driving::app();
        app.apply(Command::OpenSample(Sample::Pepper));
        let harness = driven(app, panel);
        harness.get_by_label("pepper.ply is being analyzed.");

        let mut app = driving::app();
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
    let panels: [Panel; 4] = [score_map::show, hemisphere::show, ranking::show, plane_bar::show];
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
