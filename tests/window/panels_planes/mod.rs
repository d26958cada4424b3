//! The panels on candidate planes: what they ask for when they are used, and how they look.

mod asks;
mod looks;

use std::time::Duration;

use axiscope::app::{App, Command, PlaneChoice, Sample, State};
use axiscope::method::Preset;
use axiscope::ui::inspector::plane_bar;
use axiscope::ui::panels::{hemisphere, ranking, score_map};
use egui::{Key, Rect, Theme, Ui, Vec2, pos2, vec2};
use egui_kittest::kittest::Queryable;
use egui_kittest::{Harness, SnapshotOptions, SnapshotResults};

use crate::helpers::driving::{self, act, settle};

type Panel = fn(&mut Ui, &State, &mut Vec<Command>);

/// The program, and what its panels have asked for.
struct Bench {
    app: App,
    commands: Vec<Command>,
}

fn app_with(sample: Sample) -> App {
    let mut app = driving::app();
    act(&mut app, Command::OpenSample(sample));
    assert!(app.state().analysis().is_some());
    app
}

/// Changes how clouds are analyzed, and waits for nothing.
fn set(app: &mut App, change: impl FnOnce(&mut axiscope::fruit::Request)) {
    let mut request = app.state().settings.request.clone();
    change(&mut request);
    app.apply(Command::Set {
        request: Box::new(request),
        gesture: None,
    });
}

fn harness(app: App, panel: Panel, size: Vec2, theme: Theme, ppp: f32) -> Harness<'static, Bench> {
    let bench = Bench {
        app,
        commands: Vec::new(),
    };
    let mut harness = Harness::builder()
        .with_size(size)
        .with_pixels_per_point(ppp)
        .with_theme(theme)
        .with_step_dt(0.05)
        .with_options(
            SnapshotOptions::new()
                .threshold(1.0)
                .max_failed_pixels(10)
                .output_path("screenshots/panels"),
        )
        .wgpu()
        .build_ui_state(
            move |ui, bench: &mut Bench| {
                let fill = ui.visuals().panel_fill;
                egui::Frame::NONE.fill(fill).inner_margin(8.0).show(ui, |ui| {
                    ui.take_available_space();
                    panel(ui, bench.app.state(), &mut bench.commands);
                });
            },
            bench,
        );
    harness.run();
    harness
}

fn driven(app: App, panel: Panel) -> Harness<'static, Bench> {
    harness(app, panel, vec2(420.0, 440.0), Theme::Dark, 1.0)
}

/// What was asked for since the last time.
fn asked(harness: &mut Harness<'_, Bench>) -> Vec<Command> {
    harness.run();
    std::mem::take(&mut harness.state_mut().commands)
}

/// Does what was asked for, as the window would.
fn obey(harness: &mut Harness<'_, Bench>) -> Vec<Command> {
    let commands = asked(harness);
    for command in commands.clone() {
        harness.state_mut().app.apply(command);
    }
    settle(&mut harness.state_mut().app);
    harness.run();
    commands
}

fn at(g: usize, h: usize) -> Command {
    Command::LookAt(PlaneChoice::At { g, h })
}

fn index_of(state: &State, g: usize, h: usize) -> usize {
    let grid = state.analysis().expect("an analysis").planes.grid;
    grid.index_of(g, h).expect("in the grid")
}

/// The middle of a cell of the score map.
fn cell(map: Rect, u: usize, g: usize, h: usize) -> egui::Pos2 {
    let step = |i: usize| (i as f32 - 0.5) / u as f32;
    pos2(
        egui::lerp(map.x_range(), step(g)),
        egui::lerp(map.y_range(), step(h)),
    )
}

fn click_at(harness: &Harness<'_, Bench>, place: egui::Pos2) {
    harness.hover_at(place);
    for pressed in [true, false] {
        harness.event(egui::Event::PointerButton {
            pos: place,
            button: egui::PointerButton::Primary,
            pressed,
            modifiers: egui::Modifiers::NONE,
        });
    }
}

fn map_of(harness: &Harness<'_, Bench>) -> Rect {
    harness.get_by_label_contains("Score map").rect()
}
