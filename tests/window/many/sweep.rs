//! The map over u and τ, and the way from a cell to its setting.

use super::{press, settle, snapshot, window_on_peppers};
use axiscope::app::Command;
use axiscope::app::many::{ManyCommand, SweepRanges};
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;

#[test]
fn a_cell_of_the_map_opens_its_setting() {
    let (_dir, mut harness) = window_on_peppers();
    press(&mut harness, Modifiers::COMMAND, Key::Num5);
    snapshot(&mut harness, "sweep_empty");
    let ranges = SweepRanges {
        u: [5, 8],
        tau_cm_per_rad: [0.0, 2.0],
        tau_step_cm_per_rad: 0.5,
        ..SweepRanges::default()
    };
    super::apply(
        &mut harness,
        Command::Many(ManyCommand::SweepRanges(Box::new(ranges))),
    );
    harness.get_by_label("Sweep 20 settings over 10 clouds").click();
    settle(&mut harness);
    snapshot(&mut harness, "sweep");
    let map = harness.get_by_label_contains("Map of the mean error").rect();
    // The third of four columns, the second of five rows from below.
    let at = map.left_bottom() + egui::vec2(2.5 / 4.0 * map.width(), -1.5 / 5.0 * map.height());
    harness.hover_at(at);
    settle(&mut harness);
    harness.drag_at(at);
    harness.drop_at(at);
    settle(&mut harness);
    let params = &harness.state().app().state().settings.request.params;
    assert_eq!((params.u, params.tau_cm_per_rad), (7, 0.5));
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(harness.state().app().state().settings.request.params.u, 6);
}
