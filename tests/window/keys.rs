//! Every key does one thing, whatever is in hand.

use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use axiscope::app::{App, Command, Session, Tool, TrueAxesCommand};
use axiscope::ui::{Action, actions};

/// A cloud, analyzed.
fn app(folder: &Path) -> App {
    let mut app = App::new(Session::first(), &(Arc::new(|| {}) as _)).expect("threads can be started");
    let sample = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/pepper.ply");
    let cloud = folder.join("pepper.ply");
    std::fs::copy(sample, &cloud).expect("the sample");
    app.apply(Command::Open(vec![cloud]));
    let began = Instant::now();
    while app.state().look.is_none() || app.is_busy() {
        app.update(Duration::from_millis(1));
        assert!(began.elapsed() < Duration::from_mins(1), "it never settles");
    }
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
    let mut app = app(folder.path());
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
