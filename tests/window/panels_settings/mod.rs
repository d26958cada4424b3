//! The panels of parameters, of one point, of the contributions, and of the open clouds: how they
//! look, and what they ask for.

mod others;
mod parameters;

use axiscope::app::{App, Command, Sample};
use axiscope::ui::WindowAct;
use axiscope::ui::panels::{clouds, contributions, parameters as parameters_panel, why_this_score};
use egui_kittest::kittest::Queryable as _;
use egui_kittest::{Harness, SnapshotOptions};

use crate::helpers::driving;

/// A program, what is drawn of it, and what that asked for.
struct Bench {
    app: App,
    panel: Panel,
    said: Vec<Command>,
    answer: Option<WindowAct>,
}

#[derive(Clone, Copy)]
enum Panel {
    Parameters,
    WhyThisScore,
    Contributions,
    Clouds,
}

impl Bench {
    fn settle(&mut self) {
        driving::settle(&mut self.app);
    }

    fn apply(&mut self, command: Command) {
        self.app.apply(command);
        self.settle();
    }
}

fn bench(panel: Panel, sample: Option<Sample>) -> Bench {
    let mut bench = Bench {
        app: driving::app(),
        panel,
        said: Vec::new(),
        answer: None,
    };
    if let Some(sample) = sample {
        bench.apply(Command::OpenSample(sample));
    }
    bench
}

fn harness(
    bench: Bench,
    size: [f32; 2],
    pixels_per_point: f32,
    theme: egui::Theme,
) -> Harness<'static, Bench> {
    let mut harness = Harness::builder()
        .with_size(size)
        .with_pixels_per_point(pixels_per_point)
        .with_theme(theme)
        .wgpu()
        .build_ui_state(
            |ui, bench: &mut Bench| {
                let (state, mut said) = (bench.app.state(), Vec::new());
                match bench.panel {
                    Panel::Parameters => parameters_panel::show(ui, state, &mut said),
                    Panel::WhyThisScore => why_this_score::show(ui, state, &mut said),
                    Panel::Contributions => contributions::show(ui, state, &mut said),
                    Panel::Clouds => {
                        bench.answer = clouds::show(ui, state, &mut said).or(bench.answer);
                    }
                }
                // As the program does it: what was asked for is done after the frame.
                for command in said {
                    bench.said.push(command.clone());
                    bench.app.apply(command);
                }
            },
            bench,
        );
    harness.run();
    harness
}

fn dark(bench: Bench, size: [f32; 2]) -> Harness<'static, Bench> {
    harness(bench, size, 1.0, egui::Theme::Dark)
}

fn options() -> SnapshotOptions {
    SnapshotOptions::new()
        .threshold(1.0)
        .max_failed_pixels(10)
        .output_path("screenshots/panels")
}

fn click(harness: &mut Harness<'_, Bench>, label: &str) {
    harness.get_by_label(label).click();
    harness.run();
}

/// The last request that was asked for, and its gesture.
fn last_set(bench: &Bench) -> (axiscope::fruit::Request, Option<&'static str>) {
    let sets = bench.said.iter().rev().find_map(|command| match command {
        Command::Set { request, gesture } => Some(((**request).clone(), *gesture)),
        _ => None,
    });
    sets.expect("something was set")
}

/// A shown point that has a partner (or has none).
fn point_of(bench: &Bench, with_partner: bool) -> usize {
    let state = bench.app.state();
    let count = state.shown().expect("points").len();
    (count / 3..count)
        .find(|&i| {
            state
                .point_detail(i)
                .is_some_and(|(_, detail)| detail.partner.is_some() == with_partner)
        })
        .expect("a point")
}
