//! Tags and note of the current cloud.

use egui::{Id, Label, RichText, TextEdit, Ui};

use crate::app::many::{ManyCommand, TableRow};
use crate::app::{Command, State};
use crate::evaluate::CloudTags;
use crate::ui::widgets::controls::{small, warning_color};

/// The text of the fields and its cloud. Commas and spaces stay as the user typed them.
#[derive(Debug, Clone, Default, PartialEq)]
struct Typed {
    place: usize,
    tags: String,
    /// The tags that the text stands for.
    tagged: CloudTags,
}

/// Shows the cloud's name and problems, and the fields.
pub(in crate::ui) fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let Some(place) = state.current else { return };
    let Some(row) = state.many.rows.get(place) else {
        return;
    };
    ui.add_space(2.0);
    about(ui, state, row);
    ui.add_enabled_ui(row.path.is_some(), |ui| {
        ui.horizontal(|ui| {
            let id = Id::unique("typed tags");
            let mut typed: Typed = ui.data(|data| data.get_temp(id)).unwrap_or_default();
            // The tags changed elsewhere: by undo, or because another cloud is shown.
            if typed.place != place || typed.tagged != row.tagged {
                typed = Typed {
                    place,
                    tags: row.tagged.tags.join(", "),
                    tagged: row.tagged.clone(),
                };
            }
            ui.label("Tags");
            let width = (0.35 * ui.available_width()).max(100.0);
            ui.scope(|ui| {
                ui.visuals_mut().weak_text_color = Some(ui.visuals().text_color());
                let field = TextEdit::singleline(&mut typed.tags)
                    .hint_text("Words with commas between")
                    .desired_width(width);
                let field = ui
                    .add(field)
                    .on_hover_text(
                        "Words for this cloud with commas between, kept in axiscope-tags.json in its folder",
                    )
                    .accessible_name("Tags of this cloud");
                if field.changed() {
                    typed.tagged = row.tagged.with_tags(&typed.tags);
                    say(place, &typed.tagged, commands);
                }
                ends(&field, commands);
            });
            ui.label("Note");
            let mut note = row.tagged.note.clone();
            let field = TextEdit::singleline(&mut note).desired_width(ui.available_width() - 4.0);
            let field = ui
                .add(field)
                .on_hover_text("Anything, kept beside the tags")
                .accessible_name("Note on this cloud");
            if field.changed() {
                let tagged = CloudTags {
                    note,
                    ..row.tagged.clone()
                };
                typed.tagged.clone_from(&tagged);
                say(place, &tagged, commands);
            }
            ends(&field, commands);
            ui.data_mut(|data| data.insert_temp(id, typed));
        });
    });
    ui.add_space(2.0);
}

fn say(place: usize, tagged: &CloudTags, commands: &mut Vec<Command>) {
    commands.push(Command::Many(ManyCommand::Tag {
        place,
        tagged: tagged.clone(),
    }));
}

/// Makes the text typed in one visit of a field a single step of undo.
fn ends(field: &egui::Response, commands: &mut Vec<Command>) {
    if field.lost_focus() {
        commands.push(Command::EndGesture);
    }
}

/// Shows the cloud's name, and the reason why it has no error, or its warnings.
fn about(ui: &mut Ui, state: &State, row: &TableRow) {
    ui.horizontal(|ui| {
        ui.label(RichText::new(&row.name).strong());
        let Some(outcome) = &row.outcome else { return };
        if let Some(error) = row.error_deg(state.many.against) {
            ui.label(format!("{error:.1}° off"));
        } else if let Some(failure) = row.failure(state.many.against) {
            let text = RichText::new(crate::text::sentence(failure)).color(warning_color(ui));
            ui.add(Label::new(text).truncate());
        }
        let warnings = &outcome.row().warnings;
        if !warnings.is_empty() {
            let text = RichText::new(warnings).font(small(ui));
            ui.add(Label::new(text).truncate()).on_hover_text(warnings);
        }
    });
}
