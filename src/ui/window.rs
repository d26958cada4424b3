//! The window: panels around the view, keys, dialogs, and what is kept for the next time.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

use egui::{CentralPanel, Frame, Panel, ViewportCommand};
use egui_tiles::Tree;

use super::actions::{Act, Action, Group, WindowAct, actions};
use super::annotating;
use super::dialogs::{self, Asked};
use super::layout::{Pane, first_layout, is_wide, layout_from};
use super::paint::Views;
use super::palette::{Answer, Palette};
use super::panes::Panes;
use super::save_image::{self, SaveImage};
use super::scrub::walks_by_rank;
use super::{help, menu, peduncle, status, theme};
use crate::app::folder::{FolderCommand, evaluate_command_line};
use crate::app::worker::Repaint;
use crate::app::{App, Command, PeduncleCommand, Session, command_line, quoted};
use crate::io::companion_path;

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
        let folders = start.session.folder.folders().to_vec();
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
            self.is_about_open = super::about::show(&ctx);
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
        annotating::ask_name(&ctx, self.app.state(), &mut commands);
        self.close(&ctx, &mut commands);
        let was_editing = self.app.state().annotating.is_editing;
        for command in commands {
            self.carry_out(&ctx, command);
        }
        for act in acts {
            match act {
                Act::App(command) => self.carry_out(&ctx, command),
                Act::Window(act) => self.act(&ctx, act),
            }
        }
        if self.app.state().annotating.is_editing && !was_editing {
            self.act(&ctx, WindowAct::Show(Pane::TrueAxis));
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
        match annotating::Farewell::of(ctx, self.app.state(), commands) {
            annotating::Farewell::Close if is_asked => {}
            annotating::Farewell::Close => {
                self.may_close = true;
                ctx.send_viewport_cmd(ViewportCommand::Close);
            }
            annotating::Farewell::Stay => self.is_closing = false,
            annotating::Farewell::Wait => {
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
                Asked::SaveResults(into) => Command::Folder(FolderCommand::SaveResults(into)),
                Asked::Failed(text) => Command::Say { is_error: true, text },
            }));
        }
    }

    fn keys(&self, ctx: &egui::Context, all: &[Action], acts: &mut Vec<Act>) {
        let is_asking = self.app.state().annotating.asks_name || self.is_closing;
        let is_covered = self.is_help_open || self.is_about_open || self.saving.is_some() || is_asking;
        if is_covered || self.palette.is_some() || ctx.text_edit_focused() {
            return;
        }
        let is_focused = ctx.memory(egui::Memory::focused).is_some();
        // Those with more modifiers first: Shift + Left is also a Left.
        let mut keys: Vec<(&Action, egui::KeyboardShortcut)> = all
            .iter()
            .flat_map(|action| action.keys.iter().map(move |key| (action, *key)))
            .collect();
        let modifiers =
            |m: egui::Modifiers| u8::from(m.command) + u8::from(m.ctrl) + u8::from(m.shift) + u8::from(m.alt);
        keys.sort_by_key(|(_, key)| std::cmp::Reverse(modifiers(key.modifiers)));
        for (action, key) in keys {
            // A focused slider or button has these for itself.
            let is_widgets = key.modifiers.is_none()
                && matches!(
                    key.logical_key,
                    egui::Key::Space
                        | egui::Key::ArrowLeft
                        | egui::Key::ArrowRight
                        | egui::Key::ArrowUp
                        | egui::Key::ArrowDown
                );
            // But a button that was clicked does not keep the axis from being turned.
            let turns_axis = action.group == Group::TrueAxis;
            if is_focused && is_widgets && !turns_axis {
                continue;
            }
            // Closes a list or a menu first.
            if key.logical_key == egui::Key::Escape && egui::Popup::is_any_open(ctx) {
                continue;
            }
            let is_first = ctx.input(|i| {
                i.events.iter().any(|event| {
                    matches!(event, egui::Event::Key { key: k, pressed: true, repeat: false, .. } if *k == key.logical_key)
                })
            });
            if ctx.input_mut(|i| i.consume_shortcut(&key))
                && action.is_enabled
                && (is_first || action.repeats)
            {
                acts.push(match action.act {
                    // As the bar under the view does.
                    Act::App(Command::Step(by)) if by.abs() == 1 && walks_by_rank(ctx) => {
                        Act::App(Command::StepRank(by))
                    }
                    _ => action.act.clone(),
                });
            }
        }
    }

    /// Hands a command to the program, but for what only the window can do.
    fn carry_out(&mut self, ctx: &egui::Context, command: Command) {
        if let Command::Peduncle(PeduncleCommand::Ask(wanted)) = command {
            let path = self.app.state().source().map(|s| companion_path(s.path()));
            let name = path.and_then(|p| p.file_name().map(|n| n.to_string_lossy().into_owned()));
            let name = name.as_deref().unwrap_or("peduncle.ply");
            dialogs::peduncle_path(ctx, &self.answers.0, wanted, name);
        } else {
            self.app.apply(command);
        }
    }

    fn act(&mut self, ctx: &egui::Context, act: WindowAct) {
        let answers = self.answers.0.clone();
        match act {
            WindowAct::OpenFiles => dialogs::open_files(ctx, &answers),
            WindowAct::OpenFolder => dialogs::open_folder(ctx, &answers),
            WindowAct::SaveImage => self.saving = Some(SaveImage::new(view_size(self.app.state()))),
            WindowAct::SaveImageOf(size_px) => {
                let name = self.app.state().source().map(|s| s.path().with_extension("png"));
                let name = name.and_then(|n| n.file_name().map(|n| n.to_string_lossy().into_owned()));
                dialogs::save_image(ctx, &answers, name.as_deref().unwrap_or("view.png"), size_px);
            }
            WindowAct::CopyCommandLine => {
                let state = self.app.state();
                let mut words = vec!["axiscope".to_owned()];
                words.extend(command_line(state, "view.png", view_size(state)));
                ctx.copy_text(quoted(&words));
                let mut text = "Copied the command line that draws this view.".to_owned();
                if self.app.state().has_unsaved_peduncle() {
                    text += " The peduncle that was picked is not in it: no file has it yet. Save it first.";
                }
                self.app.apply(Command::Say {
                    is_error: false,
                    text,
                });
            }
            WindowAct::SaveResults => dialogs::save_results(ctx, &answers),
            WindowAct::CopyEvaluation => {
                if let Some(words) = evaluate_command_line(self.app.state()) {
                    ctx.copy_text(quoted(&words));
                    self.app.apply(Command::Say {
                        is_error: false,
                        text: "Copied the command line that evaluates these clouds.".into(),
                    });
                }
            }
            WindowAct::Help => self.is_help_open = true,
            WindowAct::About => self.is_about_open = true,
            WindowAct::Palette => self.palette = Some(Palette::default()),
            WindowAct::Show(pane) => {
                let tile = self.tree.tiles.find_pane(&pane);
                self.tree.make_active(|id, _| Some(id) == tile);
            }
            WindowAct::ResetLayout => {
                self.is_layout_ours = true;
                self.laid_out_for = f32::NAN;
            }
            WindowAct::Quit => ctx.send_viewport_cmd(ViewportCommand::Close),
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

/// The view's size in physical pixels.
fn view_size(state: &crate::app::State) -> [u32; 2] {
    let scale = f64::from(state.pixels_per_point);
    // Clamped to what a picture may have.
    [state.viewport.width_px, state.viewport.height_px].map(|s| (scale * s).round().clamp(1.0, 8192.0) as u32)
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
