//! The charts, and the way from a bar to its cloud.

use super::{current, press, settle, snapshot, window_on_peppers};
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;

#[test]
fn a_click_on_a_bar_opens_its_cloud() {
    let (_dir, mut harness) = window_on_peppers();
    press(&mut harness, Modifiers::COMMAND, Key::Num3);
    snapshot(&mut harness, "charts");
    let chart = harness.get_by_label_contains("Chart: Each cloud").rect();
    // Ten slots: the eighth, low enough to be within any bar.
    let at = chart.left_top() + chart.size() * egui::vec2(7.5 / 10.0, 0.92);
    harness.hover_at(at);
    settle(&mut harness);
    harness.drag_at(at);
    harness.drop_at(at);
    settle(&mut harness);
    assert_eq!(current(&harness), "pepper_006.ply");
    harness.get_by_label_contains("3-D view of pepper_006.ply");
}

#[test]
fn every_chart_is_drawn() {
    let (_dir, mut harness) = window_on_peppers();
    press(&mut harness, Modifiers::COMMAND, Key::Num3);
    for (title, name) in [
        ("Histogram", "charts_histogram"),
        ("By distance", "charts_distance"),
        ("By lead", "charts_lead"),
    ] {
        harness.get_by_label(title).click();
        settle(&mut harness);
        snapshot(&mut harness, name);
    }
}

#[test]
fn errors_are_shown_over_lean_and_coverage_where_truths_tell_them() {
    let (_dir, mut harness) = window_on_peppers();
    press(&mut harness, Modifiers::COMMAND, Key::Num3);
    for title in ["By lean", "By coverage"] {
        harness.get_by_label(title).click();
        settle(&mut harness);
        harness.get_by_label_contains(&format!("Chart: {title}, 9 clouds"));
    }
}
