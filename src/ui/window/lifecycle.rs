//! The window from frame to frame: its title, its repaints, the stored session, and its end.

use std::time::{Duration, Instant};

use egui::ViewportCommand;

use super::{Window, theme};
use crate::app::{Command, Session};
use crate::ui::true_axes;

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
        if self.reports_frames {
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

impl Window {
    /// Stores the session if it has changed, at most every few seconds unless `now`.
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

    /// Closes the window on request, but not while axes are still being saved, or after that has failed.
    pub(super) fn close(&mut self, ctx: &egui::Context, commands: &mut Vec<Command>) {
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
}
