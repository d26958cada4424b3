//! The simulator in the window.

use axiscope::app::Session;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;

use crate::helpers::in_window::{Windowed, compare_left, settle, state, window_of};

const FOLDER: &str = "screenshots/panels";

fn opened() -> Windowed {
    opened_at([1600.0, 900.0])
}

fn opened_at(size: [f32; 2]) -> Windowed {
    let mut harness = window_of(Session::first(), Vec::new(), size, 1.0);
    assert!(
        harness.query_by_label("Simulate").is_none(),
        "no tab until it is asked for"
    );
    harness.get_by_label("File").click();
    settle(&mut harness);
    harness.get_by_label_contains("Simulate a pepper").click();
    settle(&mut harness);
    harness
}

#[test]
fn a_slider_is_dragged_and_the_error_over_it_appears_while_nothing_moves_away() {
    let mut harness = opened();
    harness.get_by_label_contains("Drag a slider");
    let slider = |harness: &Windowed| {
        let found = harness.get_by_role_and_label(Role::Slider, "Lean to camera");
        found.rect()
    };
    let rect = slider(&harness);
    let y = rect.center().y;
    harness.drag_at(rect.center());
    settle(&mut harness);
    for share in [0.4, 0.6, 0.7, 0.3] {
        harness.hover_at(egui::pos2(rect.left() + share * rect.width(), y));
        settle(&mut harness);
        assert_eq!(slider(&harness), rect, "the slider stays under the cursor");
    }
    harness.drop_at(egui::pos2(rect.left() + 0.3 * rect.width(), y));
    settle(&mut harness);
    let errors = state(&harness).simulator.trail.points();
    assert!(errors.len() >= 4, "{errors:?}");
    assert!(state(&harness).shows_simulated());
    // Away from the slider, whose explanation would cover the others.
    harness.hover_at(egui::pos2(800.0, 880.0));
    settle(&mut harness);
    harness.get_by_label_contains("Chart: error over Lean to camera (°)");
    compare_left(&mut harness, FOLDER, "simulate");
}

#[test]
fn the_tab_can_be_closed_and_asked_for_again() {
    let mut harness = opened();
    harness.get_by_label("Parameters").click();
    settle(&mut harness);
    assert!(
        harness.query_by_label("Another pepper").is_none(),
        "another tab is in front"
    );
    harness.get_by_label("Simulate").click();
    settle(&mut harness);
    harness.get_by_label("Another pepper").click();
    settle(&mut harness);
    assert_eq!(
        state(&harness).simulator.settings.as_ref().map(|s| s.seed),
        Some(1)
    );
}

#[test]
fn in_a_small_window_the_tab_that_was_asked_for_is_in_sight() {
    let harness = opened_at([1280.0, 800.0]);
    let tab = harness.get_by_label("Simulate").rect();
    let view = harness.get_by_label_contains("3-D view of").rect();
    assert!(
        tab.left() >= 0.0 && tab.right() < view.left(),
        "{tab} beside {view}"
    );
    assert!(tab.width() > 40.0, "all of it: {tab}");
}
