//! What keys and menus ask of the window, carried out.

use egui::ViewportCommand;

use super::Window;
use crate::app::command_line;
use crate::app::many::evaluate_command_line;
use crate::app::{Command, PeduncleCommand, quoted};
use crate::fruit::companion_path;
use crate::ui::action::{Act, Action, Group, WindowAct};
use crate::ui::inspector::plane_bar::walks_by_rank;
use crate::ui::window::dialogs;
use crate::ui::window::palette::Palette;
use crate::ui::window::save_image::SaveImage;

impl Window {
    pub(in crate::ui) fn keys(&self, ctx: &egui::Context, all: &[Action], acts: &mut Vec<Act>) {
        let is_asking = self.app.state().true_axes.asks_name || self.is_closing;
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
    pub(in crate::ui) fn carry_out(&mut self, ctx: &egui::Context, command: Command) {
        if let Command::Peduncle(PeduncleCommand::Ask(wanted)) = command {
            let path = self.app.state().source().map(|s| companion_path(s.path()));
            let name = path.and_then(|p| p.file_name().map(|n| n.to_string_lossy().into_owned()));
            let name = name.as_deref().unwrap_or("peduncle.ply");
            dialogs::peduncle_path(ctx, &self.answers.0, wanted, name);
        } else {
            self.app.apply(command);
        }
    }

    pub(in crate::ui) fn act(&mut self, ctx: &egui::Context, act: WindowAct) {
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
}

/// The view's size in physical pixels.
fn view_size(state: &crate::app::State) -> [u32; 2] {
    let scale = f64::from(state.pixels_per_point);
    // Clamped to what a picture may have.
    [state.viewport.width_px, state.viewport.height_px].map(|s| (scale * s).round().clamp(1.0, 8192.0) as u32)
}
