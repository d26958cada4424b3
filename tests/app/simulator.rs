//! The simulated pepper, whose analysis follows its sliders.

use std::time::Duration;

use axiscope::app::{App, Command, SimulatorCommand, Slider, SliderGroup, Source};
use axiscope::geometry::angle_between_lines_rad;
use axiscope::method::analyze;
use axiscope::simulate::PepperSettings;

use crate::helpers::driving::{act, app, asset, set, settle};

fn simulate(app: &mut App, command: SimulatorCommand) {
    act(app, Command::Simulate(command));
}

fn lean(app: &mut App, degrees: f64) {
    simulate(app, SimulatorCommand::Move(Slider::LeanTowardsCamera, degrees));
}

fn settings(app: &App) -> PepperSettings {
    let settings = app.state().simulator.settings.as_ref();
    settings.expect("it is open").as_ref().clone()
}

#[test]
fn the_cloud_its_analysis_and_its_error_follow_a_slider() {
    let mut app = app();
    simulate(&mut app, SimulatorCommand::Open);
    let first = settings(&app)
        .tilt_towards_camera_deg
        .expect("nothing is left to chance");
    for degrees in [-20.0, 5.0] {
        lean(&mut app, degrees);
        let wanted = settings(&app);
        assert_eq!(wanted.tilt_towards_camera_deg, Some(degrees));
        let simulated = wanted.simulate().expect("a pepper");
        let walked = app.state().walked.clone().expect("analyzed");
        assert_eq!(walked.fruit.cloud(), &simulated.cloud);
        let direct = analyze(&simulated.cloud, &walked.analysis.params, &()).expect("a pepper");
        let axis = direct.axis.expect("an axis").direction;
        let error = angle_between_lines_rad(axis, simulated.truth.axis.direction).to_degrees();
        assert_eq!(app.state().simulated_error_deg(), Some(error));
        let trail = app.state().simulator.trail.points();
        let kept = trail.iter().find(|point| point.value == degrees);
        assert_eq!(kept.expect("kept").error_deg, Some(error));
    }
    let values: Vec<f64> = (app.state().simulator.trail.points().iter())
        .map(|point| point.value)
        .collect();
    let mut expected = vec![first, -20.0, 5.0];
    expected.sort_by(f64::total_cmp);
    assert_eq!(
        values, expected,
        "the place where the slider began is one of them"
    );
    assert_eq!(app.state().entries.len(), 1, "it is one cloud all the while");
}

#[test]
fn the_errors_kept_are_those_over_one_slider_with_all_else_equal() {
    let mut app = app();
    simulate(&mut app, SimulatorCommand::Open);
    lean(&mut app, 5.0);
    lean(&mut app, 10.0);
    let count = |app: &App| app.state().simulator.trail.points().len();
    assert_eq!(count(&app), 3, "with the lean before");
    set(&mut app, |request| request.params.u = 7);
    assert_eq!(count(&app), 1, "made with another grid");
    lean(&mut app, 20.0);
    assert_eq!(count(&app), 2);
    simulate(&mut app, SimulatorCommand::Move(Slider::Noise, 2.0));
    assert_eq!(count(&app), 2, "over another slider");
    for cm in [30.0, 50.0] {
        simulate(&mut app, SimulatorCommand::Move(Slider::Distance, cm));
    }
    assert_eq!(
        count(&app),
        3,
        "a fruit that moves along its ray is the same fruit"
    );
}

#[test]
fn nothing_is_made_anew_while_no_slider_moves() {
    let mut app = app();
    simulate(&mut app, SimulatorCommand::Open);
    lean(&mut app, 10.0);
    for _ in 0..3 {
        let state = app.state();
        let Some(Source::Simulated(pepper)) = state.source() else {
            panic!("the pepper is shown");
        };
        let settings = state.simulator.settings.as_deref().expect("it is open");
        assert!(std::ptr::eq(pepper.settings(), settings), "the very same");
        app.update(Duration::from_millis(16));
    }
    // Settings that were left and are wanted again are the same cloud.
    lean(&mut app, 20.0);
    lean(&mut app, 10.0);
    assert_eq!(app.state().simulator.trail.points().len(), 3);
}

#[test]
fn a_drag_is_one_step_of_undo() {
    let mut app = app();
    simulate(&mut app, SimulatorCommand::Open);
    let before = settings(&app);
    for step in 0..20 {
        let moved = SimulatorCommand::Move(Slider::Taper, f64::from(10 + step));
        app.apply(Command::Simulate(moved));
        app.update(Duration::from_millis(16));
    }
    app.apply(Command::EndGesture);
    settle(&mut app);
    let after = settings(&app);
    assert_eq!(after.taper, Some(0.29));
    act(&mut app, Command::Undo);
    assert_eq!(settings(&app), before);
    let shown = app
        .state()
        .walked
        .as_ref()
        .expect("analyzed")
        .fruit
        .cloud()
        .clone();
    assert_eq!(shown, before.simulate().expect("a pepper").cloud);
    act(&mut app, Command::Redo);
    assert_eq!(settings(&app), after);
}

#[test]
fn a_slider_brings_the_simulated_pepper_back_into_view() {
    let mut app = app();
    simulate(&mut app, SimulatorCommand::Open);
    act(&mut app, Command::Open(vec![asset("pepper.ply")]));
    assert!(!app.state().shows_simulated());
    lean(&mut app, 12.0);
    assert!(app.state().shows_simulated());
    assert_eq!(app.state().entries.len(), 2);
    let error = app.state().simulated_error_deg();
    assert!(error.is_some());
    let reread = {
        act(&mut app, Command::Reload);
        app.state().simulated_error_deg()
    };
    assert_eq!(reread, error);
}

#[test]
fn every_slider_gives_a_pepper_at_both_ends() {
    let first = PepperSettings::default().drawn().expect("settings");
    for slider in SliderGroup::ALL.iter().flat_map(|group| group.sliders()) {
        let range = slider.range();
        for value in [*range.start(), *range.end()] {
            let mut settings = first.clone();
            slider.set(&mut settings, value);
            let set = slider.value(&settings).expect("set");
            assert!((set - value).abs() < 1e-9, "{slider:?} {value}");
            settings
                .simulate()
                .unwrap_or_else(|error| panic!("{slider:?} {value}: {error}"));
        }
    }
}

#[test]
fn a_saved_pepper_is_the_one_that_was_shown() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("mine.ply");
    let mut app = app();
    simulate(&mut app, SimulatorCommand::Open);
    lean(&mut app, 15.0);
    let error = app.state().simulated_error_deg();
    act(&mut app, Command::SaveCloud(path.clone()));
    let text = app.state().messages.last().map(|m| m.text.clone()).expect("told");
    assert!(text.starts_with("Saved ") && text.contains("mine.ply"), "{text}");
    act(&mut app, Command::Open(vec![path]));
    let walked = app.state().walked.as_ref().expect("analyzed");
    let truth = walked.fruit.truth.as_ref().expect("it lies beside the cloud");
    let axis = walked.analysis.axis.as_ref().expect("an axis").direction;
    let read = angle_between_lines_rad(axis, truth.axis.direction).to_degrees();
    // A file holds single precision.
    assert!((read - error.expect("an axis")).abs() < 0.01);

    let nowhere = folder.path().join("no/such/folder.ply");
    simulate(&mut app, SimulatorCommand::Open);
    act(&mut app, Command::SaveCloud(nowhere));
    let message = app.state().messages.last().expect("told");
    assert!(
        message.is_error && message.text.contains("folder.ply"),
        "{}",
        message.text
    );
}
