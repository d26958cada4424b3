//! Tags and notes of clouds, without a window: kept in a file of the folder, and never written over.

use std::path::Path;

use crate::helpers::driving::{act, app, set, settle};
use crate::helpers::peppers::write_peppers;
use axiscope::app::many::ManyCommand;
use axiscope::app::{App, Command};
use axiscope::evaluate::{CloudTags, TAGS_FILE};
use tempfile::TempDir;

/// A program with the folder open, that keeps its rows in `cache`.
fn opened(folder: &Path, cache: &Path) -> App {
    let mut app = app();
    app.keep_rows_in(cache.to_owned());
    act(&mut app, Command::Open(vec![folder.to_owned()]));
    app
}

fn folder(command: ManyCommand) -> Command {
    Command::Many(command)
}

#[test]
fn tags_are_kept_in_a_file_and_undone_in_turn_with_settings() {
    let dir = TempDir::new().expect("a folder");
    let set_folder = dir.path().join("set");
    write_peppers(&set_folder, 2);
    let cache = dir.path().join("cache");
    let mut app = opened(&set_folder, &cache);
    let tag = |app: &mut App, place: usize, tags: &str, note: &str| {
        let tagged = CloudTags {
            note: note.into(),
            ..CloudTags::default().with_tags(tags)
        };
        act(app, folder(ManyCommand::Tag { place, tagged }));
        act(app, Command::EndGesture);
    };
    let tags = |app: &App, place: usize| app.state().many.rows[place].tagged.tags.join("+");
    tag(&mut app, 1, " leaf,  hidden  peduncle,leaf", "see row 7");
    assert_eq!(tags(&app, 1), "hidden peduncle+leaf");
    set(&mut app, |r| r.params.u = 8);
    tag(&mut app, 0, "leaf", "");
    assert_eq!(*app.state().many.known_tags, ["hidden peduncle", "leaf"]);

    let again = opened(&set_folder, &cache);
    assert_eq!(
        (tags(&again, 0), tags(&again, 1)),
        ("leaf".into(), "hidden peduncle+leaf".into())
    );
    assert_eq!(again.state().many.rows[1].tagged.note, "see row 7");
    drop(again);

    act(&mut app, Command::Undo);
    assert_eq!(
        (tags(&app, 0).as_str(), app.state().settings.request.params.u),
        ("", 8)
    );
    act(&mut app, Command::Undo);
    assert_eq!(
        (tags(&app, 1).as_str(), app.state().settings.request.params.u),
        ("hidden peduncle+leaf", 6)
    );
    act(&mut app, Command::Undo);
    assert_eq!(tags(&app, 1), "");
    assert!(!app.state().can_undo);
    for _ in 0..3 {
        act(&mut app, Command::Redo);
    }
    assert_eq!(
        (tags(&app, 0).as_str(), app.state().settings.request.params.u),
        ("leaf", 8)
    );
    assert!(!app.state().can_redo);
    // What one letter after the other is typed is one step.
    for note in ["s", "so", "so d", "so dark"] {
        let tagged = CloudTags {
            note: note.into(),
            ..app.state().many.rows[0].tagged.clone()
        };
        app.apply(folder(ManyCommand::Tag { place: 0, tagged }));
    }
    settle(&mut app);
    act(&mut app, Command::Undo);
    assert_eq!(app.state().many.rows[0].tagged.note, "");
}

#[test]
fn tags_that_make_no_sense_are_never_written_over() {
    for content in [
        "{\"schema\":\"axiscope.tags/1\",\"clouds\":{",
        "{\"schema\":\"axiscope.tags/2\",\"clouds\":{}}",
        "not JSON",
        "",
    ] {
        let dir = TempDir::new().expect("a folder");
        let set = dir.path().join("set");
        write_peppers(&set, 2);
        std::fs::write(set.join(TAGS_FILE), content).expect("written");
        let mut app = opened(&set, &dir.path().join("cache"));
        let says = |app: &App| {
            let messages = app.state().messages.iter();
            messages
                .filter(|m| m.is_error && m.text.contains(TAGS_FILE))
                .count()
        };
        assert_eq!(says(&app), 1, "{content:?}");
        let tagged = CloudTags::default().with_tags("mine");
        act(
            &mut app,
            folder(ManyCommand::Tag {
                place: 0,
                tagged: tagged.clone(),
            }),
        );
        assert_eq!(says(&app), 1);
        assert_eq!(app.state().many.rows[0].tagged, tagged, "it stays in memory");
        assert_eq!(
            std::fs::read_to_string(set.join(TAGS_FILE)).expect("there"),
            content
        );
    }
}

#[test]
fn tags_that_cannot_be_saved_are_told_and_stay() {
    let dir = TempDir::new().expect("a folder");
    let set = dir.path().join("set");
    write_peppers(&set, 2);
    let mut app = opened(&set, &dir.path().join("cache"));
    // As good as a disk that was pulled out.
    std::fs::remove_dir_all(&set).expect("removed");
    let tagged = CloudTags::default().with_tags("late");
    act(
        &mut app,
        folder(ManyCommand::Tag {
            place: 1,
            tagged: tagged.clone(),
        }),
    );
    let mut messages = app.state().messages.iter();
    assert!(messages.any(|m| m.is_error && m.text.contains("could not be saved")));
    assert_eq!(app.state().many.rows[1].tagged, tagged);
}

#[test]
fn another_program_s_tags_are_kept() {
    let dir = TempDir::new().expect("a folder");
    let set = dir.path().join("set");
    write_peppers(&set, 3);
    let (mut one, mut other) = (
        opened(&set, &dir.path().join("a")),
        opened(&set, &dir.path().join("b")),
    );
    for place in 0..3 {
        let app = if place == 1 { &mut other } else { &mut one };
        let tagged = CloudTags::default().with_tags("seen");
        act(app, folder(ManyCommand::Tag { place, tagged }));
    }
    let tags = axiscope::evaluate::read_tags(&set).expect("they can be read");
    assert_eq!(tags.len(), 3);
    assert!(!set.join(format!("{TAGS_FILE}.tmp")).exists());
}
