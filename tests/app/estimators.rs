//! The estimates of the current cloud: computed beside the analysis, kept while they are the same, and drawn.

use std::sync::Arc;

use axiscope::app::estimators::{BodyPart, BodyResult};
use axiscope::app::{App, Command, EstimatorsCommand, Sample, TrueAxesCommand};
use axiscope::estimate::{Estimator, Prior};
use axiscope::method::axis_error_rad;

use crate::helpers::driving::{act, app, set, settle, with_sample};

fn body(app: &App) -> &Arc<BodyResult> {
    app.state().estimators.body.as_ref().expect("fitted")
}

fn ask(app: &mut App, command: EstimatorsCommand) {
    act(app, Command::Estimators(command));
}

#[test]
fn the_body_is_fitted_beside_the_analysis_and_is_nearer_to_the_true_axis_where_the_paper_misses_it() {
    let mut app = app();
    act(&mut app, Command::OpenSample(Sample::MissedPepper));
    let state = app.state();
    let paper = state.estimators.paper.as_ref().expect("estimated");
    assert_eq!(paper.axis, state.analysis().expect("analyzed").axis);
    let (body, reference) = (body(&app), state.reference().expect("a truth"));
    let error_deg = |axis| axis_error_rad(axis, reference).to_degrees();
    let of_body = error_deg(body.estimate.axis.as_ref().expect("an axis"));
    let of_paper = error_deg(paper.axis.as_ref().expect("an axis"));
    assert!(of_body < of_paper, "{of_body} {of_paper}");
    assert!(!state.estimators.is_pending && body.fitted.is_some());
}

#[test]
fn only_what_the_fit_depends_on_fits_it_again() {
    let mut app = with_sample();
    let first = body(&app).clone();
    set(&mut app, |request| request.params.tau_cm_per_rad = 0.7);
    set(&mut app, |request| request.params.u = 8);
    assert!(Arc::ptr_eq(&first, body(&app)), "τ and u have no part in it");
    ask(&mut app, EstimatorsCommand::Prior(Prior::None));
    assert!(!Arc::ptr_eq(&first, body(&app)));
    assert_eq!(body(&app).prior, Prior::None);
    act(&mut app, Command::Undo);
    assert_eq!(body(&app).prior, Prior::default(), "the prior is a step of undo");
    act(&mut app, Command::Close);
    assert!(app.state().estimators.body.is_none() && app.state().estimators.paper.is_none());
}

#[test]
fn a_cloud_that_is_left_takes_its_estimates_with_it() {
    let mut app = with_sample();
    let first = body(&app).clone();
    app.apply(Command::OpenSample(Sample::Ellipsoid));
    app.apply(Command::OpenSample(Sample::MissedPepper));
    settle(&mut app);
    let center = app.state().analysis().expect("analyzed").center;
    let found = body(&app).estimate.center.expect("a center");
    assert!(!Arc::ptr_eq(&first, body(&app)));
    let size = app.state().shown().expect("points").extent.size().length();
    assert!(found.distance(center) < size, "of the cloud that is shown");
}

#[test]
fn the_view_shows_the_parts_that_were_asked_for_and_blind_mode_none() {
    let mut app = with_sample();
    let drawn = |app: &App| {
        let look = app.state().look.as_ref().expect("a view");
        (look.scene.polygons.len(), look.scene.lines.len())
    };
    let (polygons, lines) = drawn(&app);
    ask(&mut app, EstimatorsCommand::Show(BodyPart::Surface, true));
    let facets = drawn(&app).0 - polygons;
    assert_eq!(facets, 24 * 40);
    ask(&mut app, EstimatorsCommand::Show(BodyPart::Alternatives, true));
    assert_eq!(drawn(&app).1 - lines, body(&app).estimate.alternatives.len());
    ask(&mut app, EstimatorsCommand::Count(Estimator::Body));
    assert_eq!(drawn(&app).1 - lines, body(&app).estimate.alternatives.len() + 1);
    let fitted = body(&app).fitted.as_ref().expect("a body");
    let seen = fitted.drawing.facets.iter().filter(|facet| facet.is_seen).count();
    assert!((200..760).contains(&seen), "one side is seen: {seen}");
    act(&mut app, Command::TrueAxes(TrueAxesCommand::Blind(true)));
    assert!(app.state().shown_body().is_none());
    assert_eq!(drawn(&app).0, 0);
}

#[test]
fn the_axis_that_counts_is_the_chosen_estimator_s() {
    let mut app = with_sample();
    let paper = app.state().analysis().expect("analyzed").axis.clone();
    assert_eq!(app.state().counted_axis(), paper.as_ref());
    ask(&mut app, EstimatorsCommand::Count(Estimator::Body));
    assert_eq!(app.state().counted_axis(), body(&app).estimate.axis.as_ref());
}

#[test]
fn profile_and_outline_are_those_of_the_body() {
    let app = with_sample();
    let fitted = body(&app).fitted.as_ref().expect("a body");
    let widest = fitted.profile.iter().map(|[rho, _]| *rho).fold(0.0, f64::max);
    for [rho, _] in &fitted.profile_points {
        assert!(*rho < 1.25 * widest, "{rho} {widest}");
    }
    assert!(fitted.outline.len() > 50, "nearly every sector has an edge");
    let mean_cm = |value: fn(&axiscope::app::estimators::OutlineSector) -> Option<f64>| {
        let values: Vec<f64> = fitted.outline.iter().filter_map(value).collect();
        values.iter().sum::<f64>() / values.len() as f64
    };
    let (seen, of_body) = (mean_cm(|s| Some(s.seen_cm)), mean_cm(|s| s.body_cm));
    assert!((of_body / seen - 1.0).abs() < 0.15, "{seen} {of_body}");
}
