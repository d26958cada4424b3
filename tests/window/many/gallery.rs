//! The gallery: the worst first, and one key from one to the next.

use super::{apply, current, press, settle, snapshot, window_on, window_on_peppers};
use axiscope::app::Command;
use axiscope::app::many::{KEPT_PICTURES, ManyCommand};
use axiscope::evaluate::TruthChoice;
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;

#[test]
fn pictures_hang_worst_first_and_open_their_clouds() {
    let (_dir, mut harness) = window_on_peppers();
    press(&mut harness, Modifiers::COMMAND, Key::Num4);
    snapshot(&mut harness, "gallery");
    let folder = &harness.state().app().state().many;
    let mut worst_first: Vec<usize> = (1..10).collect();
    let error = |&place: &usize| folder.rows[place].error_deg(TruthChoice::Auto).expect("an error");
    worst_first.sort_by(|a, b| error(b).total_cmp(&error(a)));
    let names: Vec<String> = worst_first.iter().map(|&p| folder.rows[p].name.clone()).collect();
    // In the order in which one reads.
    let mut places: Vec<(f32, f32, String)> = names
        .iter()
        .map(|name| {
            let at = harness
                .get_by_label_contains(&format!("Picture of {name}"))
                .rect();
            (at.top(), at.left(), name.clone())
        })
        .collect();
    places.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    assert_eq!(places.into_iter().map(|p| p.2).collect::<Vec<_>>(), names);

    harness
        .get_by_label_contains(&format!("Picture of {}", names[1]))
        .click();
    settle(&mut harness);
    assert_eq!(current(&harness), names[1]);
    harness.get_by_label_contains("3-D view of");
    press(&mut harness, Modifiers::SHIFT, Key::PageDown);
    assert_eq!(current(&harness), names[0]);
    press(&mut harness, Modifiers::SHIFT, Key::PageUp);
    press(&mut harness, Modifiers::SHIFT, Key::PageUp);
    assert_eq!(current(&harness), names[2]);
}

#[test]
fn only_pictures_in_sight_are_drawn_and_few_are_kept() {
    let dir = tempfile::TempDir::new().expect("a folder");
    super::write_peppers(dir.path(), 1);
    for number in 0..230 {
        let broken = dir.path().join(format!("broken_{number:03}.ply"));
        std::fs::write(broken, "ply\n").expect("written");
    }
    let mut harness = window_on(dir.path(), [900.0, 600.0], 1.0);
    press(&mut harness, Modifiers::COMMAND, Key::Num4);
    let kept = harness.state().app().state().many.pictures.len();
    assert!((1..30).contains(&kept), "{kept} are drawn");
    let all: Vec<usize> = (0..231).collect();
    apply(&mut harness, Command::Many(ManyCommand::Picture(all)));
    let kept = harness.state().app().state().many.pictures.len();
    assert!(kept <= KEPT_PICTURES, "{kept} are kept");
}
