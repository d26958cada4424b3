//! Lasso, brush and saving.

use super::*;

#[test]
fn a_lasso_is_drawn_around_the_peduncle() {
    let folder = TempDir::new().expect("a folder");
    let mut harness = window([1360.0, 860.0], vec![pepper(&folder, false)]);
    apply(&mut harness, Command::View(ViewPreset::Front));
    press(&mut harness, Modifiers::NONE, Key::K);
    assert_eq!(state(&harness).tool, Tool::Lasso);
    let camera = state(&harness).camera;
    let path = around_the_peduncle(&harness);
    drag(
        &mut harness,
        PointerButton::Primary,
        Modifiers::NONE,
        &path,
        |harness| {
            settle(harness);
            assert_eq!(picked(harness), 0, "nothing counts before the button is let go");
            let marked = state(harness).peduncle.marked.as_ref().expect("it shows");
            assert!(10 * marked.points > 9 * labeled().len(), "{}", marked.points);
            snapshot(harness, "lasso");
        },
    );
    assert!(10 * picked(&harness) > 9 * labeled().len());
    assert_eq!(state(&harness).camera, camera, "an edit never moves the camera");
    assert_eq!(state(&harness).references.len(), 2);
    harness.remove_cursor();
    settle(&mut harness);
    snapshot(&mut harness, "picked");

    // The other buttons move the camera and pick nothing.
    let count = picked(&harness);
    let view = harness.get_by_label_contains("3-D view of").rect();
    for button in [PointerButton::Secondary, PointerButton::Middle] {
        let before = state(&harness).camera;
        let line = [view.center(), view.center() + Vec2::new(40.0, 10.0)];
        drag(&mut harness, button, Modifiers::NONE, &line, |_| {});
        assert_ne!(state(&harness).camera, before, "{button:?}");
        assert_eq!(picked(&harness), count);
    }
    // What is under the line is taken away with Shift.
    apply(&mut harness, Command::Camera(Box::new(camera)));
    let path = around_the_peduncle(&harness);
    draw(&mut harness, Modifiers::SHIFT, &path);
    assert!(picked(&harness) < count / 10, "{} of {count}", picked(&harness));
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(picked(&harness), count);
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert_eq!(state(&harness).tool, Tool::Navigate);
    assert!(state(&harness).peduncle.marked.is_none());
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert!(state(&harness).references.is_empty());
}

#[test]
fn a_brush_paints_what_is_under_it() {
    let folder = TempDir::new().expect("a folder");
    let mut harness = window([1100.0, 760.0], vec![pepper(&folder, true)]);
    apply(&mut harness, Command::View(ViewPreset::Front));
    press(&mut harness, Modifiers::NONE, Key::B);
    let radius = state(&harness).peduncle.brush_radius_px;
    let size = state(&harness).style.point_size;
    press(&mut harness, Modifiers::NONE, Key::CloseBracket);
    assert!(state(&harness).peduncle.brush_radius_px > radius);
    assert_eq!(
        state(&harness).style.point_size,
        size,
        "the key is the brush's for now"
    );
    press(&mut harness, Modifiers::NONE, Key::OpenBracket);
    let path = around_the_peduncle(&harness);
    let line = [path[1], path[4].lerp(path[3], 0.5)];
    drag(
        &mut harness,
        PointerButton::Primary,
        Modifiers::NONE,
        &line,
        |harness| {
            settle(harness);
            snapshot(harness, "brush");
        },
    );
    assert!(picked(&harness) > labeled().len() / 2, "{}", picked(&harness));
    // A single click is a dab.
    let view = harness.get_by_label_contains("3-D view of").rect();
    let before = picked(&harness);
    draw(&mut harness, Modifiers::NONE, &[view.center()]);
    assert!(picked(&harness) > before);
    // Ctrl and the wheel size the brush, the wheel alone zooms.
    let camera = state(&harness).camera;
    let before = state(&harness).peduncle.brush_radius_px;
    harness.hover_at(view.center());
    let ctrl = Modifiers::COMMAND | Modifiers::CTRL;
    harness.event(egui::Event::ModifiersChanged(ctrl));
    harness.event(egui::Event::Zoom(1.3));
    harness.step();
    harness.event(egui::Event::ModifiersChanged(Modifiers::NONE));
    settle(&mut harness);
    assert!(state(&harness).peduncle.brush_radius_px > before);
    assert_eq!(state(&harness).camera, camera);
    press(&mut harness, Modifiers::NONE, Key::B);
    assert_eq!(state(&harness).tool, Tool::Navigate);
}

#[test]
fn escape_drops_the_stroke_under_way_first() {
    let folder = TempDir::new().expect("a folder");
    let mut harness = window([1000.0, 700.0], vec![pepper(&folder, false)]);
    apply(&mut harness, Command::View(ViewPreset::Front));
    press(&mut harness, Modifiers::NONE, Key::K);
    let path = around_the_peduncle(&harness);
    drag(
        &mut harness,
        PointerButton::Primary,
        Modifiers::NONE,
        &path,
        |harness| press(harness, Modifiers::NONE, Key::Escape),
    );
    assert_eq!(picked(&harness), 0);
    assert_eq!(state(&harness).tool, Tool::Lasso, "the tool stays in hand");
}

#[test]
fn what_is_picked_is_saved_with_a_key_and_never_over_another_file() {
    let folder = TempDir::new().expect("a folder");
    let cloud = pepper(&folder, false);
    let mut harness = window([1200.0, 800.0], vec![cloud]);
    apply(&mut harness, Command::View(ViewPreset::Front));
    press(&mut harness, Modifiers::NONE, Key::K);
    let path = around_the_peduncle(&harness);
    draw(&mut harness, Modifiers::NONE, &path);
    harness.get_by_label("not saved in a file yet");
    press(&mut harness, Modifiers::COMMAND | Modifiers::SHIFT, Key::C);
    let said = |harness: &Windowed, text: &str| state(harness).messages.iter().any(|m| m.text.contains(text));
    assert!(
        said(&harness, "Save it first"),
        "the command line does not know it"
    );
    press(&mut harness, Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    let companion = folder.path().join("fruit_peduncle.ply");
    assert_eq!(
        read_cloud(&companion).expect("saved").ply.cloud.len(),
        picked(&harness)
    );
    harness.get_by_label_contains("saved as fruit_peduncle.ply");
    // Once more is no question, but another peduncle is.
    press(&mut harness, Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    assert_eq!(state(&harness).peduncle.question, None);
    apply(&mut harness, Command::Peduncle(PeduncleCommand::Invert));
    press(&mut harness, Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    assert_eq!(
        state(&harness).peduncle.question,
        Some(Question::Replace(companion))
    );
    click(&mut harness, "Keep it");
    assert_eq!(state(&harness).peduncle.question, None);
}

#[test]
fn the_tools_fit_a_narrow_window_in_the_light() {
    let folder = TempDir::new().expect("a folder");
    let mut harness = window([820.0, 620.0], vec![pepper(&folder, true)]);
    press(&mut harness, Modifiers::SHIFT, Key::T);
    apply(&mut harness, Command::View(ViewPreset::Front));
    press(&mut harness, Modifiers::NONE, Key::K);
    let path = around_the_peduncle(&harness);
    draw(&mut harness, Modifiers::NONE, &path);
    assert!(picked(&harness) > 0);
    harness.remove_cursor();
    settle(&mut harness);
    snapshot(&mut harness, "narrow_light");
}
