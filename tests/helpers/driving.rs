//! The program behind the window, driven by tests without one.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use axiscope::app::{App, Command, Sample, Session};
use axiscope::fruit::{Fruit, Request, read_cloud};
use axiscope::geometry::{Cloud, PointSet, Unit};
use axiscope::peduncle::Peduncle;
use axiscope::ply::{WriteOptions, write};

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

/// The cloud that is shown, with all that its files say.
pub fn fruit(app: &App) -> &Arc<Fruit> {
    &app.state().walked.as_ref().expect("analyzed").fruit
}

/// Writes a cloud in centimeters and returns its path.
pub fn write_cloud(cloud: &Cloud, path: &Path) -> PathBuf {
    let mut bytes = Vec::new();
    let options = WriteOptions {
        unit: Some(Unit::Centimeter),
        ..WriteOptions::default()
    };
    write(&mut bytes, cloud, &options).expect("written");
    std::fs::write(path, bytes).expect("written");
    path.to_owned()
}

/// The points that the bundled pepper's labels call its peduncle.
pub fn labeled() -> PointSet {
    let cloud = read_cloud(asset("pepper.ply")).expect("the sample").ply.cloud;
    let peduncle = Peduncle::by_label(&cloud).expect("labeled");
    peduncle.in_cloud.into_iter().collect()
}
