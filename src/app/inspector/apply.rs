//! The commands of the inspector.

use std::path::PathBuf;

use glam::DVec3;

use super::image;
use super::navigate::{framed_camera, preset_camera, projected};
use super::{Inspector, Pick};
use crate::app::command::Command;
use crate::app::command_line;
use crate::app::context::Context;
use crate::app::state::PlaneChoice;
use crate::files::write_whole;
use crate::geometry::Unit;
use crate::method::{Candidate, CenterMethod, Params, Preset};
use crate::view::{PictureSettings, ViewPreset, encode_picture};

impl Inspector {
    /// Does what is asked of the inspector.
    pub(in crate::app) fn apply(&mut self, command: Command, cx: &mut Context) {
        let state = &mut cx.state;
        match command {
            Command::Reload => cx.reload(),
            Command::Cancel => {
                if self.analyses.progress().is_some() {
                    self.analyses.cancel();
                    state.was_cancelled = true;
                }
            }
            Command::Resume => self.asked = None,
            Command::Set { request, gesture } => cx.set_request(*request, gesture),
            Command::UsePreset(preset) => use_preset(cx, preset),
            Command::LookFromHere => {
                let mut request = state.settings.request.clone();
                request.params.viewpoint = state.camera.eye_in_world;
                cx.set_request(request, None);
            }
            Command::MoveCenter(center) => {
                let mut request = state.settings.request.clone();
                request.params.center = CenterMethod::Given(center);
                cx.set_request(request, Some("center"));
            }
            Command::Compare(choice) => {
                state.many.against = choice;
                state.many.reorder();
            }

            Command::LookAt(plane) => look_at(cx, plane),
            Command::Step(by) => step(cx, by),
            Command::StepRank(by) => step_rank(cx, by),
            Command::Preview(plane) => state.previewed = plane,
            Command::Play(on) => {
                state.is_playing = on;
                self.play_phase = 0.0;
            }

            Command::Style(style) => state.style = *style,
            Command::Brush(range) => state.brush_cm = range,
            Command::PickAt(at_px) => {
                self.pending_click = Some(Pick {
                    at_px,
                    is_click: true,
                });
            }
            Command::PointAt(None) => state.pointed_at = None,
            Command::PointAt(Some(at_px)) => {
                if self.pending_click.is_none() {
                    let is_click = false;
                    self.pick(Pick { at_px, is_click }, state);
                }
            }
            Command::Pick(point) => state.picked = point,

            Command::Camera(camera) => state.camera = *camera,
            Command::View(preset) => view(cx, preset),
            Command::Frame => state.camera = framed_camera(state),
            Command::PivotOnPicked => pivot(cx),
            Command::Project(projection) => state.camera = projected(&state.camera, projection),
            Command::Use(tool) => state.tool = tool,
            Command::SaveImage { path, size_px } => self.save_image(path, size_px, cx),

            // The program hands these to other parts.
            Command::Open(_)
            | Command::OpenSample(_)
            | Command::Show(_)
            | Command::Go(_)
            | Command::Close
            | Command::Undo
            | Command::Redo
            | Command::EndGesture
            | Command::Estimators(_)
            | Command::Peduncle(_)
            | Command::Many(_)
            | Command::TrueAxes(_)
            | Command::Scale(_)
            | Command::Dismiss(_)
            | Command::Simulate(_)
            | Command::ScanFromHere
            | Command::SaveCloud(_)
            | Command::Say { .. } => {}
        }
    }

    fn save_image(&mut self, path: PathBuf, size_px: [u32; 2], cx: &mut Context) {
        let (Some(look), Some(walked)) = (cx.state.look.clone(), cx.state.walked.clone()) else {
            cx.say(false, "There is no view to save yet.");
            return;
        };
        let settings = PictureSettings {
            version: env!("CARGO_PKG_VERSION").into(),
            arguments: command_line(&cx.state, &path.display().to_string(), size_px),
            cloud: walked.fruit.file.path.display().to_string(),
            sha256: walked.fruit.file.sha256.clone(),
        };
        let state = cx.state.clone();
        self.images.submit(move |_| {
            let image = image::draw(&state, &look, size_px)?;
            let png = encode_picture(&image, &settings).map_err(|e| e.to_string())?;
            write_whole(&path, &png).map_err(|failed| format!("{failed}."))?;
            Ok(format!("Saved {}.", path.display()))
        });
    }
}

fn use_preset(cx: &mut Context, preset: Preset) {
    let mut request = cx.state.settings.request.clone();
    let read = Params::new(preset, Unit::Centimeter);
    let search = request.params.center.search().unwrap_or_default();
    request.params.center = CenterMethod::of_preset(preset, search);
    request.params.aggregation = read.aggregation;
    request.params.min_partner_fraction = read.min_partner_fraction;
    cx.set_request(request, None);
}

fn look_at(cx: &mut Context, plane: PlaneChoice) {
    cx.state.previewed = None;
    if plane != cx.state.settings.plane {
        // Scrubbing through a hundred planes is one step back.
        cx.remember_settings((plane != PlaneChoice::Best).then_some("plane"));
        cx.state.settings.plane = plane;
    }
}

/// Looks at the plane that is `by` further on in the grid, around its end.
pub(super) fn step(cx: &mut Context, by: isize) {
    let Some(analysis) = cx.state.analysis() else {
        return;
    };
    let grid = analysis.planes.grid;
    let count = grid.plane_count().cast_signed();
    let from = cx.state.chosen_plane_index().unwrap_or(0).cast_signed();
    let to = (from + by).rem_euclid(count).cast_unsigned();
    look_at(cx, choice_of(&grid.candidate(to)));
}

fn step_rank(cx: &mut Context, by: isize) {
    let Some(analysis) = cx.state.analysis() else {
        return;
    };
    let order = analysis.ranking.order();
    let chosen = cx.state.chosen_plane_index();
    let rank = chosen.and_then(|i| order.iter().position(|&o| o == i));
    let last = order.len().cast_signed() - 1;
    // A plane without a score stands behind all others.
    let from = rank.map_or(last + 1, usize::cast_signed);
    let to = (from + by).clamp(0, last.max(0)).cast_unsigned();
    if let Some(&index) = order.get(to) {
        let choice = choice_of(&analysis.planes.grid.candidate(index));
        look_at(cx, choice);
    }
}

pub(super) fn choice_of(candidate: &Candidate) -> PlaneChoice {
    PlaneChoice::At {
        g: candidate.g,
        h: candidate.h,
    }
}

fn view(cx: &mut Context, preset: ViewPreset) {
    match preset_camera(&cx.state, preset) {
        Some(camera) => cx.state.camera = camera,
        None if preset == ViewPreset::Axis => cx.say(false, "There is no axis to look along."),
        None => cx.say(false, "There is no plane to look along the normal of."),
    }
}

/// Turns the view about the picked point, or else about the fruit center.
fn pivot(cx: &mut Context) {
    let state = &mut cx.state;
    let picked: Option<DVec3> = state
        .picked
        .zip(state.shown())
        .map(|(i, shown)| shown.positions[i]);
    let is_blind = state.true_axes.is_blind;
    let center = state.analysis().map(|a| a.center).filter(|_| !is_blind);
    if let Some(pivot) = picked.or(center) {
        state.camera.set_pivot(pivot);
    }
}
