//! The one place in which commands change the state.

use std::path::PathBuf;

use super::state::{Command, PlaneChoice, Tool};
use super::{App, PickQuestion, Step};
use crate::app::inspector::navigate::{framed_camera, preset_camera, projected};
use crate::app::inspector::stages::{AnalyzedFruit, Source};
use crate::app::true_axes::TrueAxesCommand;
use crate::fruit::Request;
use crate::geometry::Unit;
use crate::method::{CenterMethod, Params, Preset};
use crate::undo::History;
use crate::view::ViewPreset;
use crate::view::{PictureSettings, encode_picture};

impl App {
    /// Does what a panel asks for.
    pub fn apply(&mut self, command: Command) {
        if self.state.true_axes.is_blind && command.reveals() {
            self.say(false, "Blind mode hides what is computed.".into());
            return;
        }
        match command {
            Command::Open(paths) => self.open(&paths),
            Command::OpenSample(sample) => {
                let place = self.state.add(Source::Bundled(sample));
                self.list_changed(false);
                self.leave_subject();
                self.show(place);
            }
            Command::Show(place) => self.show(place),
            Command::Go(by) => self.go(by),
            Command::Close => self.close(),
            Command::Reload => {
                self.pool.discard(Some(std::mem::take(&mut self.stages)));
                self.turn += 1;
            }

            Command::Set { request, gesture } => self.set(*request, gesture),
            Command::EndGesture => self.undo.end_gesture(),
            Command::UsePreset(preset) => self.use_preset(preset),
            Command::Undo => self.travel(History::undo),
            Command::Redo => self.travel(History::redo),
            Command::Cancel => {
                if self.analysis.progress().is_some() {
                    self.analysis.cancel();
                    self.state.was_cancelled = true;
                }
            }
            Command::Resume => self.asked = None,
            Command::Compare(truth) => {
                self.state.truth = truth;
                self.state.true_axes.compared = None;
            }

            Command::LookAt(plane) => self.look_at(plane),
            Command::Step(by) => self.step(by),
            Command::StepRank(by) => self.step_rank(by),
            Command::Preview(plane) => self.state.previewed = plane,
            Command::Play(on) => {
                self.state.is_playing = on;
                self.play_phase = 0.0;
            }

            Command::Style(style) => self.state.style = *style,
            Command::Brush(range) => self.state.brush_cm = range,
            Command::PickAt(pixel) => {
                self.pending_click = Some(PickQuestion {
                    pixel,
                    is_click: true,
                });
            }
            Command::PointAt(None) => self.state.pointed_at = None,
            Command::PointAt(Some(pixel)) => {
                if self.pending_click.is_none() {
                    self.pick(PickQuestion {
                        pixel,
                        is_click: false,
                    });
                }
            }
            Command::Pick(point) => self.state.picked = point,

            Command::Camera(camera) => self.state.camera = *camera,
            Command::View(preset) => self.view(preset),
            Command::Frame => self.state.camera = framed_camera(&self.state),
            Command::PivotOnPicked => self.pivot(),
            Command::Project(projection) => {
                self.state.camera = projected(&self.state.camera, projection);
            }
            Command::Peduncle(command) => self.apply_peduncle(command),
            Command::Use(tool) => {
                // One thing at a time has the left button.
                if tool != Tool::Navigate && self.state.true_axes.is_editing {
                    self.annotate(TrueAxesCommand::Edit(false));
                }
                self.state.tool = tool;
            }
            Command::MoveCenter(center) => {
                let mut request = self.state.settings.request.clone();
                request.params.center = CenterMethod::Given(center);
                self.set(request, Some("center"));
            }

            Command::Many(command) => self.apply_folder(command),
            Command::TrueAxes(command) => self.annotate(command),

            Command::Scale(scale) => self.state.interface_scale = scale.clamp(0.5, 3.0),
            Command::Dismiss(id) => self.state.messages.retain(|message| message.id != id),
            Command::Say { is_error, text } => self.say(is_error, text),
            Command::SaveImage { path, size_px } => self.save_image(path, size_px),
        }
    }

    fn open(&mut self, paths: &[PathBuf]) {
        let opened = self.state.open(paths);
        let folders = paths.iter().filter(|path| path.is_dir());
        let folders: Vec<PathBuf> = folders
            .filter_map(|path| std::path::absolute(path).ok())
            .collect();
        self.list_changed(!folders.is_empty());
        self.state.many.folders.retain(|known| !folders.contains(known));
        self.state.many.folders.extend(folders);
        for problem in opened.problems {
            self.say(true, problem);
        }
        match opened.first {
            Some(place) => self.show(place),
            // Whatever was open was a sample, and has gone.
            None if self.state.current.is_none() => {
                let place = self.state.add(Source::Bundled(super::Sample::Pepper));
                self.list_changed(false);
                self.show(place);
            }
            None => {}
        }
    }

    fn show(&mut self, place: usize) {
        if place >= self.state.entries.len() || self.state.current == Some(place) {
            return;
        }
        self.state.current = Some(place);
        self.leave_peduncle();
        // A plane is chosen for one cloud; the next one begins with its best.
        self.state.settings.plane = PlaneChoice::Best;
        self.state.is_playing = false;
        self.needs_framing = true;
        self.leave_subject();
    }

    fn go(&mut self, by: isize) {
        if let Some(place) = self.state.neighbor(by) {
            self.show(place);
        }
    }

    fn close(&mut self) {
        let Some(current) = self.state.current else {
            return;
        };
        let closed = self.state.entries.remove(current);
        // Its folder is no longer open as a whole.
        let is_of = |folder: &PathBuf| {
            let path = std::path::absolute(closed.source.path());
            path.is_ok_and(|path| path.parent() == Some(folder))
        };
        self.state.many.folders.retain(|folder| !is_of(folder));
        self.list_changed(false);
        self.state.current = None;
        self.leave_peduncle();
        if self.state.entries.is_empty() {
            self.analysis.cancel();
            self.looks.cancel();
            self.asked = None;
            self.forget_analysis();
            self.state.warnings.clear();
        } else {
            self.show(current.min(self.state.entries.len() - 1));
        }
    }

    pub(super) fn set(&mut self, request: Request, gesture: Option<&'static str>) {
        if request == self.state.settings.request {
            return;
        }
        self.remember_settings(gesture);
        self.state.settings.request = request;
    }

    fn use_preset(&mut self, preset: Preset) {
        let mut request = self.state.settings.request.clone();
        let read = Params::new(preset, Unit::Centimeter);
        let search = request.params.center.search().unwrap_or_default();
        request.params.center = CenterMethod::of_preset(preset, search);
        request.params.aggregation = read.aggregation;
        request.params.min_partner_fraction = read.min_partner_fraction;
        self.set(request, None);
    }

    /// The settings are about to change.
    fn remember_settings(&mut self, gesture: Option<&str>) {
        let before = Box::new(self.state.settings.clone());
        self.undo.push_of_gesture(Step::Settings(before), gesture);
    }

    /// Undoes or redoes a step: its value and the present one change places.
    fn travel(&mut self, way: fn(&mut History<Step>) -> Option<&mut Step>) {
        match way(&mut self.undo) {
            Some(Step::Settings(settings)) => {
                std::mem::swap(&mut **settings, &mut self.state.settings);
                self.state.previewed = None;
            }
            Some(Step::Tags { path, tagged }) => {
                let now = self.many.tagged(&self.state.many.rows, path);
                let (path, tagged) = (path.clone(), std::mem::replace(tagged, now));
                self.set_tagged(path, tagged);
            }
            None => {}
        }
    }

    fn look_at(&mut self, plane: PlaneChoice) {
        self.state.previewed = None;
        if plane == self.state.settings.plane {
            return;
        }
        // Scrubbing through a hundred planes is one step back.
        let gesture = (plane != PlaneChoice::Best).then_some("plane");
        self.remember_settings(gesture);
        self.state.settings.plane = plane;
    }

    pub(super) fn step(&mut self, by: isize) {
        let Some(analysis) = self.state.analysis() else {
            return;
        };
        let grid = analysis.planes.grid;
        let count = grid.plane_count().cast_signed();
        let from = self.state.chosen_plane_index().unwrap_or(0).cast_signed();
        let to = (from + by).rem_euclid(count).cast_unsigned();
        let candidate = grid.candidate(to);
        self.look_at(PlaneChoice::At {
            g: candidate.g,
            h: candidate.h,
        });
    }

    fn step_rank(&mut self, by: isize) {
        let Some(analysis) = self.state.analysis() else {
            return;
        };
        let order = analysis.ranking.order();
        let chosen = self.state.chosen_plane_index();
        let rank = chosen.and_then(|i| order.iter().position(|&o| o == i));
        let last = order.len().cast_signed() - 1;
        // A plane without a score stands behind all others.
        let from = rank.map_or(last + 1, usize::cast_signed);
        let to = (from + by).clamp(0, last.max(0)).cast_unsigned();
        if let Some(&index) = order.get(to) {
            let candidate = analysis.planes.grid.candidate(index);
            self.look_at(PlaneChoice::At {
                g: candidate.g,
                h: candidate.h,
            });
        }
    }

    /// In a new grid, the plane that was looked at is the one whose normal is nearest.
    pub(super) fn keep_direction(&mut self, walked: &AnalyzedFruit) {
        let (PlaneChoice::At { .. }, Some(before)) = (self.state.settings.plane, self.state.analysis())
        else {
            return;
        };
        let (old, new) = (before.planes.grid, walked.analysis.planes.grid);
        if old == new {
            return;
        }
        let Some(normal) = self.state.chosen_plane_index().map(|i| old.candidate(i).normal) else {
            self.state.settings.plane = PlaneChoice::Best;
            return;
        };
        let along = |normal_there: glam::DVec3| normal_there.dot(normal).abs();
        let nearest = new
            .candidates()
            .max_by(|a, b| along(a.normal).total_cmp(&along(b.normal)));
        if let Some(nearest) = nearest {
            self.state.settings.plane = PlaneChoice::At {
                g: nearest.g,
                h: nearest.h,
            };
        }
    }

    fn view(&mut self, preset: ViewPreset) {
        match preset_camera(&self.state, preset) {
            Some(camera) => self.state.camera = camera,
            None => self.say(
                false,
                match preset {
                    ViewPreset::Axis => "There is no axis to look along.".into(),
                    _ => "There is no plane to look along the normal of.".into(),
                },
            ),
        }
    }

    fn pivot(&mut self) {
        let picked = self.state.picked.zip(self.state.shown());
        let place = picked.map(|(i, shown)| shown.positions[i]);
        let is_blind = self.state.true_axes.is_blind;
        let center = self.state.analysis().map(|a| a.center).filter(|_| !is_blind);
        if let Some(pivot) = place.or(center) {
            self.state.camera.set_pivot(pivot);
        }
    }

    fn save_image(&mut self, path: PathBuf, size_px: [u32; 2]) {
        let (Some(look), Some(walked)) = (self.state.look.clone(), self.state.walked.clone()) else {
            self.say(false, "There is no view to save yet.".into());
            return;
        };
        let settings = PictureSettings {
            version: env!("CARGO_PKG_VERSION").into(),
            arguments: super::command_line(&self.state, &path.display().to_string(), size_px),
            cloud: walked.fruit.file.path.display().to_string(),
            sha256: walked.fruit.file.sha256.clone(),
        };
        let state = self.state.clone();
        self.images.submit(move |_| {
            let image = crate::app::inspector::image::draw(&state, &look, size_px)?;
            let png = encode_picture(&image, &settings).map_err(|e| e.to_string())?;
            std::fs::write(&path, png).map_err(|e| format!("{}: {e}.", path.display()))?;
            Ok(format!("Saved {}.", path.display()))
        });
    }
}
