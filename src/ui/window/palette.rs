//! The command palette, which finds any action by its name.

use std::ops::ControlFlow;

use egui::{Event, Id, Key, Modal, Modifiers, RichText};

use crate::ui::action::{Act, Action};

/// The command palette while it is open.
#[derive(Debug, Clone, Default)]
pub struct Palette {
    text: String,
    chosen: usize,
}

fn field_id() -> Id {
    Id::unique("the palette's field")
}

impl Palette {
    /// Shows the palette; breaks when it closes, with the chosen act if there is one.
    pub fn show(&mut self, ctx: &egui::Context, actions: &[Action]) -> ControlFlow<Option<Act>> {
        self.take_early_letters(ctx);
        let found: Vec<&Action> = actions.iter().filter(|a| self.matches(a)).collect();
        self.chosen = self.chosen.min(found.len().saturating_sub(1));
        // The palette takes these keys before the field does.
        let (up, down, enter) = ctx.input_mut(|i| {
            (
                i.consume_key(Modifiers::NONE, Key::ArrowUp),
                i.consume_key(Modifiers::NONE, Key::ArrowDown),
                i.consume_key(Modifiers::NONE, Key::Enter),
            )
        });
        if down {
            self.chosen = (self.chosen + 1).min(found.len().saturating_sub(1));
        }
        if up {
            self.chosen = self.chosen.saturating_sub(1);
        }
        let mut picked = enter.then(|| found.get(self.chosen)).flatten().copied();
        let modal = Modal::new(egui::Id::unique("palette")).show(ctx, |ui| {
            ui.set_width(420.0_f32.min(ctx.content_rect().width() - 60.0));
            let label = ui.label("Find a command");
            let field = egui::TextEdit::singleline(&mut self.text)
                .id(field_id())
                .hint_text("Type a part of its name")
                .desired_width(f32::INFINITY);
            let response = ui.add(field).labelled_by(label.id);
            response.request_focus();
            if response.changed() {
                self.chosen = 0;
            }
            ui.add_space(4.0);
            let height = (ctx.content_rect().height() - 200.0).clamp(80.0, 340.0);
            egui::ScrollArea::vertical()
                .max_height(height)
                .auto_shrink([false, false])
                .show(ui, |ui| {
                    if found.is_empty() {
                        ui.label("No command has such a name.");
                    }
                    for (i, action) in found.iter().enumerate() {
                        let is_chosen = i == self.chosen;
                        let keys = action.keys_text(ctx);
                        let text = format!("{}: {}", action.group.title(), action.title);
                        let button = egui::Button::selectable(is_chosen, text)
                            .shortcut_text(RichText::new(keys).weak())
                            .min_size(egui::vec2(ui.available_width(), 0.0));
                        let response = ui.add_enabled(action.is_enabled, button);
                        if is_chosen && (up || down) {
                            response.scroll_to_me(None);
                        }
                        if response.clicked() {
                            picked = Some(action);
                        }
                    }
                });
        });
        match picked {
            Some(action) if action.is_enabled => ControlFlow::Break(Some(action.act.clone())),
            _ if modal.should_close() => ControlFlow::Break(None),
            _ => ControlFlow::Continue(()),
        }
    }

    /// Takes letters that were typed before the field has the keyboard, in the frame in which the palette opens.
    fn take_early_letters(&mut self, ctx: &egui::Context) {
        if ctx.memory(|memory| memory.has_focus(field_id())) {
            return;
        }
        ctx.input_mut(|input| {
            input.events.retain(|event| match event {
                Event::Text(letters) => {
                    self.text.push_str(letters);
                    false
                }
                _ => true,
            });
        });
    }

    /// Whether every word of the text is part of the action's name.
    fn matches(&self, action: &Action) -> bool {
        let name = format!("{} {}", action.group.title(), action.title).to_lowercase();
        self.text
            .to_lowercase()
            .split_whitespace()
            .all(|word| name.contains(word))
    }
}
