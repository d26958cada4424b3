//! The acts that keys, menus and panels ask for, carried out.

use egui::ViewportCommand;

use super::Window;
use crate::app::command_line;
use crate::app::many::evaluate_command_line;
use crate::app::{Command, PeduncleCommand, SimulatorCommand, Source, quoted};
use crate::fruit::companion_path;
use crate::ui::action::WindowAct;
use crate::ui::pane::Pane;
use crate::ui::window::dialogs;
use crate::ui::window::palette::Palette;
use crate::ui::window::save_image::SaveImage;

impl Window {
    /// Hands a command to the program, but asks for a path itself.
    pub(super) fn carry_out(&mut self, ctx: &egui::Context, command: Command) {
        if let Command::Peduncle(PeduncleCommand::Ask(wanted)) = command {
            let path = self.app.state().source().map(|s| companion_path(s.path()));
            let name = path.and_then(|p| p.file_name().map(|n| n.to_string_lossy().into_owned()));
            let name = name.as_deref().unwrap_or("peduncle.ply");
            dialogs::peduncle_path(ctx, &self.answers.0, wanted, name);
        } else {
            self.app.apply(command);
        }
    }

    pub(super) fn act(&mut self, ctx: &egui::Context, act: WindowAct) {
        let answers = self.answers.0.clone();
        match act {
            WindowAct::OpenFiles => dialogs::open_files(ctx, &answers),
            WindowAct::OpenFolder => dialogs::open_folder(ctx, &answers),
            WindowAct::Simulate => {
                self.act(ctx, WindowAct::Show(Pane::Simulate));
                self.app.apply(Command::Simulate(SimulatorCommand::Open));
            }
            WindowAct::SaveCloud => {
                let name = self.app.state().source().map(Source::name);
                dialogs::save_cloud(ctx, &answers, name.as_deref().unwrap_or("cloud.ply"));
            }
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
                    text += " The picked peduncle is not in it, since it is in no file yet. Save it first.";
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
                if let Some(tile) = tile {
                    self.tree.tiles.set_visible(tile, true);
                }
                self.tree.make_active(|id, _| Some(id) == tile);
            }
            WindowAct::ResetLayout => {
                self.is_layout_ours = true;
                self.laid_out_for = f32::NAN;
            }
            WindowAct::Quit => ctx.send_viewport_cmd(ViewportCommand::Close),
        }
    }
}

/// Returns the view's size in physical pixels.
fn view_size(state: &crate::app::State) -> [u32; 2] {
    let scale = f64::from(state.pixels_per_point);
    // Clamped to the sides that a picture may have.
    [state.viewport.width_px, state.viewport.height_px].map(|s| (scale * s).round().clamp(1.0, 8192.0) as u32)
}
