//! The program behind the window, driven by tests without one.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use axiscope::app::{App, Command, Sample, Session};
use axiscope::fruit::Request;

/// A program with nothing open.
pub fn app() -> App {
    App::new(Session::first(), &(Arc::new(|| {}) as _)).expect("threads can be started")
}

/// Frames until nothing is under way any more.
pub fn settle(app: &mut App) {
    let began = Instant::now();
    loop {
        app.update(Duration::from_millis(16));
        if !app.is_busy() {
            // Once more, for what the last result asks for.
            app.update(Duration::from_millis(16));
            if !app.is_busy() {
                return;
            }
        }
        assert!(began.elapsed() < Duration::from_mins(1), "it never settles");
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// A program that shows the bundled pepper, analyzed.
pub fn with_sample() -> App {
    let mut app = app();
    app.apply(Command::OpenSample(Sample::Pepper));
    settle(&mut app);
    app
}

/// Does something and waits for what comes of it.
pub fn act(app: &mut App, command: Command) {
    app.apply(command);
    settle(app);
}

/// A bundled cloud's file.
pub fn asset(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("assets").join(name)
}

/// Changes how clouds are analyzed, and waits for it.
pub fn set(app: &mut App, change: impl FnOnce(&mut Request)) {
    let mut request = app.state().settings.request.clone();
    change(&mut request);
    let request = Box::new(request);
    act(
        app,
        Command::Set {
            request,
            gesture: None,
        },
    );
}
