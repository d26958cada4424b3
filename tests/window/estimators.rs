//! The panel of estimators in the window.

use axiscope::app::Session;
use axiscope::estimate::{Estimator, Prior};
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;

use crate::helpers::in_window::{Windowed, settle, state, window_of};

fn opened() -> Windowed {
    let mut harness = window_of(Session::first(), Vec::new(), [1600.0, 900.0], 1.0);
    assert!(
        harness.query_by_label("Estimators").is_none(),
        "no tab until it is asked for"
    );
    harness.get_by_label("Window").click();
    settle(&mut harness);
    harness.get_by_label_contains("Panel: Estimators").click();
    settle(&mut harness);
    harness
}

#[test]
fn the_panel_says_why_and_lets_the_body_s_axis_count() {
    let mut harness = opened();
    harness.get_by_label_contains("The best axis more than 20° away");
    harness.get_by_label_contains("The prior “lean=30,8” adds");
    harness
        .get_by_role_and_label(Role::RadioButton, "Body")
        .click_accesskit();
    settle(&mut harness);
    assert_eq!(state(&harness).estimators.counts, Estimator::Body);
    harness
        .get_by_role_and_label(Role::CheckBox, "surface")
        .click_accesskit();
    settle(&mut harness);
    assert!(state(&harness).estimators.parts.surface);
    assert_eq!(state(&harness).settings.request.estimates.prior, Prior::default());
}
