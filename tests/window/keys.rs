//! Every key does one thing, whatever is in hand.

use std::collections::HashMap;
use std::path::Path;
use std::time::Duration;

use axiscope::app::{App, Command, Tool, TrueAxesCommand};
use axiscope::ui::{Action, actions};

use crate::helpers::driving::{act, app, asset};

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
