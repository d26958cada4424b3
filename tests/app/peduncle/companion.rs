//! What is picked is saved, and never over anything else.

use super::*;

#[test]
fn a_saved_companion_gives_the_same_references_in_the_window_and_on_the_command_line() {
    let folder = TempDir::new().expect("a folder");
    let bare = bare_pepper(&folder);
    let mut app = open(&bare);
    act(&mut app, Command::Use(Tool::Lasso));
    let path = around(&app, &labeled());
    drag(&mut app, false, &path);
    let has_peduncle =
        |app: &App| command_line(app.state(), "a.png", [9, 9]).contains(&"--peduncle".to_owned());
    assert!(app.state().has_unsaved_peduncle() && !has_peduncle(&app));
    ask(&mut app, PeduncleCommand::Save);
    let companion = folder.path().join("bare_peduncle.ply");
    assert_eq!(app.state().saved_peduncle(), Some(&*companion));
    let words = command_line(app.state(), "a.png", [9, 9]);
    let at = words.iter().position(|w| w == "--peduncle").expect("it is named");
    assert_eq!(words[at + 1], companion.display().to_string());
    assert!(!folder.path().join("bare_peduncle.ply.tmp").exists());
    let by_hand = app.state().references.clone();

    let ran = assert_cmd::Command::new(env!("CARGO_BIN_EXE_axiscope"))
        .args(["analyze", "--format", "json"])
        .arg(&bare)
        .assert()
        .success();
    let report: serde_json::Value = serde_json::from_slice(&ran.get_output().stdout).expect("JSON");
    let references = report["references"].as_array().expect("a list");
    assert_eq!(references.len(), 2);
    for (reference, axis) in references.iter().zip(&by_hand) {
        assert_eq!(reference["kind"], *axis.source.name());
        for (i, part) in axis.direction.to_array().into_iter().enumerate() {
            assert!((reference["direction"][i].as_f64().expect("a number") - part).abs() < 1e-9);
        }
    }
    let apart = peduncle_disagreement_deg(&by_hand).expect("both");
    assert!((report["peduncle_disagreement_deg"].as_f64().expect("a number") - apart).abs() < 1e-6);

    // After a restart it is still known to be saved.
    let session = Session::of(app.state());
    let mut again = App::new(session, &(Arc::new(|| {}) as _)).expect("threads can be started");
    act(&mut again, Command::Open(vec![bare.clone()]));
    assert_eq!(picked(&again), picked(&app));
    assert_eq!(again.state().saved_peduncle(), Some(&*companion));
    assert!(again.state().messages.is_empty(), "which nobody has to be told");

    // What changes is not saved any more, and what comes back is.
    ask(&mut app, PeduncleCommand::Invert);
    assert!(app.state().has_unsaved_peduncle() && !has_peduncle(&app));
    act(&mut app, Command::Undo);
    assert_eq!(app.state().saved_peduncle(), Some(&*companion));
}

#[test]
fn nothing_is_replaced_without_being_asked_and_nothing_is_lost_where_it_cannot_be_saved() {
    let folder = TempDir::new().expect("a folder");
    let bare = bare_pepper(&folder);
    let companion = folder.path().join("bare_peduncle.ply");
    let mut app = open(&bare);
    ask(&mut app, PeduncleCommand::Save);
    assert!(
        app.state()
            .messages
            .iter()
            .any(|m| m.text.contains("nothing to save"))
    );
    act(&mut app, Command::Use(Tool::Lasso));
    let path = around(&app, &labeled());
    drag(&mut app, false, &path);
    std::fs::write(&companion, "somebody's work").expect("written");
    ask(&mut app, PeduncleCommand::Save);
    assert_eq!(
        app.state().peduncle.question,
        Some(Question::Replace(companion.clone()))
    );
    assert_eq!(
        std::fs::read_to_string(&companion).expect("there"),
        "somebody's work"
    );
    ask(&mut app, PeduncleCommand::Dismiss);
    assert_eq!(app.state().peduncle.question, None);
    let nowhere = folder.path().join("no/such/folder/x.ply");
    let before = picked(&app);
    ask(&mut app, PeduncleCommand::SaveAs(nowhere.clone()));
    let message = app.state().messages.last().expect("it is told").clone();
    assert!(
        message.is_error && message.text.contains(&nowhere.display().to_string()),
        "{}",
        message.text
    );
    assert!(app.state().has_unsaved_peduncle());
    assert_eq!(picked(&app), before);
    // A folder of that name is in the way.
    std::fs::remove_file(&companion).expect("removed");
    std::fs::create_dir(&companion).expect("made");
    ask(&mut app, PeduncleCommand::SaveAs(companion.clone()));
    assert!(app.state().messages.last().expect("told").is_error && app.state().has_unsaved_peduncle());
    assert!(
        !folder.path().join("bare_peduncle.ply.tmp").exists(),
        "no half is left behind"
    );
    std::fs::remove_dir(&companion).expect("removed");
    ask(&mut app, PeduncleCommand::SaveAs(companion.clone()));
    assert_eq!(app.state().saved_peduncle(), Some(&*companion));
}

#[test]
fn a_sample_s_peduncle_is_saved_elsewhere() {
    let folder = TempDir::new().expect("a folder");
    let mut app = with_sample();
    ask(&mut app, PeduncleCommand::Save);
    assert!(
        app.state()
            .messages
            .iter()
            .any(|m| m.text.contains("no folder of its own"))
    );
    let path = folder.path().join("mine.ply");
    ask(&mut app, PeduncleCommand::SaveAs(path.clone()));
    assert_eq!(
        read_cloud(&path).expect("a cloud").ply.cloud.len(),
        labeled().len()
    );
}
