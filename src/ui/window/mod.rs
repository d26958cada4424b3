//! The window: the panes, the bars around them, and the sheets over them.

mod about;
pub(super) mod actions;
mod acts;
mod dialogs;
mod help;
mod incoming;
pub(super) mod layout;
mod lifecycle;
mod menu;
pub(super) mod open;
mod palette;
mod panes;
mod save_image;
mod shortcuts;
mod status;
pub(super) mod theme;

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::Instant;

use egui::{CentralPanel, Frame, Panel};
use egui_tiles::Tree;

use super::peduncle;
use crate::app::workers::Repaint;
use crate::app::{App, Command, Session};
use crate::ui::action::{Act, WindowAct};
use crate::ui::inspector::paint::Views;
use crate::ui::pane::Pane;
use crate::ui::true_axes;
use crate::ui::window::actions::actions;
use crate::ui::window::dialogs::Asked;
use crate::ui::window::layout::{first_layout, is_wide, layout_from};
use crate::ui::window::palette::Palette;
use crate::ui::window::panes::Panes;
use save_image::SaveImage;

/// The start of a window.
pub struct Start {
    /// The session stored by the last window.
    pub session: Session,
    /// The file of the session; `None` for a window that stores none.
    pub session_path: Option<PathBuf>,
    /// The files and folders to open.
    pub paths: Vec<PathBuf>,
    /// A problem to show at once.
    pub problem: Option<String>,
}

/// The window.
#[expect(clippy::struct_excessive_bools, reason = "each is a fact of its own")]
pub struct Window {
    app: App,
    tree: Tree<Pane>,
    /// Whether the user has not moved a pane, so that the arrangement follows the window's width.
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
    /// Whether the time of each frame is written to standard error.
    reports_frames: bool,
    last_ui: Option<Instant>,
    /// Whether the window is to be closed as soon as every axis is saved.
    is_closing: bool,
    may_close: bool,
}

impl Window {
    /// Sets the window up, and opens the paths, or else the clouds of the last session, or else a sample.
    ///
    /// # Errors
    /// Returns an error if the operating system starts no thread.
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
            // Files that have come into the folders since stand behind the others.
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
            reports_frames: std::env::var_os("AXISCOPE_FRAMES").is_some(),
            last_ui: None,
            is_closing: false,
            may_close: false,
        })
    }

    /// Returns the program behind the window.
    pub fn app(&self) -> &App {
        &self.app
    }

    /// Returns the program behind the window, for tests that set directly what a person would drag.
    pub fn app_mut(&mut self) -> &mut App {
        &mut self.app
    }

    fn frame(&mut self, ui: &mut egui::Ui) {
        let ctx = ui.ctx().clone();
        let mut acts = Vec::new();
        self.take_files(&ctx, &mut acts);
        let all = actions(self.app.state());
        self.take_keys(&ctx, &all, &mut acts);
        // It has the keyboard from this frame on.
        if let Some(at) = acts
            .iter()
            .position(|act| *act == Act::Window(WindowAct::Palette))
        {
            acts.remove(at);
            self.act(&ctx, WindowAct::Palette);
        }

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
            self.is_about_open = about::show(&ctx);
        }
        if let Some(palette) = &mut self.palette
            && let ControlFlow::Break(chosen) = palette.show(&ctx, &all)
        {
            self.palette = None;
            acts.extend(chosen);
        }
        if let Some(saving) = &mut self.saving
            && let ControlFlow::Break(size_px) = saving.show(&ctx)
        {
            self.saving = None;
            acts.extend(size_px.map(|size_px| Act::Window(WindowAct::SaveImageOf(size_px))));
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

    /// Arranges the panes for the window's width, unless the user has moved one.
    fn lay_out(&mut self, width: f32) {
        if !self.is_layout_ours || self.laid_out_for == width {
            return;
        }
        if self.laid_out_for.is_nan() || is_wide(self.laid_out_for) != is_wide(width) {
            self.tree = first_layout(width);
        }
        self.laid_out_for = width;
    }
}
