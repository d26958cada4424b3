//! What the mouse and the keys do.

use axiscope::annotate::Method;

use super::*;

#[test]
fn two_clicks_set_the_axis_where_they_were() {
    let (_folder, paths) = folder(1);
    let mut harness = window(&paths, SIZE);
    press(&mut harness, Modifiers::NONE, Key::T);
    assert!(annotating(&harness).can_edit());
    let (base, blossom) = where_ends_are(&harness);
    move_to(&mut harness, base);
    settle(&mut harness);
    let landing = annotating(&harness)
        .landing
        .expect("it is previewed before it lands");
    set_by_clicks(&mut harness);
    let annotation = on_disk(&paths[0]).expect("a file");
    let ends = annotation.ends().expect("an axis");
    assert!(ends.peduncle_base().distance(landing) < 1e-9 * ends.length());
    let state = state(&harness);
    for (place, screen) in [(ends.peduncle_base(), base), (ends.blossom_end(), blossom)] {
        let at = state.camera.project(place, state.viewport).expect("seen");
        assert!(at.distance(pixel_in(view(&harness), screen)) < 0.01, "{at}");
    }
    harness.get_by_label("Saved in pepper_1.Ada.axis.json");
}

#[test]
fn the_name_is_asked_for_once() {
    let (_folder, paths) = folder(1);
    let mut harness = window_of(Session::first(), &paths, SIZE);
    press(&mut harness, Modifiers::NONE, Key::T);
    assert!(annotating(&harness).asks_name && !annotating(&harness).is_editing);
    harness.event(Event::Text("Ada".into()));
    settle(&mut harness);
    press(&mut harness, Modifiers::NONE, Key::Enter);
    assert!(annotating(&harness).can_edit());
    assert_eq!(annotating(&harness).name, "Ada");
    press(&mut harness, Modifiers::NONE, Key::T);
    press(&mut harness, Modifiers::NONE, Key::T);
    assert!(annotating(&harness).can_edit() && !annotating(&harness).asks_name);
}

#[test]
fn the_left_button_never_moves_the_camera_and_the_others_never_the_axis() {
    let (_folder, paths) = folder(1);
    let mut harness = window(&paths, SIZE);
    press(&mut harness, Modifiers::NONE, Key::T);
    let ends = set_by_clicks(&mut harness);
    let camera = state(&harness).camera;
    let empty = view(&harness).left_center() + vec2(30.0, 60.0);
    drag(&mut harness, PointerButton::Primary, empty, vec2(120.0, 40.0));
    click(&mut harness, empty);
    assert_eq!(state(&harness).camera, camera);
    assert_eq!(
        annotating(&harness).set_ends(),
        Some(ends),
        "a click beside it changes nothing"
    );
    for which in [PointerButton::Secondary, PointerButton::Middle] {
        let from = handle_on_screen(&harness, Handle::PeduncleBase);
        drag(&mut harness, which, from, vec2(60.0, 30.0));
        assert_ne!(state(&harness).camera, camera);
        assert_eq!(annotating(&harness).set_ends(), Some(ends));
    }
    assert_eq!(annotating(&harness).history.undo_steps(), 1);
}

#[test]
fn an_end_is_dragged_in_the_large_view_and_in_a_locked_one() {
    let (_folder, paths) = folder(1);
    let mut harness = window(&paths, SIZE);
    press(&mut harness, Modifiers::NONE, Key::T);
    let before = set_by_clicks(&mut harness);
    let from = handle_on_screen(&harness, Handle::BlossomEnd);
    // Beside it, within reach.
    drag(
        &mut harness,
        PointerButton::Primary,
        from + vec2(8.0, 6.0),
        vec2(40.0, -20.0),
    );
    let after = handle_on_screen(&harness, Handle::BlossomEnd);
    assert!(
        after.distance(from + vec2(40.0, -20.0)) < 0.5,
        "{after} from {from}"
    );
    let ends = annotating(&harness).set_ends().expect("an axis");
    assert_eq!(ends.peduncle_base(), before.peduncle_base());

    let side = locked(&harness, EditView::Side);
    let camera = annotating(&harness).locked.expect("locked views")[1];
    let viewport = axiscope::render::Viewport::new(side.width().into(), side.height().into());
    let base = camera.project(ends.peduncle_base(), viewport).expect("seen");
    let from = side.min + vec2(base.x as f32, base.y as f32);
    drag(&mut harness, PointerButton::Primary, from, vec2(15.0, 0.0));
    let moved = annotating(&harness).set_ends().expect("an axis");
    assert_eq!(moved.blossom_end(), ends.blossom_end());
    let by = moved.peduncle_base() - ends.peduncle_base();
    let right = camera.right_in_world();
    assert!(
        by.normalize().dot(right) > 1.0 - 1e-9,
        "within the locked view's plane"
    );
    assert_eq!(annotating(&harness).history.undo_steps(), 3);
    assert_eq!(on_disk(&paths[0]).expect("a file").ends().copied(), Some(moved));
}

#[test]
fn arrows_turn_the_axis_in_edit_mode_and_walk_the_planes_outside() {
    let (_folder, paths) = folder(1);
    let mut harness = window(&paths, SIZE);
    let plane = state(&harness).chosen_plane_index();
    press(&mut harness, Modifiers::NONE, Key::T);
    set_by_clicks(&mut harness);
    for (modifiers, degrees) in [
        (Modifiers::NONE, 1.0),
        (Modifiers::SHIFT, 5.0),
        (Modifiers::ALT, 0.1),
    ] {
        let before = annotating(&harness).set_ends().expect("an axis");
        press(&mut harness, modifiers, Key::ArrowRight);
        let after = annotating(&harness).set_ends().expect("an axis");
        assert!((after.angle_to_deg(&before) - degrees).abs() < 1e-6);
    }
    assert_eq!(state(&harness).chosen_plane_index(), plane);
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(annotating(&harness).history.redo_steps(), 1);
    press(&mut harness, Modifiers::NONE, Key::T);
    press(&mut harness, Modifiers::NONE, Key::ArrowRight);
    assert_ne!(state(&harness).chosen_plane_index(), plane);
}

#[test]
fn typed_numbers_move_an_end() {
    let (_folder, paths) = folder(1);
    let mut harness = window(&paths, SIZE);
    press(&mut harness, Modifiers::NONE, Key::T);
    let before = set_by_clicks(&mut harness);
    let field = harness.get_by_label("Blossom end X in cm");
    let at = field.rect().center();
    click(&mut harness, at);
    press(&mut harness, Modifiers::COMMAND, Key::A);
    harness.event(Event::Text("7.25".into()));
    settle(&mut harness);
    press(&mut harness, Modifiers::NONE, Key::Enter);
    let after = annotating(&harness).set_ends().expect("an axis");
    assert!((after.blossom_end().x - 7.25).abs() < 1e-12, "{after:?}");
    assert_eq!(after.blossom_end().y, before.blossom_end().y);
    assert_eq!(after.peduncle_base(), before.peduncle_base());
    assert_eq!(annotating(&harness).history.undo_steps(), 2);
}

#[test]
fn buttons_do_what_keys_do() {
    let (_folder, paths) = folder(1);
    let mut harness = window(&paths, SIZE);
    let switch = harness.get_by_label("True axes").rect().center();
    click(&mut harness, switch);
    let begin = harness.get_by_label("Set the axis").rect().center();
    click(&mut harness, begin);
    for label in ["From computed", "5°", "Right", "Flip", "medium", "turned"] {
        let at = harness.get_by_label(label).rect().center();
        click(&mut harness, at);
    }
    let annotation = on_disk(&paths[0]).expect("a file");
    assert_eq!(annotation.judgment.method, Method::FromComputed);
    assert_eq!(
        annotation.judgment.confidence,
        axiscope::annotate::Confidence::new(0.5)
    );
    assert_eq!(annotating(&harness).history.undo_steps(), 4);
    assert!(annotating(&harness).ghost_scene.is_some());
}

#[test]
fn the_loop_needs_only_clicks_and_page_down() {
    let (_folder, paths) = folder(4);
    let mut harness = window(&paths, SIZE);
    press(&mut harness, Modifiers::NONE, Key::T);
    let camera = state(&harness).camera;
    for path in &paths {
        set_by_clicks(&mut harness);
        assert!(on_disk(path).is_some());
        press(&mut harness, Modifiers::NONE, Key::PageDown);
        assert!(annotating(&harness).can_edit());
    }
    assert_eq!(annotating(&harness).progress(), Some((4, 4)));
    assert_eq!(state(&harness).camera.world_from_view, camera.world_from_view);
}

#[test]
fn keys_that_edit_mode_takes_are_listed_once() {
    let (_folder, paths) = folder(1);
    let mut harness = window(&paths, SIZE);
    for is_editing in [false, true] {
        if is_editing {
            press(&mut harness, Modifiers::NONE, Key::T);
        }
        let all = axiscope::ui::actions(state(&harness));
        let mut keys: Vec<_> = all
            .iter()
            .flat_map(|action| action.keys.iter().map(|key| (*key, action.title.clone())))
            .collect();
        while let Some((key, title)) = keys.pop() {
            let again = keys.iter().find(|(other, _)| *other == key);
            assert!(again.is_none(), "{key:?} does “{title}” and {again:?}");
        }
    }
}

#[test]
fn a_number_that_is_dragged_is_one_step() {
    let (_folder, paths) = folder(1);
    let mut harness = window(&paths, SIZE);
    press(&mut harness, Modifiers::NONE, Key::T);
    let before = set_by_clicks(&mut harness);
    let field = harness.get_by_label("Peduncle base Y in cm").rect().center();
    drag(&mut harness, PointerButton::Primary, field, vec2(40.0, 0.0));
    let after = annotating(&harness).set_ends().expect("an axis");
    assert!(after.peduncle_base().y > before.peduncle_base().y + 0.5);
    assert_eq!(after.blossom_end(), before.blossom_end());
    assert!(annotating(&harness).moving.is_none());
    assert_eq!(annotating(&harness).history.undo_steps(), 2);
    let length = harness.get_by_label("Length of the axis").rect().center();
    drag(&mut harness, PointerButton::Primary, length, vec2(30.0, 0.0));
    let longer = annotating(&harness).set_ends().expect("an axis");
    assert!(longer.length() > after.length() + 0.1);
    assert!(longer.middle().distance(after.middle()) < 1e-9);
    assert_eq!(annotating(&harness).history.undo_steps(), 3);
}

#[test]
fn with_shift_an_end_lands_on_the_surface() {
    let (_folder, paths) = folder(1);
    let mut harness = window(&paths, SIZE);
    press(&mut harness, Modifiers::NONE, Key::T);
    let middle = view(&harness).lerp_inside(vec2(0.5, 0.6));
    harness.event(Event::PointerMoved(middle));
    settle(&mut harness);
    let inside = annotating(&harness).landing.expect("inside");
    harness.event(Event::ModifiersChanged(Modifiers::SHIFT));
    move_to(&mut harness, middle + vec2(1.0, 0.0));
    settle(&mut harness);
    let landing = annotating(&harness).landing.expect("on the surface");
    let state = state(&harness);
    let positions = &state.shown().expect("points").positions;
    assert!(positions.contains(&landing));
    let depth = |place| state.camera.depth_of(place);
    assert!(depth(landing) < depth(inside) - 1.0, "nearer to the viewer");
}

#[test]
fn a_focused_button_does_not_take_the_arrows() {
    let (_folder, paths) = folder(1);
    let mut harness = window(&paths, SIZE);
    press(&mut harness, Modifiers::NONE, Key::T);
    set_by_clicks(&mut harness);
    for label in ["Flip", "high", "Hold while turning", "the blossom end"] {
        let at = harness.get_by_label(label).rect().center();
        click(&mut harness, at);
    }
    press(&mut harness, Modifiers::NONE, Key::Tab);
    assert!(harness.ctx.memory(egui::Memory::focused).is_some());
    let before = annotating(&harness).set_ends().expect("an axis");
    press(&mut harness, Modifiers::NONE, Key::ArrowRight);
    let after = annotating(&harness).set_ends().expect("an axis");
    assert!((after.angle_to_deg(&before) - 1.0).abs() < 1e-6);
    assert_eq!(after.blossom_end(), before.blossom_end());
    // Escape closes a list before it leaves edit mode.
    let list = harness.get_by_label("Hold while turning").rect().center();
    click(&mut harness, list);
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert!(annotating(&harness).is_editing);
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert!(!annotating(&harness).is_editing);
}
