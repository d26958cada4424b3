//! The line above every panel of clouds: evaluation, its progress, the reference, and the results.

use std::time::Duration;

use egui::{Button, ProgressBar, Ui};

use super::PanelRequest;
use crate::app::many::{EvaluationProgress, ManyCommand};
use crate::app::{Command, State};
use crate::ui::widgets::reference;

/// Shows the line.
pub(in crate::ui) fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) -> Option<PanelRequest> {
    ui.horizontal_wrapped(|ui| {
        evaluation(ui, state, &mut |command| commands.push(Command::Many(command)));
        ui.add_space(8.0);
        ui.label("Error against");
        commands.extend(reference::choose(ui, state).map(Command::Compare));
        results(ui, state)
    })
    .inner
}

/// Shows the menu of results.
fn results(ui: &mut Ui, state: &State) -> Option<PanelRequest> {
    let mut answer = None;
    let folder = &state.many;
    let has_files = folder.rows.iter().any(|row| row.path.is_some());
    let menu = ui.menu_button("Results", |ui| {
        let save = Button::new("Save results …");
        let save = ui
            .add_enabled(has_files && folder.missing == 0, save)
            .on_hover_text("Tables (CSV and Parquet), a summary, figures and a page with pictures of the worst, as “axiscope evaluate” writes them")
            .on_disabled_hover_text("Once all clouds are evaluated");
        if save.clicked() {
            answer = Some(PanelRequest::SaveResults);
            ui.close();
        }
        let copy = ui.add_enabled(has_files, Button::new("Copy the command line"));
        if copy
            .on_hover_text("The “axiscope evaluate” that does the same without a window")
            .clicked()
        {
            answer = Some(PanelRequest::CopyCommandLine);
            ui.close();
        }
    });
    menu.response
        .on_hover_text("Save what came out, or do the same without a window");
    answer
}

fn evaluation(ui: &mut Ui, state: &State, say: &mut impl FnMut(ManyCommand)) {
    let folder = &state.many;
    let count = folder.rows.len();
    if let Some(progress) = folder.progress {
        let button = ui
            .button("Cancel")
            .on_hover_text("Stop evaluating. What is done stays.");
        if button.clicked() {
            say(ManyCommand::Cancel);
        }
        progress_bar(ui, progress);
        return;
    }
    let missing = folder.missing;
    let has_stale = folder.rows.iter().any(|row| row.is_stale);
    if missing > 0 {
        let text = match missing {
            1 => "Evaluate 1 cloud".to_owned(),
            _ if missing == count => format!("Evaluate all {count} clouds"),
            _ => format!("Evaluate {missing} of {count} clouds"),
        };
        let button = ui.add(Button::new(text)).on_hover_text(
            "Analyze them in the background with the parameters in force (Ctrl+E). What was worked out \
             before is taken over at once.",
        );
        if button.clicked() {
            say(ManyCommand::Evaluate);
        }
        if has_stale {
            ui.label("Rows in italics are of other parameters.");
        }
    } else {
        ui.label(match count {
            0 => "No cloud is open.".into(),
            1 => "1 cloud, evaluated".into(),
            _ => format!("{count} clouds, evaluated"),
        });
    }
}

/// Shows the progress of work on all clouds.
pub(in crate::ui) fn progress_bar(ui: &mut Ui, progress: EvaluationProgress) {
    let left = progress.left.map(|left| format!(", {}", in_words(left)));
    let text = format!(
        "{} of {} clouds{}",
        progress.done,
        progress.total,
        left.unwrap_or_default()
    );
    let share = progress.done as f32 / progress.total.max(1) as f32;
    ui.add(ProgressBar::new(share).desired_width(260.0).text(text));
}

/// Describes a remaining time in words.
fn in_words(left: Duration) -> String {
    let seconds = left.as_secs_f64();
    if seconds < 10.0 {
        "a few seconds left".into()
    } else if seconds < 90.0 {
        format!("about {:.0} s left", 10.0 * (seconds / 10.0).round())
    } else if seconds < 5400.0 {
        format!("about {:.0} min left", (seconds / 60.0).round())
    } else {
        format!("about {:.0} h left", (seconds / 3600.0).round())
    }
}

/// Explains why a panel is empty.
pub(in crate::ui) fn nothing_yet(ui: &mut Ui, state: &State) {
    ui.add_space(24.0);
    ui.vertical_centered(|ui| {
        let text = if state.many.rows.is_empty() {
            "No cloud is open. Drop a folder of PLY files on the window."
        } else if state.many.progress.is_some() {
            "The first clouds are being evaluated."
        } else {
            "No cloud has an error against this reference yet. Evaluate the clouds, or choose another reference."
        };
        ui.label(text);
    });
}
