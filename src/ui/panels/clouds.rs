//! The list of open clouds with their problems, and the samples and recent files that can be opened.

use egui::text::LayoutJob;
use egui::{Align, Button, Layout, RichText, ScrollArea, TextFormat, TextStyle, Ui};

use crate::app::{Command, Entry, Sample, Source, State};
use crate::ui::action::WindowAct;
use crate::ui::widgets::controls::{hint, small, text_field, warning_color};

/// The longest list without a filter.
const UNFILTERED: usize = 10;
/// The number of rows shown at a time.
const ROWS: f32 = 12.0;

/// Shows the list, and the samples and recent files; returns the request for the dialog that opens files.
pub fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) -> Option<WindowAct> {
    ui.spacing_mut().item_spacing.y = 4.0;
    if state.entries.is_empty() {
        ui.label(RichText::new("Nothing is open.").strong());
        hint(ui, "Drop PLY files or a folder here, or open some:");
    } else {
        steps(ui, state, commands);
        list(ui, state, commands);
        ui.add_space(4.0);
    }
    let open = ui
        .button("Open…")
        .on_hover_text("Choose PLY files of point clouds. A folder is opened by dropping it on the window.");
    if !state.entries.is_empty() {
        hint(ui, "Or drop PLY files or a folder here.");
    }
    samples(ui, state, commands);
    recent(ui, state, commands);
    open.clicked().then_some(WindowAct::OpenFiles)
}

fn steps(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let (count, current) = (state.entries.len(), state.current);
    let order = if state.goes_in_order_of_opening() {
        "this list"
    } else {
        "the order of the table"
    };
    ui.horizontal(|ui| {
        let can_go_back = state.neighbor(-1).is_some();
        let can_go_on = state.neighbor(1).is_some();
        if ui
            .add_enabled(can_go_back, Button::new("Previous"))
            .on_hover_text(format!(
                "The previous cloud in {order}, from the same side as this one."
            ))
            .clicked()
        {
            commands.push(Command::Go(-1));
        }
        if ui
            .add_enabled(can_go_on, Button::new("Next"))
            .on_hover_text(format!(
                "The next cloud in {order}, from the same side as this one."
            ))
            .clicked()
        {
            commands.push(Command::Go(1));
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let place = current.map_or(String::new(), |place| format!("{} of ", place + 1));
            ui.label(format!("{place}{count}"));
        });
    });
}

fn list(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let filter = filter(ui, state.entries.len());
    let found: Vec<usize> = if filter.is_empty() {
        (0..state.entries.len()).collect()
    } else {
        let matches = |entry: &Entry| entry.source.name().to_lowercase().contains(&filter);
        let entries = state.entries.iter().enumerate();
        entries
            .filter(|(_, entry)| matches(entry))
            .map(|(i, _)| i)
            .collect()
    };
    if found.is_empty() {
        ui.label("No open cloud has such a name.");
        return;
    }
    let height = ui.spacing().interact_size.y;
    let spacing = ui.spacing().item_spacing.y;
    let mut area = ScrollArea::vertical()
        .max_height(ROWS * (height + spacing))
        .auto_shrink([false, true]);
    // A cloud that has just become the current one is scrolled into sight.
    let memory = ui.make_persistent_id("last shown");
    let sought = (state.current, filter);
    if ui
        .data(|data| data.get_temp::<(Option<usize>, String)>(memory))
        .as_ref()
        != Some(&sought)
    {
        if let Some(row) = found.iter().position(|&place| Some(place) == state.current) {
            let above = (row as f32 - 0.5 * ROWS).max(0.0);
            area = area.vertical_scroll_offset(above * (height + spacing));
        }
        ui.data_mut(|data| data.insert_temp(memory, sought));
    }
    area.show_rows(ui, height, found.len(), |ui, rows| {
        for &place in &found[rows] {
            row(ui, state, place, commands);
        }
    });
}

/// Shows the field that filters a long list; returns its text in lower case.
fn filter(ui: &mut Ui, count: usize) -> String {
    if count <= UNFILTERED {
        return String::new();
    }
    let memory = ui.make_persistent_id("filter");
    let mut typed = ui
        .data(|data| data.get_temp::<String>(memory))
        .unwrap_or_default();
    text_field(ui, &mut typed, "Filter by name", "Filter by name");
    let filter = typed.trim().to_lowercase();
    ui.data_mut(|data| data.insert_temp(memory, typed));
    filter
}

fn row(ui: &mut Ui, state: &State, place: usize, commands: &mut Vec<Command>) {
    let entry = &state.entries[place];
    let is_current = state.current == Some(place);
    let (name, path) = (name(&entry.source), entry.source.path().display().to_string());
    let mut text = LayoutJob::default();
    let font = TextStyle::Button.resolve(ui.style());
    let color = if is_current {
        ui.visuals().strong_text_color()
    } else {
        ui.visuals().text_color()
    };
    text.append(&name, 0.0, TextFormat::simple(font, color));
    if let Some(problem) = &entry.problem {
        // The warning's color has too little contrast on the current row's background.
        let color = if is_current { color } else { warning_color(ui) };
        text.append(problem, 8.0, TextFormat::simple(small(ui), color));
    }
    let size = egui::vec2(ui.available_width(), ui.spacing().interact_size.y);
    let button = Button::selectable(is_current, text).truncate().min_size(size);
    let tip = match &entry.problem {
        Some(problem) => format!("{path}\n{problem}"),
        None => path,
    };
    let accessible = match &entry.problem {
        Some(problem) => format!("{name}: {problem}"),
        None => name,
    };
    if ui
        .add(button)
        .on_hover_text(tip)
        .accessible_name(accessible)
        .clicked()
    {
        commands.push(Command::Show(place));
    }
}

fn name(source: &Source) -> String {
    match source {
        Source::File(_) | Source::Scanned(_) => source.name(),
        Source::Bundled(sample) => sample.title().into(),
        Source::Simulated(_) => "Simulated pepper".into(),
    }
}

fn samples(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let begins = state.entries.is_empty();
    if begins {
        ui.add_space(8.0);
        hint(ui, "Or look at one of the samples. Their true axes are known:");
        sample_buttons(ui, commands);
    } else {
        egui::CollapsingHeader::new("Samples").show_unindented(ui, |ui| sample_buttons(ui, commands));
    }
}

fn sample_buttons(ui: &mut Ui, commands: &mut Vec<Command>) {
    for sample in Sample::ALL {
        let button = Button::new(sample.title())
            .truncate()
            .min_size(egui::vec2(ui.available_width(), 0.0));
        if ui.add(button).clicked() {
            commands.push(Command::OpenSample(sample));
        }
    }
}

fn recent(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    if state.recent.is_empty() {
        return;
    }
    egui::CollapsingHeader::new("Recently opened")
        .default_open(state.entries.is_empty())
        .show_unindented(ui, |ui| {
            for path in &state.recent {
                let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
                let button = Button::new(name.as_ref())
                    .frame_when_inactive(false)
                    .truncate()
                    .min_size(egui::vec2(ui.available_width(), 0.0));
                if ui.add(button).on_hover_text(path.display().to_string()).clicked() {
                    commands.push(Command::Open(vec![path.clone()]));
                }
            }
        });
}
