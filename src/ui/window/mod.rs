//! The window: panels around the view, keys, dialogs, and what is kept for the next time.

mod about;
pub(super) mod actions;
mod acts;
mod dialogs;
mod help;
pub(super) mod layout;
mod menu;
pub(super) mod open;
mod palette;
mod panes;
mod save_image;
pub(super) mod status;
pub(super) mod theme;

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

use egui::{CentralPanel, Frame, Panel, ViewportCommand};
use egui_tiles::Tree;

use super::peduncle;
use crate::app::many::ManyCommand;
use crate::app::workers::Repaint;
use crate::app::{App, Command, PeduncleCommand, Session};
use crate::fruit::companion_path;
use crate::ui::action::{Act, WindowAct};
use crate::ui::inspector::paint::Views;
use crate::ui::pane::Pane;
use crate::ui::true_axes;
use crate::ui::window::actions::actions;
use crate::ui::window::dialogs::Asked;
use crate::ui::window::layout::{first_layout, is_wide, layout_from};
use crate::ui::window::palette::{Answer, Palette};
use crate::ui::window::panes::Panes;
use save_image::SaveImage;

/// How the window begins.
pub struct Start {
    /// What is kept from the last time.
    pub session: Session,
    /// Where it is kept; `None` for a window that keeps nothing.
    pub session_path: Option<PathBuf>,
    /// What is to be opened.
    pub paths: Vec<PathBuf>,
    /// What has to be said at once.
    pub problem: Option<String>,
}

/// The window.
#[expect(
    clippy::struct_excessive_bools,
    reason = "each says one thing that is so or not"
)]
pub struct Window {
    app: App,
    tree: Tree<Pane>,
    /// Whether nobody has moved a panel: then the arrangement follows the window's width.
    is_layout_ours: bool,
    laid_out_for: f32,
    is_help_open: bool,
    is_about_open: bool,
    palette: Option<Palette>,
    saving: Option<SaveImage>,
    answers: (Sender<Asked>, Receiver<Asked>),
    session_path: Option<PathBuf>,
    kept: Option<Session>,
    last_frame: Option<Instant>,
    last_kept: Instant,
    is_gpu: bool,
    is_software: bool,
    title: String,
    /// Whether the time that each frame takes goes to standard error.
    tells_frames: bool,
    last_ui: Option<Instant>,
    /// Whether the window is to be closed as soon as every axis is saved.
    is_closing: bool,
    may_close: bool,
}

impl Window {
    /// Sets the window up and opens what is to be opened: the paths; or else what was open last time;
    /// or else a sample.
    ///
    /// # Errors
    /// Where the operating system starts no thread.
    pub fn new(context: &eframe::CreationContext<'_>, start: Start) -> std::io::Result<Self> {
        let ctx = context.egui_ctx.clone();
        theme::set_up(&ctx);
        let (mut is_gpu, mut is_software) = (false, true);
        if let Some(gpu) = &context.wgpu_render_state {
            let views = Views::new(&gpu.device, gpu.target_format);
            gpu.renderer.write().callback_resources.insert(views);
            is_gpu = true;
            is_software = gpu.adapter.get_info().device_type == wgpu::DeviceType::Cpu;
        }
        let repaint: Repaint = {
            let ctx = ctx.clone();
            Arc::new(move || ctx.request_repaint())
        };
        let layout = start.session.layout.as_deref().and_then(layout_from);
        let (open, current) = (start.session.open.clone(), start.session.current);
        let folders = start.session.many.folders().to_vec();
        let plane = start.session.settings.plane;
        let mut app = App::new(start.session, &repaint)?;
        if let Some(problem) = start.problem {
            app.apply(Command::Say {
                is_error: true,
                text: problem,
            });
        }
        if !start.paths.is_empty() {
            app.apply(Command::Open(start.paths));
        } else if open.iter().any(|path| path.exists()) {
            // What has come into the folders since stands behind what was there.
            let paths = open.into_iter().filter(|path| path.exists());
            let folders = folders.into_iter().filter(|path| path.is_dir());
            app.apply(Command::Open(paths.chain(folders).collect()));
            app.apply(Command::Show(current.unwrap_or(0)));
            app.apply(Command::LookAt(plane));
        }
        if app.state().current.is_none() {
            app.apply(Command::OpenSample(crate::app::Sample::Pepper));
        }
        Ok(Self {
            app,
            is_layout_ours: layout.is_none(),
            tree: layout.unwrap_or_else(|| first_layout(f32::INFINITY)),
            laid_out_for: f32::INFINITY,
            is_help_open: false,
            is_about_open: false,
            palette: None,
            saving: None,
            answers: channel(),
            session_path: start.session_path,
            kept: None,
            last_frame: None,
            last_kept: Instant::now(),
            is_gpu,
            is_software,
            title: String::new(),
            tells_frames: std::env::var_os("AXISCOPE_FRAMES").is_some(),
            last_ui: None,
            is_closing: false,
            may_close: false,
        })
    }

    /// The program behind the window.
    pub fn app(&self) -> &App {
        &self.app
    }

    /// The program behind the window, for tests that set what a person would drag.
    pub fn app_mut(&mut self) -> &mut App {
        &mut self.app
    }

    fn frame(&mut self, ui: &mut egui::Ui) {
        let ctx = ui.ctx().clone();
        let mut acts = Vec::new();
        self.files(&ctx, &mut acts);
        let all = actions(self.app.state());
        self.keys(&ctx, &all, &mut acts);

        let mut commands = Vec::new();
        Panel::top("menu").show(ui, |ui| menu::show(ui, self.app.state(), &all, &mut acts));
        Panel::bottom("status").show(ui, |ui| {
            ui.add_space(2.0);
            status::show(ui, self.app.state(), &mut commands);
            ui.add_space(2.0);
        });
        self.lay_out(ui.available_width());
        let mut viewport = None;
        let mut was_moved = false;
        CentralPanel::default()
            .frame(Frame::new().fill(ui.visuals().panel_fill))
            .show(ui, |ui| {
                let mut panes = Panes {
                    state: self.app.state(),
                    actions: &all,
                    is_gpu: self.is_gpu,
                    acts: &mut acts,
                    commands: &mut commands,
                    viewport: &mut viewport,
                    was_moved: &mut was_moved,
                };
                self.tree.ui(&mut panes, ui);
            });
        self.is_layout_ours &= !was_moved;
        if self.is_help_open {
            self.is_help_open = help::show(&ctx, &all);
        }
        if self.is_about_open {
            self.is_about_open = crate::ui::window::about::show(&ctx);
        }
        if let Some(palette) = &mut self.palette {
            match palette.show(&ctx, &all) {
                Answer::Open => {}
                Answer::Closed => self.palette = None,
                Answer::Chosen(act) => {
                    self.palette = None;
                    acts.push(act);
                }
            }
        }
        if let Some(saving) = &mut self.saving {
            match saving.show(&ctx) {
                save_image::Answer::Open => {}
                save_image::Answer::Closed => self.saving = None,
                save_image::Answer::Chosen(size_px) => {
                    self.saving = None;
                    acts.push(Act::Window(WindowAct::SaveImageOf(size_px)));
                }
            }
        }
        if let Some(viewport) = viewport {
            self.app
                .set_view(viewport, ctx.pixels_per_point(), self.is_software);
        }
        peduncle::question(&ctx, self.app.state(), &mut commands);
        true_axes::ask_name(&ctx, self.app.state(), &mut commands);
        self.close(&ctx, &mut commands);
        let was_editing = self.app.state().true_axes.is_editing;
        for command in commands {
            self.carry_out(&ctx, command);
        }
        for act in acts {
            match act {
                Act::App(command) => self.carry_out(&ctx, command),
                Act::Window(act) => self.act(&ctx, act),
            }
        }
        if self.app.state().true_axes.is_editing && !was_editing {
            self.act(&ctx, WindowAct::Show(Pane::TrueAxes));
        }
    }

    /// Arranges the panels for the window's width, unless somebody has moved one.
    fn lay_out(&mut self, width: f32) {
        if !self.is_layout_ours || self.laid_out_for == width {
            return;
        }
        if self.laid_out_for.is_nan() || is_wide(self.laid_out_for) != is_wide(width) {
            self.tree = first_layout(width);
        }
        self.laid_out_for = width;
    }

    /// Where axes are still being saved, or could not be, the window does not close yet.
    fn close(&mut self, ctx: &egui::Context, commands: &mut Vec<Command>) {
        let is_asked = ctx.input(|i| i.viewport().close_requested());
        if self.may_close || (!is_asked && !self.is_closing) {
            return;
        }
        match true_axes::Farewell::of(ctx, self.app.state(), commands) {
            true_axes::Farewell::Close if is_asked => {}
            true_axes::Farewell::Close => {
                self.may_close = true;
                ctx.send_viewport_cmd(ViewportCommand::Close);
            }
            true_axes::Farewell::Stay => self.is_closing = false,
            true_axes::Farewell::Wait => {
                self.is_closing = true;
                ctx.send_viewport_cmd(ViewportCommand::CancelClose);
                ctx.request_repaint_after(Duration::from_millis(50));
            }
        }
    }

    /// Files that were dropped, and answers of dialogs.
    fn files(&mut self, ctx: &egui::Context, acts: &mut Vec<Act>) {
        let dropped: Vec<PathBuf> = ctx.input(|i| {
            let files = i.raw.dropped_files.iter();
            files.map(|file| file.path().to_owned()).collect()
        });
        if let [path] = &dropped[..]
            && is_companion(path)
        {
            let offer = PeduncleCommand::Offer(path.clone());
            acts.push(Act::App(Command::Peduncle(offer)));
        } else if !dropped.is_empty() {
            // A companion comes along with its cloud.
            let has_cloud = |path: &PathBuf| dropped.iter().any(|cloud| companion_path(cloud) == *path);
            let clouds = dropped.iter().filter(|path| !has_cloud(path));
            acts.push(Act::App(Command::Open(clouds.cloned().collect())));
        }
        while let Ok(answer) = self.answers.1.try_recv() {
            acts.push(Act::App(match answer {
                Asked::Open(paths) => Command::Open(paths),
                Asked::SaveImage(path, size_px) => Command::SaveImage { path, size_px },
                Asked::Peduncle(command) => Command::Peduncle(command),
                Asked::SaveResults(into) => Command::Many(ManyCommand::SaveResults(into)),
                Asked::Failed(text) => Command::Say { is_error: true, text },
            }));
        }
    }

    /// Keeps the session when it has changed, at most every few seconds.
    fn keep(&mut self, now: bool, size: Option<[f32; 2]>) {
        let Some(path) = &self.session_path else { return };
        if !now && self.last_kept.elapsed() < Duration::from_secs(3) {
            return;
        }
        self.last_kept = Instant::now();
        let mut session = Session::of(self.app.state());
        if !self.is_layout_ours {
            session.layout = serde_json::to_string(&self.tree).ok();
        }
        session.window_size = size.or(self.kept.as_ref().and_then(|k| k.window_size));
        if self.kept.as_ref() == Some(&session) {
            return;
        }
        if let Err(problem) = session.write(path) {
            self.session_path = None;
            self.app.apply(Command::Say {
                is_error: true,
                text: format!("{problem}."),
            });
            return;
        }
        self.kept = Some(session);
    }
}

/// Whether a file has a companion's name: `NAME_peduncle.ply`.
fn is_companion(path: &std::path::Path) -> bool {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    stem.ends_with("_peduncle")
}

impl eframe::App for Window {
    fn logic(&mut self, ctx: &egui::Context, _frame: &mut eframe::Frame) {
        let now = Instant::now();
        let elapsed = self.last_frame.map_or(Duration::ZERO, |last| now - last);
        self.last_frame = Some(now);
        self.app.update(elapsed);
        let state = self.app.state();
        let scale = state.interface_scale;
        if (ctx.zoom_factor() - scale).abs() > 1e-3 {
            ctx.set_zoom_factor(scale);
        }
        ctx.set_theme(theme::interface_theme(state.style.theme));
        if state.is_playing {
            ctx.request_repaint();
        } else if state.progress.is_some() {
            ctx.request_repaint_after(Duration::from_millis(80));
        } else if self.app.is_current_busy() {
            ctx.request_repaint_after(Duration::from_millis(5));
        } else if self.app.is_busy() {
            ctx.request_repaint_after(Duration::from_millis(100));
        }
        let title = match state.source() {
            Some(source) => format!("{} – Axiscope", source.name()),
            None => "Axiscope".into(),
        };
        if title != self.title {
            ctx.send_viewport_cmd(ViewportCommand::Title(title.clone()));
            self.title = title;
        }
        let size = ctx.input(|i| i.viewport().inner_rect.map(|r| [r.width(), r.height()]));
        self.keep(false, size);
    }

    fn ui(&mut self, ui: &mut egui::Ui, frame: &mut eframe::Frame) {
        let began = Instant::now();
        self.frame(ui);
        if self.tells_frames {
            let since = self.last_ui.map_or(Duration::ZERO, |last| began - last);
            let drawing = frame.info().cpu_usage.unwrap_or(0.0);
            eprintln!(
                "frame after {:.1} ms: panels {:.2} ms, the frame before {:.2} ms in all",
                1e3 * since.as_secs_f64(),
                1e3 * began.elapsed().as_secs_f64(),
                1e3 * drawing,
            );
            self.last_ui = Some(began);
        }
    }

    fn on_exit(&mut self) {
        self.app.finish();
        self.keep(true, None);
    }

    fn persist_egui_memory(&self) -> bool {
        false
    }
}
