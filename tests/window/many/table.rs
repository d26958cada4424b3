//! The table: sorted, filtered and walked through; tags and notes.

use super::{current, press, settle, snapshot, window_on_peppers};
use axiscope::app::many::{Column, Sort};
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;

#[test]
fn the_table_is_sorted_by_clicks_and_walked_by_keys() {
    let (_dir, mut harness) = window_on_peppers();
    press(&mut harness, Modifiers::COMMAND, Key::T);
    snapshot(&mut harness, "table");
    harness.get_by_label("Sort by truth °").click();
    settle(&mut harness);
    harness.get_by_label("Sort by truth °").click();
    settle(&mut harness);
    let sort = harness.state().app().state().many.sort;
    let worst_first = Sort {
        by: Column::TrueError,
        is_descending: true,
    };
    assert_eq!(sort, worst_first);
    let folder = harness.state().app().state().many.clone();
    let name = |row: usize| folder.rows[folder.order[row]].name.clone();
    harness.get_by_label_contains(&format!("{},", name(1))).click();
    settle(&mut harness);
    assert_eq!(current(&harness), name(1));
    press(&mut harness, Modifiers::NONE, Key::ArrowDown);
    press(&mut harness, Modifiers::NONE, Key::ArrowDown);
    assert_eq!(current(&harness), name(3));
    press(&mut harness, Modifiers::NONE, Key::ArrowUp);
    assert_eq!(current(&harness), name(2));
    press(&mut harness, Modifiers::NONE, Key::PageDown);
    assert_eq!(current(&harness), name(3));
    press(&mut harness, Modifiers::SHIFT, Key::PageDown);
    assert_eq!(current(&harness), name(2), "the next larger error");
    snapshot(&mut harness, "table_worst_first");
    press(&mut harness, Modifiers::NONE, Key::Enter);
    harness.get_by_label_contains("3-D view of");
}

#[test]
fn the_table_is_searched_and_filtered() {
    let (_dir, mut harness) = window_on_peppers();
    press(&mut harness, Modifiers::COMMAND, Key::T);
    harness.get_by_label("Search names, tags and notes").focus();
    settle(&mut harness);
    harness.event(egui::Event::Text("leaf".into()));
    settle(&mut harness);
    assert_eq!(*harness.state().app().state().many.order, [3, 7]);
    harness.get_by_label_contains("2 of 10 shown");
    snapshot(&mut harness, "table_searched");
    harness.get_by_label("Show all").click();
    settle(&mut harness);
    harness.get_by_label("no error").click();
    settle(&mut harness);
    assert_eq!(*harness.state().app().state().many.order, [0], "the broken one");
}

#[test]
fn tags_are_typed_and_undone() {
    let (dir, mut harness) = window_on_peppers();
    press(&mut harness, Modifiers::COMMAND, Key::T);
    harness.get_by_label("Note on this cloud").focus();
    settle(&mut harness);
    for letter in [" ", "a", "t", " ", "n", "o", "o", "n"] {
        harness.event(egui::Event::Text(letter.into()));
        settle(&mut harness);
    }
    let note = |h: &egui_kittest::Harness<'_, axiscope::ui::Window>| {
        h.state().app().state().many.rows[3].tagged.note.clone()
    };
    assert_eq!(note(&harness), "Seen from below at noon");
    let file = std::fs::read_to_string(dir.path().join("axiscope-tags.json")).expect("it is kept");
    assert!(file.contains("Seen from below at noon"), "{file}");
    harness.get_by_label("Tags of this cloud").focus();
    settle(&mut harness);
    press(&mut harness, Modifiers::NONE, Key::Escape);
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(note(&harness), "Seen from below");
}

#[test]
fn a_narrow_window_in_light_colors() {
    let dir = tempfile::TempDir::new().expect("a folder");
    super::write_peppers(dir.path(), 4);
    let mut harness = super::window_on(dir.path(), [820.0, 600.0], 1.0);
    press(&mut harness, Modifiers::SHIFT, Key::T);
    super::tag(&mut harness, 1, "leaf in front", "Half of it is hidden");
    press(&mut harness, Modifiers::COMMAND, Key::T);
    // Rows of other parameters than those in force.
    press(&mut harness, Modifiers::SHIFT, Key::I);
    snapshot(&mut harness, "table_narrow_stale");
    press(&mut harness, Modifiers::COMMAND, Key::Num4);
    snapshot(&mut harness, "gallery_narrow");
}
