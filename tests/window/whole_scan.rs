//! A scan that goes all around the fruit, with the viewpoint within it.

use axiscope::app::Session;
use axiscope::geometry::Cloud;
use axiscope::simulate::EllipsoidSettings;
use egui_kittest::kittest::Queryable;
use glam::DVec3;

use crate::helpers::driving::write_cloud;
use crate::helpers::in_window::{settle, state, window_of};

#[test]
fn what_is_the_matter_is_said_in_the_view_alone_with_both_ways_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let settings = EllipsoidSettings {
        center_cm: DVec3::new(0.0, 0.0, 60.0),
        ..EllipsoidSettings::default()
    };
    let half = settings.simulate().expect("an ellipsoid").cloud;
    let half = half.positions().iter().map(|p| *p - 60.0 * DVec3::Z);
    let points: Vec<DVec3> = half.flat_map(|p| [p, -p]).collect();
    let path = write_cloud(&Cloud::new(points), &folder.path().join("whole.ply"));
    let mut harness = window_of(Session::first(), vec![path], [1600.0, 900.0], 1.0);
    assert!(state(&harness).is_viewpoint_inside);
    let (_, why) = state(&harness).unanalyzed.as_ref().expect("it is shown");
    assert!(
        why.as_ref()
            .is_some_and(|why| why.contains("lies inside the cloud")),
        "{why:?}"
    );
    let said = harness
        .query_all_by_label_contains("lies inside the cloud")
        .count();
    assert_eq!(said, 0, "no panel says it again");
    let pointers = harness.query_all_by_label("Not analyzed: see the view.").count();
    assert!(pointers >= 2, "{pointers} panels point to the view");
    harness.get_by_label("Scan from here");
    harness.get_by_label("Look from here").click();
    settle(&mut harness);
    assert!(state(&harness).analysis().is_some());
    assert_eq!(
        harness.query_all_by_label("Not analyzed: see the view.").count(),
        0
    );
}
