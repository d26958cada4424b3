//! True axes by hand, driven without a window: what clicks and keys do, what is saved, what is hidden.

mod edits;
mod saving;
mod together;

use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::helpers::driving::{act, app, asset, settle};
use axiscope::annotate::{Annotation, Author, Confidence, Ends, Judgment, Method, Pivot, Role};
use axiscope::app::many::{Column, Filter, ManyCommand, Sort};
use axiscope::app::true_axes::{Decision, Draft, EditView, Ghost, Handle, Saving, Turn};
use axiscope::app::{App, Command, Sample, Session, Tool, TrueAxesCommand, TruthChoice};
use axiscope::method::AxisSource;
use axiscope::render::{Projection, Viewport};
use axiscope::view::{Coloring, Overlay, ViewPreset};
use glam::{DVec2, DVec3};

/// A folder with copies of the bundled pepper.
fn folder(clouds: usize) -> (tempfile::TempDir, Vec<PathBuf>) {
    let folder = tempfile::tempdir().expect("a folder");
    let bytes = std::fs::read(asset("pepper.ply")).expect("the sample");
    let paths: Vec<PathBuf> = (0..clouds)
        .map(|i| folder.path().join(format!("pepper{i}.ply")))
        .collect();
    for (i, path) in paths.iter().enumerate() {
        // Told apart by their hashes.
        let mut bytes = bytes.clone();
        let at = bytes
            .windows(4)
            .position(|w| w == b"ply\n" || w == b"ply\r")
            .expect("a header");
        let comment = format!("comment copy {i}\n");
        let line_end = at
            + bytes[at..]
                .iter()
                .skip(4)
                .position(|&b| b == b'\n')
                .expect("a line")
            + 5;
        bytes.splice(line_end..line_end, comment.bytes());
        std::fs::write(path, bytes).expect("it can be written");
        std::fs::copy(asset("pepper.truth.json"), path.with_extension("truth.json")).expect("copied");
    }
    (folder, paths)
}

fn annotate(app: &mut App, command: TrueAxesCommand) {
    act(app, Command::TrueAxes(command));
}

/// The program on these clouds, in edit mode, as Ada.
fn editing(paths: &[PathBuf]) -> App {
    let mut app = app();
    app.set_view(Viewport::new(900.0, 700.0), 1.0, true);
    act(&mut app, Command::Open(paths.to_vec()));
    annotate(&mut app, TrueAxesCommand::Edit(true));
    assert!(app.state().true_axes.asks_name, "nobody has said a name yet");
    annotate(&mut app, TrueAxesCommand::Name("Ada".into()));
    assert!(app.state().true_axes.can_edit());
    app
}

/// A click in the large view.
fn click(app: &mut App, pixel: DVec2) -> DVec3 {
    let state = app.state();
    let landing = state
        .true_axes
        .landing_at(pixel, &state.camera, state.viewport)
        .expect("it lands");
    annotate(app, TrueAxesCommand::Place(landing));
    landing
}

const BASE_PX: DVec2 = DVec2::new(430.0, 180.0);
const BLOSSOM_PX: DVec2 = DVec2::new(470.0, 560.0);

fn set_by_clicks(app: &mut App) -> Ends {
    click(app, BASE_PX);
    click(app, BLOSSOM_PX);
    app.state().true_axes.set_ends().expect("an axis")
}

fn ada() -> Author {
    Author::annotator("Ada").expect("a name")
}

fn on_disk(cloud: &Path, author: &Author) -> Option<Annotation> {
    let bytes = std::fs::read(author.axis_path(cloud, 1)).ok()?;
    Some(Annotation::from_json(&bytes).expect("an axis file"))
}
