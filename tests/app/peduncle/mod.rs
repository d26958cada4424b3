//! Picking the peduncle without a window: strokes, growing, undo, companions, and what is told of them.

mod companion;
mod found;
mod picking;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::helpers::driving::{act, app, asset, fruit, labeled, set, settle, with_sample, write_cloud};
use axiscope::app::command_line;
use axiscope::app::peduncle::Question;
use axiscope::app::{App, Command, PeduncleCommand, Session, Tool};
use axiscope::evaluate::{TruthChoice, peduncle_disagreement_deg};
use axiscope::fruit::{PeduncleChoice, PickedPoints, read_cloud};
use axiscope::geometry::{Cloud, PointSet};
use axiscope::method::AxisSource;
use axiscope::method::axis_error_rad;
use axiscope::peduncle::{HueRange, Peduncle, PeduncleSource};
use axiscope::render::Viewport;
use axiscope::view::{Coloring, PEDUNCLE_MARK, ViewPreset};
use glam::DVec2;
use tempfile::TempDir;

fn ask(app: &mut App, command: PeduncleCommand) {
    act(app, Command::Peduncle(command));
}

/// Drags a tool along a path in the view, from button down to button up.
fn drag(app: &mut App, removes: bool, path_px: &[DVec2]) {
    for &at_px in path_px {
        app.apply(Command::Peduncle(PeduncleCommand::Draw { at_px, removes }));
        app.update(std::time::Duration::from_millis(16));
    }
    ask(app, PeduncleCommand::EndStroke);
}

/// A copy of the bundled pepper without labels, colors and normals, in a folder of its own.
fn bare_pepper(folder: &TempDir) -> PathBuf {
    let cloud = read_cloud(asset("pepper.ply")).expect("the sample").ply.cloud;
    write_cloud(
        &Cloud::new(cloud.positions().to_vec()),
        &folder.path().join("bare.ply"),
    )
}

fn open(path: &Path) -> App {
    let mut app = app();
    app.set_view(Viewport::new(800.0, 600.0), 1.0, true);
    act(&mut app, Command::Open(vec![path.to_owned()]));
    act(&mut app, Command::View(ViewPreset::Camera));
    app
}

/// A line around the places at which these points show, with room.
fn around(app: &App, points: &PointSet) -> Vec<DVec2> {
    let cloud = fruit(app).cloud().clone();
    let (camera, viewport) = (app.state().camera, app.state().viewport);
    let pixels: Vec<DVec2> = points
        .iter()
        .filter_map(|i| camera.project(cloud.positions()[i], viewport))
        .collect();
    let low = pixels.iter().copied().fold(DVec2::INFINITY, DVec2::min) - 2.0;
    let high = pixels.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max) + 2.0;
    vec![low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)]
}

fn picked(app: &App) -> PointSet {
    app.state()
        .picked_peduncle()
        .map(|p| (**p).clone())
        .expect("picked")
}

fn choice(app: &App) -> PeduncleChoice {
    app.state().settings.request.peduncle.clone()
}

/// These points of the current cloud are its peduncle.
fn pick(app: &mut App, points: &PointSet) {
    let sha256 = fruit(app).file.sha256.clone();
    let picked = PickedPoints::default().with(&sha256, Arc::new(points.clone()));
    ask(app, PeduncleCommand::Choose(PeduncleChoice::Points(picked)));
}

/// How many points are drawn in the highlight's color.
fn highlighted(app: &App) -> usize {
    let scene = app.state().drawn_scene().expect("drawn");
    let colors = scene.points[0].colors.iter();
    colors.filter(|c| **c == PEDUNCLE_MARK).count()
}
