//! The target of stored sessions: whatever the bytes are, a window starts.

use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use axiscope::app::{App, Command, Session};

/// A stored session: it is read, or moved aside with a reason; the program starts with it, opens a cloud, and writes it again.
pub fn session(bytes: &[u8], folder: &Path, cloud: &Path) {
    let path = folder.join("session.json");
    std::fs::write(&path, bytes).expect("a file");
    let session = match Session::read(&path) {
        Ok(session) => session,
        Err(error) => {
            assert!(error.to_string().lines().count() == 1, "{error}");
            Session::first()
        }
    };
    let (plane, current) = (session.settings.plane, session.current);
    let mut app = App::new(session, &(Arc::new(|| {}) as _)).expect("threads can be started");
    app.apply(Command::Open(vec![cloud.to_owned()]));
    app.apply(Command::Show(current.unwrap_or(0)));
    app.apply(Command::LookAt(plane));
    let began = Instant::now();
    // A session may ask for millions of random points.
    while app.is_busy() && began.elapsed() < Duration::from_secs(5) {
        app.update(Duration::from_millis(16));
    }
    Session::of(app.state()).write(&path).expect("written");
    // What was written is read again.
    assert!(Session::read(&path).is_ok());
}
