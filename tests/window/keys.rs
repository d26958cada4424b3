//! Every key does one thing, whatever is in hand.

use std::collections::HashMap;
use std::path::Path;
use std::time::Duration;

use axiscope::annotate::{Confidence, Ends};
use axiscope::app::{App, Command, Session, Tool, TrueAxesCommand};
use axiscope::ui::{Action, actions};
use egui::{Event, Key, Modifiers};
use egui_kittest::kittest::Queryable;
use glam::DVec3;

use crate::helpers::driving::{act, app, asset};
use crate::helpers::in_window::{Windowed, apply, press, settle, state, window_of};

/// A cloud, analyzed.
fn analyzed(folder: &Path) -> App {
    let mut app = app();
    let cloud = folder.join("pepper.ply");
    std::fs::copy(asset("pepper.ply"), &cloud).expect("the sample");
    act(&mut app, Command::Open(vec![cloud]));
    assert!(app.state().look.is_some());
    app
}

fn assert_one_meaning(app: &App, what: &str) {
    let mut meanings: HashMap<String, Vec<String>> = HashMap::new();
    for Action { title, keys, .. } in actions(app.state()) {
        for key in keys {
            let names = meanings.entry(format!("{key:?}")).or_default();
            names.push(title.clone());
        }
    }
    assert!(meanings.len() > 50, "there are keys");
    for (key, names) in meanings {
        assert_eq!(names.len(), 1, "{what}, {key}: {names:?}");
    }
}

#[test]
fn a_key_has_one_meaning_in_each_mode() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut app = analyzed(folder.path());
    assert_one_meaning(&app, "at first");
    for tool in [Tool::MoveCenter, Tool::Lasso, Tool::Brush] {
        app.apply(Command::Use(tool));
        app.update(Duration::ZERO);
        assert_eq!(app.state().tool, tool);
        assert_one_meaning(&app, &format!("{tool:?}"));
    }
    app.apply(Command::Use(Tool::Navigate));
    app.apply(Command::TrueAxes(TrueAxesCommand::Name("Ada".into())));
    app.apply(Command::TrueAxes(TrueAxesCommand::Edit(true)));
    app.update(Duration::ZERO);
    assert!(app.state().true_axes.is_editing);
    assert_one_meaning(&app, "setting an axis");
}

/// A window on the cloud, with an axis set by Ada, in edit mode.
fn editing(folder: &Path) -> Windowed {
    let cloud = folder.join("pepper.ply");
    std::fs::copy(asset("pepper.ply"), &cloud).expect("the sample");
    let mut session = Session::first();
    session.true_axes.name = "Ada".into();
    let mut harness = window_of(session, vec![cloud], [1100.0, 760.0], 1.0);
    press(&mut harness, Modifiers::NONE, Key::T);
    let ends = Ends::new(DVec3::new(0.0, -4.0, 60.0), DVec3::new(0.0, 4.0, 61.0)).expect("an axis");
    apply(&mut harness, Command::TrueAxes(TrueAxesCommand::SetEnds(ends)));
    assert!(state(&harness).true_axes.judgment().is_some());
    harness
}

#[test]
fn going_to_a_panel_never_edits_the_axis() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut harness = editing(folder.path());
    let before = state(&harness).true_axes.history.clone();
    for key in [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5] {
        press(&mut harness, Modifiers::COMMAND, key);
        assert_eq!(state(&harness).true_axes.history, before, "{key:?}");
    }
    press(&mut harness, Modifiers::COMMAND, Key::Num2);
    harness.get_by_label("Search names, tags and notes");
    // The rows of the table have the arrows as long as they have the focus.
    harness.get_by_label_contains("pepper.ply,").click();
    settle(&mut harness);
    press(&mut harness, Modifiers::NONE, Key::ArrowDown);
    assert_eq!(state(&harness).true_axes.history, before, "the arrows walk");
    press(&mut harness, Modifiers::NONE, Key::F3);
    let judgment = state(&harness).true_axes.judgment().cloned().expect("one");
    assert_eq!(judgment.confidence, Some(Confidence::MEDIUM));
}

#[test]
fn the_palette_has_the_keyboard_from_the_frame_in_which_it_opens() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut harness = editing(folder.path());
    let before = (state(&harness).style.clone(), state(&harness).true_axes.ghost);
    let pressed = |key, modifiers| Event::Key {
        key,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers,
    };
    // All in one frame, as a slow frame collects what is typed fast.
    harness.event(pressed(Key::K, Modifiers::COMMAND));
    for (key, letter) in [(Key::G, "g"), (Key::A, "a"), (Key::L, "l")] {
        harness.event(pressed(key, Modifiers::NONE));
        harness.event(Event::Text(letter.into()));
    }
    settle(&mut harness);
    let now = (state(&harness).style.clone(), state(&harness).true_axes.ghost);
    assert_eq!(now, before, "no letter is a shortcut");
    harness.get_by_label_contains("Panel: Gallery");
    assert!(
        harness.query_by_label_contains("Panel: Charts").is_none(),
        "all letters are in the field"
    );
}
