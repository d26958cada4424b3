//! What clicks, drags and keys do to an axis.

use super::*;
#[test]
fn two_clicks_make_an_axis_file() {
    let (_folder, paths) = folder(1);
    let mut app = editing(&paths);
    assert_eq!(app.state().true_axes.next_end(), Some(Handle::PeduncleBase));
    assert_eq!(app.state().true_axes.saving, Saving::Nothing);
    click(&mut app, BASE_PX);
    assert_eq!(app.state().true_axes.next_end(), Some(Handle::BlossomEnd));
    assert!(on_disk(&paths[0], &ada()).is_none(), "half an axis is none");
    click(&mut app, BLOSSOM_PX);
    assert_eq!(app.state().true_axes.next_end(), None);
    assert_eq!(app.state().true_axes.saving, Saving::Saved);

    let annotation = on_disk(&paths[0], &ada()).expect("a file");
    assert_eq!(annotation.judgment.method, Method::ByHand);
    assert!(!annotation.judgment.blind);
    let ends = annotation.ends().expect("an axis");
    assert_eq!(Some(*ends), app.state().true_axes.set_ends());
    let state = app.state();
    for (end, pixel) in [(ends.peduncle_base(), BASE_PX), (ends.blossom_end(), BLOSSOM_PX)] {
        let at = state.camera.project(end, state.viewport).expect("before the eye");
        assert!(at.distance(pixel) < 1e-6, "{at} instead of {pixel}");
    }
    // Inside the fruit: both ends are as deep as its middle, which no point of the surface is.
    let subject = state.true_axes.subject.as_ref().expect("a cloud");
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
fn a_nudge_turns_by_as_much_as_it_says() {
    let (_folder, paths) = folder(1);
    let mut app = editing(&paths);
    let before = set_by_clicks(&mut app);
    for (turn, degrees) in [(Turn::Picture, 0.1), (Turn::Lean, 1.0), (Turn::Picture, -5.0)] {
        let before = app.state().true_axes.set_ends().expect("an axis");
        annotate(&mut app, TrueAxesCommand::Nudge(turn, degrees));
        let after = app.state().true_axes.set_ends().expect("an axis");
        assert!((after.angle_to_deg(&before) - degrees.abs()).abs() < 1e-9);
        assert!(after.middle().distance(before.middle()) < 1e-9 * after.length());
    }
    annotate(&mut app, TrueAxesCommand::SetEnds(before));
    // Clockwise as it is seen: the upper end goes to the right.
    let at = |app: &App, place| {
        app.state()
            .camera
            .project(place, app.state().viewport)
            .expect("seen")
    };
    annotate(&mut app, TrueAxesCommand::Nudge(Turn::Picture, 5.0));
    let after = app.state().true_axes.set_ends().expect("an axis");
    assert!(at(&app, after.peduncle_base()).x > at(&app, before.peduncle_base()).x + 5.0);
    annotate(&mut app, TrueAxesCommand::SetEnds(before));
    annotate(&mut app, TrueAxesCommand::Nudge(Turn::Lean, 5.0));
    let after = app.state().true_axes.set_ends().expect("an axis");
    let depth = |place| app.state().camera.depth_of(place);
    assert!(
        depth(after.peduncle_base()) > depth(before.peduncle_base()),
        "away from the viewer"
    );
    // What is held stays.
    annotate(&mut app, TrueAxesCommand::Hold(Pivot::BlossomEnd));
    annotate(&mut app, TrueAxesCommand::Nudge(Turn::Lean, 5.0));
    let held = app.state().true_axes.set_ends().expect("an axis");
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
        state.true_axes.handle_at(near, &state.camera, state.viewport),
        Some(Handle::PeduncleBase)
    );
    let far = BASE_PX + DVec2::new(30.0, 0.0);
    assert_eq!(
        state.true_axes.handle_at(far, &state.camera, state.viewport),
        None
    );
    annotate(
        &mut app,
        TrueAxesCommand::Grab {
            handle: Handle::PeduncleBase,
            view: EditView::Main,
            at_px: near,
        },
    );
    for step in 1..=10 {
        let state = app.state();
        let grab = state.true_axes.grabbed.expect("held");
        let cursor = near + f64::from(step) * DVec2::new(3.0, 1.0);
        let place = state
            .true_axes
            .held_at(&grab, cursor, &state.camera, state.viewport);
        annotate(&mut app, TrueAxesCommand::Drag(place));
    }
    assert_eq!(
        app.state().true_axes.set_ends(),
        Some(before),
        "not before it is let go"
    );
    annotate(&mut app, TrueAxesCommand::Drop);
    let after = app.state().true_axes.set_ends().expect("an axis");
    assert_eq!(after.blossom_end(), before.blossom_end());
    let state = app.state();
    let at = state
        .camera
        .project(after.peduncle_base(), state.viewport)
        .expect("seen");
    assert!(at.distance(BASE_PX + DVec2::new(30.0, 10.0)) < 1e-6, "{at}");
    let depth = |place| state.camera.depth_of(place);
    assert!((depth(after.peduncle_base()) - depth(before.peduncle_base())).abs() < 1e-9);
    assert_eq!(state.true_axes.history.undo_steps(), 2, "one drag is one step");
    // Escape puts back what is held.
    annotate(
        &mut app,
        TrueAxesCommand::Grab {
            handle: Handle::Middle,
            view: EditView::Side,
            at_px: near,
        },
    );
    annotate(&mut app, TrueAxesCommand::Drag(after.middle() + DVec3::X));
    let moved = app.state().true_axes.ends().expect("dragged");
    assert!((moved.direction() - after.direction()).length() < 1e-9);
    annotate(&mut app, TrueAxesCommand::Escape);
    assert_eq!(app.state().true_axes.ends(), Some(after));
}

#[test]
fn locked_views_show_the_axis_upright_and_end_on() {
    let (_folder, paths) = folder(1);
    let mut app = editing(&paths);
    let upright = app.state().true_axes.locked.expect("locked views in edit mode");
    assert!(
        (upright[0].up_in_world() - DVec3::NEG_Y).length() < 1e-9,
        "no axis yet"
    );
    let ends = set_by_clicks(&mut app);
    let cameras = app.state().true_axes.locked.expect("locked views");
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
        TrueAxesCommand::Grab {
            handle: Handle::BlossomEnd,
            view: EditView::Side,
            at_px: DVec2::ZERO,
        },
    );
    annotate(&mut app, TrueAxesCommand::Drag(ends.blossom_end() + DVec3::X));
    assert_eq!(app.state().true_axes.locked, Some(cameras));
    annotate(&mut app, TrueAxesCommand::Drop);
    assert_ne!(app.state().true_axes.locked, Some(cameras));
    let small = app.state().true_axes.small_scene.as_ref().expect("a scene");
    assert!(small.points[0].positions.len() <= 20_000);
    annotate(&mut app, TrueAxesCommand::Edit(false));
    assert!(app.state().true_axes.locked.is_none() && app.state().true_axes.small_scene.is_none());
}

#[test]
fn the_ghost_of_a_true_axis_lies_on_the_cloud() {
    let (_folder, paths) = folder(1);
    let mut app = editing(&paths);
    let before = set_by_clicks(&mut app);
    assert!(app.state().true_axes.ghost_scene.is_none());
    annotate(&mut app, TrueAxesCommand::Ghost(Ghost::Turned));
    let ghost_of = |app: &App| {
        let scene = app.state().true_axes.ghost_scene.clone().expect("a ghost");
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
        TrueAxesCommand::Preview(before.shifted(DVec3::X).expect("an axis")),
    );
    assert_ne!(ghost_of(&app).1, ghost_before);
    annotate(&mut app, TrueAxesCommand::Escape);
    assert_eq!(ghost_of(&app).1, ghost_before);
    annotate(&mut app, TrueAxesCommand::Ghost(Ghost::Mirrored));
    let (cloud, ghost, _) = ghost_of(&app);
    let ray = app
        .state()
        .true_axes
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
fn escape_leaves_one_thing_at_a_time() {
    let (_folder, paths) = folder(1);
    let mut app = editing(&paths);
    click(&mut app, BASE_PX);
    annotate(&mut app, TrueAxesCommand::Escape);
    assert_eq!(app.state().true_axes.draft, Draft::None);
    assert!(app.state().true_axes.is_editing);
    annotate(&mut app, TrueAxesCommand::Escape);
    assert!(!app.state().true_axes.is_editing);
    // Outside of edit mode nothing sets anything.
    annotate(&mut app, TrueAxesCommand::Place(DVec3::ONE));
    annotate(&mut app, TrueAxesCommand::CannotTell);
    assert!(app.state().true_axes.judgment().is_none());
    assert!(on_disk(&paths[0], &ada()).is_none());
}

#[test]
fn another_tool_ends_edit_mode() {
    let (_folder, paths) = folder(1);
    let mut app = editing(&paths);
    act(&mut app, Command::Use(Tool::MoveCenter));
    assert!(!app.state().true_axes.is_editing && app.state().tool == Tool::MoveCenter);
    annotate(&mut app, TrueAxesCommand::Edit(true));
    assert!(app.state().true_axes.is_editing && app.state().tool == Tool::Navigate);
}

#[test]
fn clicks_land_as_deep_as_the_fruit_s_axis_truly_lies() {
    let (_folder, paths) = folder(1);
    let mut app = app();
    act(&mut app, Command::Open(paths));
    let state = app.state();
    let subject = state.true_axes.subject.as_ref().expect("a cloud");
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
