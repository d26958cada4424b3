//! How it looks: each picture is committed.

use axiscope::annotate::Pivot;
use axiscope::app::TrueAxesCommand;
use axiscope::app::true_axes::Ghost;

use super::*;

fn annotate(harness: &mut Windowed, command: TrueAxesCommand) {
    apply(harness, Command::TrueAxes(command));
}

#[test]
fn the_name_is_asked_for() {
    let (_folder, paths) = folder(1);
    let mut harness = window_of(Session::first(), &paths, SIZE);
    press(&mut harness, Modifiers::NONE, Key::T);
    snapshot(&mut harness, "name");
}

#[test]
fn a_landing_is_previewed() {
    let (_folder, paths) = folder(1);
    let mut harness = window(&paths, SIZE);
    press(&mut harness, Modifiers::NONE, Key::T);
    let (base, blossom) = where_ends_are(&harness);
    click(&mut harness, base);
    move_to(&mut harness, blossom);
    snapshot(&mut harness, "preview");
}

#[test]
fn an_axis_is_set() {
    let (_folder, paths) = folder(3);
    let mut harness = window(&paths, SIZE);
    press(&mut harness, Modifiers::NONE, Key::T);
    set_by_clicks(&mut harness);
    let end = handle_on_screen(&harness, Handle::BlossomEnd);
    move_to(&mut harness, end + vec2(4.0, 3.0));
    snapshot(&mut harness, "set");
}

#[test]
fn the_ghost_checks_it() {
    let (_folder, paths) = folder(1);
    let mut harness = window(&paths, SIZE);
    press(&mut harness, Modifiers::NONE, Key::T);
    annotate(
        &mut harness,
        TrueAxesCommand::Start(axiscope::annotate::Method::FromPeduncle),
    );
    annotate(&mut harness, TrueAxesCommand::Ghost(Ghost::Turned));
    harness.remove_cursor();
    snapshot(&mut harness, "ghost");
}

#[test]
fn blind_mode_shows_nothing_computed() {
    let (_folder, paths) = folder(2);
    let mut session = Session::first();
    session.true_axes.name = "Ada".into();
    session.true_axes.is_blind = true;
    let mut harness = window_of(session, &paths, SIZE);
    press(&mut harness, Modifiers::NONE, Key::T);
    set_by_clicks(&mut harness);
    harness.remove_cursor();
    snapshot(&mut harness, "blind");
}

#[test]
fn everybody_s_axes_are_compared() {
    let (_folder, paths) = folder(2);
    let mut harness = window(&paths, SIZE);
    press(&mut harness, Modifiers::NONE, Key::T);
    let ends = set_by_clicks(&mut harness);
    press(&mut harness, Modifiers::NONE, Key::T);
    for (name, degrees) in [("Ben", 6.0), ("Cleo", -9.0), ("Dora", 38.0)] {
        let turned = ends
            .turned(glam::DVec3::Z, degrees, Pivot::Middle)
            .expect("an axis");
        set_as(name, &paths[0], turned);
    }
    // Read again with the cloud.
    apply(&mut harness, Command::Go(1));
    apply(&mut harness, Command::Go(-1));
    annotate(&mut harness, TrueAxesCommand::ShowAll(true));
    annotate(&mut harness, TrueAxesCommand::CompareSet);
    harness.remove_cursor();
    snapshot(&mut harness, "agreement");
    // Over the set.
    for section in ["This cloud", "All open clouds"] {
        let at = harness.get_by_label(section).rect().left_center() + vec2(40.0, 0.0);
        click(&mut harness, at);
    }
    harness.remove_cursor();
    settle(&mut harness);
    compare_left(&mut harness, FOLDER, "agreement_set");
}

#[cfg(unix)]
#[test]
fn what_is_not_saved_stays_in_sight() {
    let (folder, paths) = folder(2);
    let mut harness = window(&paths, SIZE);
    press(&mut harness, Modifiers::NONE, Key::T);
    let tmp = folder.path().join("pepper_1.Ada.axis.json.tmp");
    std::fs::create_dir_all(tmp.join("x")).expect("a folder");
    set_by_clicks(&mut harness);
    harness.get_by_label_contains("Not saved:");
    // The window does not close over it.
    harness
        .input_mut()
        .viewports
        .entry(egui::ViewportId::ROOT)
        .or_default()
        .events = vec![egui::ViewportEvent::Close];
    settle(&mut harness);
    harness.get_by_label("Close and lose them");
    std::fs::remove_dir_all(&tmp).expect("removed");
    let again = harness
        .get_all_by_label("Try again")
        .last()
        .expect("offered")
        .rect()
        .center();
    click(&mut harness, again);
    assert!(!annotating(&harness).has_failed() && on_disk(&paths[0]).is_some());
}

#[test]
fn a_narrow_light_window() {
    let (_folder, paths) = folder(1);
    let mut harness = window(&paths, [800.0, 560.0]);
    press(&mut harness, Modifiers::SHIFT, Key::T);
    press(&mut harness, Modifiers::NONE, Key::T);
    set_by_clicks(&mut harness);
    harness.remove_cursor();
    snapshot(&mut harness, "narrow_light");
}
